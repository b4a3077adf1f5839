// Level 3: the light map of a floor, in every way that light reaches it, against paths from the points of the floor.
#include "vpm/base/parallel.h"
#include "vpm/base/warp.h"
#include "vpm/integrators/path/path_tracer.h"
#include "vpm/integrators/photon_map/surface/light_map.h"
#include "vpm/study/sample_moments.h"
#include "vpm/study/validate/groups.h"
#include "vpm/study/validate/scenes/small_scenes.h"

namespace vpm {
namespace {

constexpr uint32_t kFloor = 1;   // among the shapes of lit_corner(): 4 m wide, about the origin
constexpr int kResolution = 4;   // texels along an edge; the inner ones, 1 m from the floor's edges, are compared
constexpr float kRadius = 0.1f;  // m, of the maps
constexpr float kLift = 1e-4f;   // m, of rays off the floor

/// Irradiance of the floor's inner half, W/m^2, by channel.
using Irradiance = std::vector<Moments>;

/// From the radiance that paths bring, cosine by cosine.
Irradiance by_paths(const Scene& scene, uint64_t rays, uint64_t seed) {
  const PathContext context = make_path_context(scene, {});
  return sample_moments(3, rays, seed, [&](Rng& rng, double* out) {
    const Vec2 place = 2.0f * rng.uniform2() - 1.0f;
    const Ray up{Vec3(place.x, kLift, place.y), cosine_hemisphere(Vec3(0, 1, 0), rng.uniform2())};
    EyeCounters counters;
    const Rgb radiance = path_radiance(context, up, kVacuum, rng, counters);
    for (int c = 0; c < 3; ++c) out[c] = kPiD * double{radiance[c]};
  });
}

Rgbd mean_of_inner(const Image& map) {
  Rgbd sum(0.0);
  for (int y = 1; y < kResolution - 1; ++y)
    for (int x = 1; x < kResolution - 1; ++x)
      sum += Rgbd(map.pixels[static_cast<size_t>(y) * kResolution + static_cast<size_t>(x)]);
  return sum / double{(kResolution - 2) * (kResolution - 2)};
}

/// Passes with one radius: over so much of the floor a kernel's blur cancels, except for its slope at the border.
Irradiance by_light_map(const Scene& scene, const RenderSettings& settings, uint64_t passes) {
  const UvLayout layout = lay_out_light_map(scene, kFloor, kResolution);
  std::vector<Rgbd> means(passes);
  parallel_for_chunks(passes, 1, [&](size_t pass, size_t, size_t) {
    means[pass] = mean_of_inner(light_map_pass(scene, settings, layout, static_cast<int>(pass)).image);
  });
  Irradiance irradiance(3);
  for (const Rgbd& mean : means)
    for (int c = 0; c < 3; ++c) irradiance[static_cast<size_t>(c)].add(mean[c]);
  return irradiance;
}

std::vector<Check> compare_light_maps(const Effort& effort) {
  const Scene scene = lit_corner();
  const Irradiance reference = by_paths(scene, effort.count(40'000, 1'000'000), effort.seed_of("floor by paths"));
  RenderSettings settings;
  settings.photons.emitted = effort.count(6'000, 20'000);
  settings.samples_per_pixel = 200;
  settings.radii = RadiusSchedule::constant;
  settings.surface.radius = settings.caustics.radius = kRadius;
  std::vector<Check> checks;
  const auto compare = [&](const std::string& name) {
    settings.seed = effort.seed_of(name);
    const Irradiance map = by_light_map(scene, settings, effort.count(24, 64));
    for (size_t c = 0; c < 3; ++c) checks.push_back(check_same(name + kOfChannel[c], map[c], reference[c]));
  };
  settings.direct.type = DirectLight::photons;
  compare("photons alone");
  settings.direct.type = DirectLight::shadow_rays;
  compare("direct light by shadow rays");
  settings.indirect.type = IndirectLight::final_gather;
  settings.indirect.rays = 1;
  compare("final gathering");
  return checks;
}

}  // namespace

std::vector<Experiment> light_map_experiments() { return {{3, "the light map of a floor", compare_light_maps}}; }

}  // namespace vpm
