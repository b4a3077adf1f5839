// Slabs as scenes (media, wide boundaries, mirrors far away, and the light), and photons through them, one by one.
#include "vpm/study/estimates/slab.h"

#include <algorithm>

#include "vpm/path/follow.h"
#include "vpm/scene/build.h"
#include "vpm/study/sample_moments.h"

namespace vpm {
namespace {

/// A boundary across all of the slab; off its center, so that the diagonal that divides the quad is far from the light.
void add_plane(Scene& scene, double depth, double width, const Interface& media) {
  const Vec3d corner(-1.1 * width, -depth, -1.4 * width);
  add_shape(scene, quad_mesh(corner, Vec3d(0.0, 0.0, 2.5 * width), Vec3d(2.5 * width, 0.0, 0.0)), Boundary{}, &media);
}

/// Mirrors at x = +-width and z = +-width, higher than the slab by as little as leaves no gap.
void add_walls(Scene& scene, double thickness, double width) {
  const double gap = 1e-6 * thickness;
  const Vec3d up(0.0, thickness + 2.0 * gap, 0.0), bottom(0.0, -thickness - gap, 0.0);
  for (const double side : {-1.0, 1.0}) {
    const double far = 1.01 * width;
    add_shape(scene, quad_mesh(bottom + Vec3d(side * width, 0.0, -far), up, Vec3d(0.0, 0.0, 2.0 * far)), Mirror{});
    add_shape(scene, quad_mesh(bottom + Vec3d(-far, 0.0, side * width), up, Vec3d(2.0 * far, 0.0, 0.0)), Mirror{});
  }
}

Light light_on(const Slab& slab, SlabLight light) {
  const auto size = static_cast<float>(slab.layers.thickness());
  if (slab.incidence == Incidence::collimated) {
    if (light == SlabLight::everywhere) return DirectionalLight{};
    return BeamLight{Vec3(0.0f, size, 0.0f), Vec3(0.0f, -1.0f, 0.0f), 0.01f * size, Rgb(1.0f)};
  }
  if (light == SlabLight::everywhere) {
    std::vector<Rgb> sky{Rgb(1.0f / kPi), Rgb(0.0f)};  // above, below
    return EnvironmentMap{std::make_shared<const ImageEnvironment>(1, 2, std::move(sky))};
  }
  return QuadLight{0.5f * size * Vec3(-1.0f, 0.002f, -1.0f), Vec3(size, 0.0f, 0.0f), Vec3(0.0f, 0.0f, size),
                   Rgb(1.0f / (kPi * size * size))};
}

}  // namespace

Slab homogeneous_slab(double optical_thickness, double albedo, double g, Incidence incidence) {
  return {{{0.0, 1.0}, {optical_thickness, optical_thickness}}, albedo, g, incidence};
}

Scene slab_scene(const Slab& slab, SlabLight light, double mirrors) {
  const double thickness = slab.layers.thickness(), width = mirrors * thickness;
  const LayeredMedia layered = layered_media(slab.layers, 2.0 * width);
  Scene scene;
  const auto last = static_cast<MediumId>(layered.media.size()) - 1;
  add_plane(scene, 0.0, width, {0, kVacuum});
  for (MediumId m = 0; m <= last; ++m) {
    Medium medium = layered.media[m];
    medium.sigma_s = static_cast<float>(slab.albedo) * medium.sigma_t;
    if (slab.g != 0.0) medium.phase = HenyeyGreenstein{static_cast<float>(slab.g)};
    scene.media.push_back(std::move(medium));
    add_plane(scene, layered.bottoms[m], width, {m < last ? m + 1 : kVacuum, m});
  }
  add_walls(scene, thickness, width);
  scene.lights.push_back(light_on(slab, light));
  scene.geometry.commit();
  finish(scene);
  return scene;
}

namespace {

constexpr int kMostSlabEvents = 10'000'000;  // of one photon

/// Where each quantity of a photon stands in its list.
struct Layout {
  size_t reflected = 0, transmitted = 1, absorbed = 2, unscattered = 3, lost = 4, collisions = 5;
  size_t reflected_at = 6;
  size_t transmitted_at, net_flux, absorbed_between, collisions_between, size;

