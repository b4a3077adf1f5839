// What makes a scene a slab.
#include "vpm/study/exact/slab_scene.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace vpm {
namespace {

/// Parallel light along an axis.
struct AlongAxis {
  int axis = 1;
  bool falling = true;  // towards lower coordinates
};
std::optional<AlongAxis> axis_of(const Vec3& direction) {
  for (int a = 0; a < 3; ++a)
    if (std::abs(direction[a]) == 1.0f) return AlongAxis{a, direction[a] < 0.0f};
  return std::nullopt;
}

/// Is the one shape a box of the one medium? Twelve triangles that hold the medium at all corners of the box around
/// them are that box.
bool is_box(const Scene& scene, const Box& box) {
  constexpr size_t kTriangles = 12;
  constexpr float kInset = 1e-3f;  // of its extent
  if (scene.geometry.triangle_count(0) != kTriangles) return false;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 place;
    for (int a = 0; a < 3; ++a) {
      const float inset = kInset * box.extent()[a];
      place[a] = corner >> a & 1 ? box.hi[a] - inset : box.lo[a] + inset;
    }
    if (medium_at(scene, place) != 0) return false;
  }
  return true;
}

/// Does the beam enter the box from outside, and far from the sides that do not repeat themselves?
bool is_far_inside(const Scene& scene, const Box& box, const BeamLight& beam, const AlongAxis& along) {
  constexpr float kFar = 20.0f;  // thicknesses of the slab
  const float z = beam.position[along.axis];
  if (along.falling ? z <= box.hi[along.axis] : z >= box.lo[along.axis]) return false;
  for (int a = 0; a < 3; ++a) {
    if (a == along.axis || scene.cyclic[static_cast<size_t>(a)]) continue;
    const float margin = beam.radius + kFar * box.extent()[along.axis];
    if (beam.position[a] - margin < box.lo[a] || beam.position[a] + margin > box.hi[a]) return false;
  }
  return true;
}

std::optional<AlongAxis> light_along(const Scene& scene, const Box& box) {
  if (const auto* const beam = std::get_if<BeamLight>(&scene.lights[0])) {
    const auto along = axis_of(beam->direction);
    return along && !scene.cyclic[static_cast<size_t>(along->axis)] && is_far_inside(scene, box, *beam, *along)
               ? along
               : std::nullopt;
  }
  const auto* const parallel = std::get_if<DirectionalLight>(&scene.lights[0]);
  const auto along = parallel ? axis_of(parallel->direction) : std::nullopt;
  return along && scene.period && !scene.period->repeats(along->axis) ? along : std::nullopt;
}

/// Can its moments be had?
bool has_moments(const Phase& phase) {
  constexpr float kMost = 0.999f;
  const auto* const lobe = std::get_if<HenyeyGreenstein>(&phase);
  const auto* const draine = std::get_if<Draine>(&phase);
  const auto* const lobes = std::get_if<TwoLobes>(&phase);
  return !(lobe && std::abs(lobe->g) > kMost) && !(draine && std::abs(draine->g) > kMost) &&
         !(lobes && std::max(std::abs(lobes->g1), std::abs(lobes->g2)) > kMost);
}

/// The solutions of the channels; equal ones are solved once.
std::array<exact::SlabSolution, 3> solve(const SlabScene& slab) {
  std::array<exact::SlabSolution, 3> solutions;
  for (size_t c = 0; c < 3; ++c) {
    const exact::Slab &of = slab.channels[c], &first = slab.channels[0];
    const bool same = c > 0 && of.tau == first.tau && of.albedo == first.albedo;
    solutions[c] = same ? solutions[0] : exact::solve_slab(of);
  }
  return solutions;
}

}  // namespace

std::optional<SlabScene> slab_of(const Scene& scene) {
  if (scene.media.size() != 1 || scene.shapes.size() != 1 || scene.lights.size() != 1) return std::nullopt;
  const Medium& medium = scene.media[0];
  const Box box = scene.geometry.bounds();
  if (!medium.homogeneous() || medium.emits() || !is_boundary(scene.materials[scene.shapes[0].material]) ||
      scene.world_medium != kVacuum || !has_moments(medium.phase) || !is_box(scene, box))
    return std::nullopt;
  const std::optional<AlongAxis> along = light_along(scene, box);
  if (!along) return std::nullopt;
  if (std::min({medium.sigma_t.r, medium.sigma_t.g, medium.sigma_t.b}) == 0.0f) return std::nullopt;
  SlabScene slab;
  const exact::PhaseMoments moments = exact::moments_of(medium.phase);
  const double thickness = double{box.hi[along->axis]} - double{box.lo[along->axis]};
  for (size_t c = 0; c < 3; ++c) {
    const int channel = static_cast<int>(c);
    slab.channels[c] = {double{medium.sigma_t[channel]} * thickness, double{medium.albedo()[channel]}, moments};
  }
  for (const bool reflected : {true, false}) {
    const bool upper = reflected == along->falling;
    Vec3 normal(0.0f);
    normal[along->axis] = upper ? 1.0f : -1.0f;
    slab.faces.push_back({reflected ? "reflected" : "transmitted", PlaneDetector{upper ? box.hi : box.lo, normal}});
  }
  return slab;
}

SlabMeasurement measure_scene(const Scene& scene, const RenderSettings& settings, const PhotonRun& run) {
  const std::optional<SlabScene> slab = slab_of(scene);
  std::vector<Detector> detectors = scene.detectors;
  if (slab) detectors.insert(detectors.end(), slab->faces.begin(), slab->faces.end());
  SlabMeasurement measured{measure(scene, settings, detectors, run)};
  if (!slab) return measured;
  const Measurement& found = measured.measurement;
  const DetectorReading* const faces = &found.detectors[scene.detectors.size()];
  const auto solutions = solve(*slab);
  const Rgbd whole = found.emitted.mean();
  // What the solver does not tell from 0 is 0.
  const auto true_share = [&](size_t c, exact::Bounded exact::SlabSolution::*value) {
    const exact::Bounded& of = solutions[c].*value;
    return std::abs(of.value) <= of.error ? 0.0 : of.value;
  };
  const auto add = [&](const char* name, const ChannelMoments& power, exact::Bounded exact::SlabSolution::*value) {
    measured.shares.push_back({name,
                               power.mean() / whole,
                               power.standard_error() / whole,
                               {true_share(0, value), true_share(1, value), true_share(2, value)}});
  };
  add("reflected", faces[0].forward, &exact::SlabSolution::reflected);
  add("transmitted", faces[1].forward, &exact::SlabSolution::transmitted);
  add("absorbed", found.absorbed_in_media, &exact::SlabSolution::absorbed);
  return measured;
}

}  // namespace vpm
