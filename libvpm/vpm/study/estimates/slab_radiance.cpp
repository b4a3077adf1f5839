// Paths of the path tracer out of slabs, and from points inside them into all directions; rays that gather photons.
#include "vpm/study/estimates/slab_radiance.h"

#include <algorithm>

#include "vpm/base/warp.h"
#include "vpm/integrators/path/path_tracer.h"
#include "vpm/path/direct_light.h"
#include "vpm/study/sample_moments.h"

namespace vpm {
namespace {

/// The point at a depth: just inside where that is on the slab's surface. The fluence falls so steeply below the top
/// that the next float will not do.
Vec3 point_at(const Slab& slab, double depth) {
  const double thickness = slab.layers.thickness();
  return {0.0f, static_cast<float>(-std::clamp(depth, 1e-12 * thickness, (1.0 - 0x1p-23) * thickness)), 0.0f};
}

/// The ray along which an eye outside sees the exit.
Ray towards_exit(const Slab& slab, const SlabExit& exit) {
  const auto mu = static_cast<float>(exit.mu), across = static_cast<float>(std::sqrt(1.0 - exit.mu * exit.mu));
  const auto depth = static_cast<float>(slab.layers.thickness());
  if (exit.below) return {Vec3(0.0f, -2.0f * depth, 0.0f), Vec3(across, mu, 0.0f)};
  return {Vec3(0.0f, depth, 0.0f), Vec3(across, -mu, 0.0f)};
}

constexpr double kCloseMirrors = 3.0;  // thicknesses from the slab's middle
constexpr int kRaysOfExit = 128;       // in a pass

/// A ray that sees the exit, turned at random about the normal, and through a random place in the slab's middle, at
/// most a thickness from the center: it leaves the slab more than a thickness before the mirrors.
Ray towards_exit_between_mirrors(const Slab& slab, const SlabExit& exit, Rng& rng) {
  const float turn = 2.0f * kPi * rng.uniform();
  const auto mu = static_cast<float>(exit.mu), across = std::sqrt(1.0f - mu * mu);
  const auto thickness = static_cast<float>(slab.layers.thickness());
  const Vec3 forward(across * std::cos(turn), exit.below ? mu : -mu, across * std::sin(turn));
  const Vec2 place = 2.0f * rng.uniform2() - 1.0f;
  return {thickness * (Vec3(place.x, -0.5f, place.y) - 4.0f * forward), forward};
}

}  // namespace

SlabRadiances estimate_slab_radiance(const Slab& slab, const std::vector<SlabExit>& exits,
                                     const std::vector<double>& depths, uint64_t samples, uint64_t seed) {
  const Scene scene = slab_scene(slab, SlabLight::everywhere);
  RenderSettings settings;
  settings.max_events = 10'000'000;
  const PathContext context = make_path_context(scene, settings);
  std::vector<Vec3> points;
  std::vector<MediumId> media;
  for (const double depth : depths) {
    points.push_back(point_at(slab, depth));
    media.push_back(medium_at(scene, points.back()));
  }
  const size_t size = exits.size() + depths.size();
  const std::vector<Moments> all = sample_moments(size, samples, seed, [&](Rng& rng, double* out) {
    EyeCounters counters;
    for (size_t i = 0; i < exits.size(); ++i)
      out[i] = path_radiance(context, towards_exit(slab, exits[i]), kVacuum, rng, counters).r;
    for (size_t i = 0; i < depths.size(); ++i) {
      const Ray ray{points[i], uniform_sphere(rng.uniform2())};
      out[exits.size() + i] = 4.0 * kPiD * path_radiance(context, ray, media[i], rng, counters).r;
    }
  });
  const auto split = all.begin() + static_cast<std::ptrdiff_t>(exits.size());
  return {{all.begin(), split}, {split, all.end()}};
}

SlabSights estimate_slab_radiance_by_photons(const Slab& slab, const std::vector<SlabExit>& exits,
                                             const std::vector<SlabRange>& ranges, const PhotonRays& by) {
  const Scene scene = slab_scene(slab, SlabLight::everywhere, kCloseMirrors);
  const auto look = [&](const auto& see, Rng& rng) {
    std::vector<double> found(exits.size() + ranges.size(), 0.0);
    for (int ray = 0; ray < kRaysOfExit; ++ray) {
      for (size_t i = 0; i < exits.size(); ++i)
        found[i] += see(towards_exit_between_mirrors(slab, exits[i], rng)) / kRaysOfExit;
      for (size_t i = 0; i < ranges.size(); ++i) {
        const auto& [from, to, below] = ranges[i];
        const double mu = from + (to - from) * rng.uniform_double();
        found[exits.size() + i] +=
            2.0 * kPiD * mu * (to - from) * see(towards_exit_between_mirrors(slab, {mu, below}, rng)) / kRaysOfExit;
      }
    }
    return found;
  };
  const std::vector<RadianceByPhotons> all = estimate_along_rays(scene, by, look);
  const auto split = all.begin() + static_cast<std::ptrdiff_t>(exits.size());
  return {{all.begin(), split}, {split, all.end()}};
}

Moments estimate_unscattered_fluence(const Slab& slab, double depth, uint64_t samples, uint64_t seed) {
  const Scene scene = slab_scene(slab, SlabLight::everywhere);
  const auto transmittance = make_transmittance_estimator({});
  const Vec3 point = point_at(slab, depth);
  const MediumId medium = medium_at(scene, point);
  return sample_moments(1, samples, seed, [&](Rng& rng, double* out) {
    WalkCounters counters;
    out[0] = sample_direct({scene, *transmittance, rng, counters}, 0, {point, medium}).irradiance.r;
  })[0];
}

}  // namespace vpm
