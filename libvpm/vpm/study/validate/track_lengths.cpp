// Fluence by the length of flights and by collisions, without any kernel: in a box of volume V the sums
//
//   Phi W(s) length / V over the stretches of photon beams inside,   Phi / (sigma_t V) over the collisions inside
//
// have one mean [Spanier1969], if flights are drawn by the medium's own transmittance. Where sigma_t is grey, W is 1.
// In a chromatic medium the weight of the mixture of channels changes along a stretch. One place, drawn evenly on the
// stretch, stands for all of it: so the mean is that of the integral of W, exactly, and no quadrature is needed.
#include <fmt/format.h>
#include <algorithm>
#include <array>

#include "vpm/medium/distance/mixture.h"
#include "vpm/medium/grid/make_grid.h"
#include "vpm/photon/photon_beam.h"
#include "vpm/photon/trace.h"
#include "vpm/scene/build.h"
#include "vpm/study/careful_settings.h"
#include "vpm/study/sample_moments.h"
#include "vpm/study/validate/groups.h"
#include "vpm/study/validate/scenes/fields.h"

namespace vpm {
namespace {

/// A box of the fields' indices.
struct IndexBox {
  const char* name;
  Vec3d lo, hi;
};
constexpr std::array<IndexBox, 3> kBoxes{{{"the whole box", Vec3d(-7.0), Vec3d(7.0)},
                                          {"an octant", Vec3d(0.0), Vec3d(7.0)},
                                          {"through a bubble", Vec3d(-3.5, -1.0, -2.0), Vec3d(-1.0, 2.0, 1.5)}}};

double volume_of(const IndexBox& box) {
  const Vec3d sides = box.hi - box.lo;
  return field_box_volume() * (sides.x * sides.y * sides.z) / (14.0 * 14.0 * 14.0);
}

bool holds(const IndexBox& box, const Vec3d& index) {
  return glm::all(glm::greaterThanEqual(index, box.lo)) && glm::all(glm::lessThan(index, box.hi));
}

/// A stretch of a beam, m from its origin; empty where `to` is not above `from`.
struct BeamStretch {
  double from, to;
};

BeamStretch stretch_inside(const IndexBox& box, const Mat4d& to_index, const PhotonBeam& beam) {
  const Vec3d origin(to_index * glm::dvec4(Vec3d(beam.origin), 1.0));
  const Vec3d slope(to_index * glm::dvec4(Vec3d(beam.direction), 0.0));
  BeamStretch inside{0.0, double{beam.length}};
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (box.lo[axis] - origin[axis]) / slope[axis], b = (box.hi[axis] - origin[axis]) / slope[axis];
    inside.from = std::max(inside.from, std::min(a, b));
    inside.to = std::min(inside.to, std::max(a, b));
  }
  return inside;
}

/// What a stretch of a beam adds to the integral of fluence over volume, W m.
Rgbd track_length(const Medium& medium, const PhotonBeam& beam, const BeamStretch& inside, Rng& rng) {
  const double length = inside.to - inside.from, place = inside.from + length * rng.uniform_double();
  const Rgbd flux = length * Rgbd(beam.power);
  if (is_grey(medium.sigma_t)) return flux;
  const double integral = looked_up_integral(medium, {beam.origin, beam.direction}, 0.0, place);
  return flux * Rgbd(analog_weight(medium, channel_shares(beam.power), integral, false));
}

/// The field in a box, in it a bubble of another medium and a ball that reflects, lit from inside and by a beam.
Scene lit_field(const TestField& field, const Rgb& sigma_t) {
  Scene scene;
  scene.media.push_back(make_medium(field.grid, sigma_t, 0.8f));
  scene.media.push_back(make_medium(nullptr, Rgb(sigma_t.b, sigma_t.r, sigma_t.g), 0.6f));
  const Interface media{0, kVacuum}, bubble{1, 0};
  add_shape(scene, field_box(), Boundary{}, &media);
  add_shape(scene, SphereShape{field_point({-3.0, 1.0, 0.0}), 0.3f}, Boundary{}, &bubble);
  add_shape(scene, SphereShape{field_point({3.0, 2.0, 4.0}), 0.3f}, Lambertian{Rgb(0.5f)});
  scene.lights.push_back(PointLight{field_point({1.0, -3.0, -2.0}), Rgb(0.2f, 0.1f, 0.15f)});
  scene.lights.push_back(BeamLight{test_ray().origin, test_ray().direction, 0.3f, Rgb(1.0f, 2.0f, 3.0f)});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

/// The fluence in each box by both ways, W/m^2, from a few photons.
struct Fluences {
  std::array<Rgbd, kBoxes.size()> tracks{}, collisions{};
};

Fluences estimate_fluences(const Scene& scene, const DistanceStrategy& strategy, const Mat4d& to_index, Rng& rng) {
  BeamRecorder flights(scene, any_photon, {});
  CollisionRecorder points(scene, VolumeForm::density_at_query, {0.0f, false}, any_photon);
  TraceSettings settings;
  settings.seed = rng.bits();
  settings.emitted = 100;
  Progress progress("", 0, false);
  const Ledger ledger = trace_photons(scene, strategy, settings, {&flights, &points}, progress);
  Fluences found;
  for (size_t i = 0; i < kBoxes.size(); ++i) {
    const double scale = 1.0 / (volume_of(kBoxes[i]) * static_cast<double>(ledger.emitted_count));
    for (size_t m = 0; m < scene.media.size(); ++m) {
      for (const PhotonBeam& beam : flights.beams[m]) {
        const BeamStretch inside = stretch_inside(kBoxes[i], to_index, beam);
        if (inside.to > inside.from) found.tracks[i] += scale * track_length(scene.media[m], beam, inside, rng);
      }
      for (const Photon& p : points.photons[m])
        if (holds(kBoxes[i], Vec3d(to_index * glm::dvec4(Vec3d(p.position), 1.0))))
          found.collisions[i] += scale * Rgbd(p.power) / Rgbd(scene.media[m].majorant());
    }
  }
  return found;
}

std::vector<Check> check_tracks_of(const std::string& name, const Scene& scene, const StrategyInfo& info,
                                   const Effort& effort) {
  const auto strategy = make_distance_strategy(careful_settings(info.name));
  const Mat4d to_index = glm::inverse(test_fields()[0].grid->frame().index_to_world);
  constexpr size_t kQuantities = 3 * kBoxes.size();
  const auto samples = sample_moments(2 * kQuantities, effort.count(1'000, 20'000), effort.seed_of("tracks, " + name),
                                      [&](Rng& rng, double* out) {
                                        const Fluences found = estimate_fluences(scene, *strategy, to_index, rng);
                                        for (size_t i = 0; i < kQuantities; ++i) {
                                          const auto channel = static_cast<int>(i % 3);
                                          out[i] = found.tracks[i / 3][channel] - found.collisions[i / 3][channel];
                                          out[kQuantities + i] = found.collisions[i / 3][channel];
                                        }
                                      });
  const bool grey = scene.media[0].grey();
  std::vector<Check> checks;
  for (size_t i = 0; i < kQuantities; ++i) {
    if (grey && i % 3 > 0) continue;
    checks.push_back(
        check_mean(fmt::format("{}, {}{}", name, kBoxes[i / 3].name, grey ? "" : kOfChannel[i % 3]), samples[i], 0.0));
    checks.back().note = fmt::format("fluence by collisions {:.4g} W/m^2", samples[kQuantities + i].mean());
  }
  return checks;
}

/// Every strategy by which beams may fly and that has no bias; in fields without empty places, where no photon would
/// collide.
std::vector<Check> check_tracks(const Effort& effort) {
  const std::vector<TestField> fields = test_fields();
  std::vector<Check> checks;
  for (const TestField& field : {fields[1], fields[2], fine_field()})
    for (const bool grey : {true, false}) {
      const Scene scene = lit_field(field, grey ? Rgb(1.5f) : Rgb(0.7f, 1.5f, 3.0f));
      for (const StrategyInfo& info : distance_strategies()) {
        if (!info.heterogeneous || !info.analog || !info.unbiased) continue;
        append(checks, check_tracks_of(fmt::format("{}{}, {}", field.name, grey ? "" : " in colour", info.name), scene,
                                       info, effort));
      }
    }
  return checks;
}

}  // namespace

std::vector<Experiment> track_length_experiments() {
  return {{1, "fluence by the length of flights and by collisions", check_tracks}};
}

}  // namespace vpm
