// Photons into a sphere of fog, and paths out of it.
#include "vpm/study/estimates/sphere.h"

#include "vpm/base/warp.h"
#include "vpm/integrators/path/path_tracer.h"
#include "vpm/path/follow.h"
#include "vpm/scene/build.h"
#include "vpm/study/sample_moments.h"

namespace vpm {
namespace {

constexpr int kMostSphereEvents = 10'000'000;

/// The sphere with radius 1 m about the origin.
Scene sphere_scene(const FoggySphere& sphere) {
  Scene scene;
  Medium medium;
  medium.sigma_t = Rgb(static_cast<float>(sphere.optical_radius));
  medium.sigma_s = static_cast<float>(sphere.albedo) * medium.sigma_t;
  if (sphere.g != 0.0) medium.phase = HenyeyGreenstein{static_cast<float>(sphere.g)};
  scene.media.push_back(medium);
  const Interface media{0, kVacuum};
  add_shape(scene, SphereShape{}, Boundary{}, &media);
  scene.lights.push_back(ConstantEnvironment{});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

}  // namespace

SpherePhotons estimate_sphere_photons(const FoggySphere& sphere, uint64_t photons, uint64_t seed) {
  enum { entering, escaped, absorbed, uncollided, collisions, quantities };
  const Scene scene = sphere_scene(sphere);
  const auto strategy = make_distance_strategy({});
  const double entering_power = 4.0 * kPiD * kPiD;  // irradiance pi on the area 4 pi
  const std::vector<Moments> all = sample_moments(quantities, photons, seed, [&](Rng& rng, double* out) {
    Emission emission = emit(scene.lights[0], scene.bounds, rng);
    if (scene.geometry.intersect(emission.ray)) out[entering] = emission.power.r / entering_power;
    while (!scene.geometry.intersect(emission.ray)) emission = emit(scene.lights[0], scene.bounds, rng);
    WalkCounters counters;
    Event last;
    const auto see = [&](const Event& event, const PathState&, const PathState&) {
      last = event;
      out[collisions] += event.kind == EventKind::collision;
      return true;
    };
    follow({scene, *strategy, counters, kMostSphereEvents}, {emission.ray, kVacuum, Rgb(1.0f)}, rng,
           PhotonVisitor{see});
    out[escaped] = last.kind == EventKind::escape;
    out[absorbed] = last.kind == EventKind::collision;
    out[uncollided] = out[collisions] == 0.0;
  });
  return {all[entering], all[escaped], all[absorbed], all[uncollided], all[collisions]};
}

SpherePaths estimate_sphere_paths(const FoggySphere& sphere, const std::vector<double>& radii,
                                  const std::vector<double>& impacts, uint64_t samples, uint64_t seed) {
  const Scene scene = sphere_scene(sphere);
  RenderSettings settings;
  settings.max_events = kMostSphereEvents;
  const PathContext context = make_path_context(scene, settings);
  const size_t n = radii.size();
  const std::vector<Moments> all = sample_moments(n + impacts.size(), samples, seed, [&](Rng& rng, double* out) {
    EyeCounters counters;
    for (size_t i = 0; i < n; ++i) {
      const Ray ray{Vec3(static_cast<float>(radii[i]), 0.0f, 0.0f), uniform_sphere(rng.uniform2())};
      out[i] = 4.0 * kPiD * path_radiance(context, ray, 0, rng, counters).r;
    }
    for (size_t i = 0; i < impacts.size(); ++i) {
      const Ray ray{Vec3(static_cast<float>(impacts[i]), 0.0f, 3.0f), Vec3(0.0f, 0.0f, -1.0f)};
      out[n + i] = path_radiance(context, ray, kVacuum, rng, counters).r;
    }
  });
  const auto split = all.begin() + static_cast<std::ptrdiff_t>(n);
  return {{all.begin(), split}, {split, all.end()}};
}

}  // namespace vpm