  explicit Layout(const SlabTallies& tallies) {
    const size_t bins = std::max<size_t>(tallies.mu_edges.size(), 1) - 1;
    const size_t layers = std::max<size_t>(tallies.planes.size(), 1) - 1;
    transmitted_at = reflected_at + bins;
    net_flux = transmitted_at + bins;
    absorbed_between = net_flux + tallies.planes.size();
    collisions_between = absorbed_between + layers;
    size = collisions_between + layers;
  }
};

/// The bin of ascending edges that holds x; the number of edges where none does.
size_t bin_of(const std::vector<double>& edges, double x) {
  const auto above = std::upper_bound(edges.begin(), edges.end(), x);
  if (above == edges.begin()) return edges.size();
  if (above != edges.end()) return static_cast<size_t>(above - edges.begin()) - 1;
  return !edges.empty() && x == edges.back() ? edges.size() - 2 : edges.size();
}

/// How a photon's way through the slab ended.
struct End {
  Event event;
  PathState state;
  int events = 0, collisions = 0;
};

class PhotonTally {
 public:
  PhotonTally(const Layout& layout, const SlabTallies& tallies, double thickness, double* out)
      : at_(layout), tallies_(tallies), thickness_(thickness), out_(out) {}

  void see(const Event& event, const PathState& state) {
    end_.event = event;
    end_.state = state;
    ++end_.events;
    if (event.kind != EventKind::collision) return;
    ++end_.collisions;
    out_[at_.collisions] += state.throughput.r;
    add_between(at_.collisions_between);
  }

  void finish() {
    const double power = end_.state.throughput.r;
    double depth = -end_.state.ray.origin.y;
    const bool escaped = end_.event.kind == EventKind::escape;
    if (end_.events == kMostSlabEvents || (escaped && depth > 0.0 && depth < thickness_)) {
      out_[at_.lost] += power;
      return;
    }
    if (escaped) {
      leave(depth <= 0.0, power);
      depth = depth <= 0.0 ? -HUGE_VAL : HUGE_VAL;
    } else {
      out_[at_.absorbed] += power;
      add_between(at_.absorbed_between);
    }
    // A photon crosses a plane downwards once more than upwards where it ends below.
    for (size_t i = 0; i < tallies_.planes.size(); ++i)
      if (depth >= tallies_.planes[i]) out_[at_.net_flux + i] += power;
  }

 private:
  void leave(bool above, double power) {
    out_[above ? at_.reflected : at_.transmitted] += power;
    if (end_.collisions == 0) {
      out_[at_.unscattered] += power;
      return;
    }
    const size_t bin = bin_of(tallies_.mu_edges, std::abs(end_.state.ray.direction.y));
    if (bin < tallies_.mu_edges.size()) out_[(above ? at_.reflected_at : at_.transmitted_at) + bin] += power;
  }
  void add_between(size_t first) {
    const size_t layer = bin_of(tallies_.planes, -end_.state.ray.origin.y);
    if (layer < tallies_.planes.size()) out_[first + layer] += end_.state.throughput.r;
  }

  const Layout& at_;
  const SlabTallies& tallies_;
  double thickness_;
  double* out_;
  End end_;
};

}  // namespace

SlabEstimate estimate_slab(const Slab& slab, const DistanceStrategy& strategy, const SlabTallies& tallies,
                           uint64_t photons, uint64_t seed) {
  const Scene scene = slab_scene(slab, SlabLight::spot);
  const Layout at(tallies);
  const std::vector<Moments> all = sample_moments(at.size, photons, seed, [&](Rng& rng, double* out) {
    const Emission emission = emit(scene.lights[0], scene.bounds, rng);
    WalkCounters counters;
    PhotonTally tally(at, tallies, slab.layers.thickness(), out);
    const auto see = [&](const Event& event, const PathState&, const PathState& now) {
      tally.see(event, now);
      return true;
    };
    follow({scene, strategy, counters, kMostSlabEvents}, {emission.ray, kVacuum, emission.power}, rng,
           PhotonVisitor{see});
    tally.finish();
  });
  const auto part = [&](size_t begin, size_t end) {
    return std::vector<Moments>(all.begin() + static_cast<std::ptrdiff_t>(begin),
                                all.begin() + static_cast<std::ptrdiff_t>(end));
  };
  return {.reflected = all[at.reflected],
          .transmitted = all[at.transmitted],
          .absorbed = all[at.absorbed],
          .unscattered = all[at.unscattered],
          .lost = all[at.lost],
          .collisions = all[at.collisions],
          .reflected_at = part(at.reflected_at, at.transmitted_at),
          .transmitted_at = part(at.transmitted_at, at.net_flux),
          .net_flux = part(at.net_flux, at.absorbed_between),
          .absorbed_between = part(at.absorbed_between, at.collisions_between),
          .collisions_between = part(at.collisions_between, at.size)};
}

}  // namespace vpm
