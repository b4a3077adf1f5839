// Final gathering: closed cavities, where it is exact, and what is left to the caustic map.
#include <gtest/gtest.h>

#include "support/photons.h"
#include "support/statistics.h"
#include "vpm/base/parallel.h"
#include "vpm/base/progress.h"
#include "vpm/image/metrics.h"
#include "vpm/integrators/path/path_tracer.h"
#include "vpm/integrators/photon_map/photon_pass.h"
#include "vpm/photon/records.h"
#include "vpm/scene/build.h"

namespace vpm {
namespace {

constexpr float kReflectance = 0.5f;

/// A diffuse hollow cube of 2 m with a light of 1 W in the middle, seen from inside.
Scene hollow_cube(const Medium* fog = nullptr, float reflectance = kReflectance) {
  Scene scene;
  if (fog) {
    scene.media.push_back(*fog);
    scene.world_medium = 0;
  }
  add_shape(scene, box_mesh(Vec3d(-1.0), Vec3d(1.0)), Lambertian{Rgb(reflectance)});
  scene.lights.push_back(PointLight{Vec3(0.0f), Rgb(0.25f / kPi)});
  scene.camera = make_camera(Vec3(0.3f, 0.2f, 0.1f), Vec3(1.0f, 0.3f, 0.2f), Vec3(0, 1, 0), 100.0f, {8, 8});
  scene.camera_medium = scene.world_medium;
  scene.geometry.commit();
  finish(scene);
  return scene;
}

/// The mean radiance over a pass's pixels, green.
template <class RenderPass>
double pass_mean(const Scene& scene, const RenderSettings& settings, int pass, RenderPass&& render) {
  return channel_means(render(scene, settings, pass, PassProgress{}).image).g;
}

/// The means of `kPasses` passes.
template <class MeanOfPass>
Moments means(MeanOfPass&& mean_of_pass) {
  constexpr int kPasses = 40;
  Moments all;
  for (int pass = 0; pass < kPasses; ++pass) all.add(mean_of_pass(pass));
  return all;
}

RenderSettings gathering(float radius) {
  RenderSettings settings;
  settings.photons.emitted = 20'000;
  settings.surface.radius = settings.caustics.radius = radius;
  settings.radii = RadiusSchedule::constant;
  settings.indirect.type = IndirectLight::final_gather;
  settings.samples_per_pixel = 4;
  return settings;
}

Moments by_gathering(const Scene& scene, float radius) {
  return means([&](int pass) { return pass_mean(scene, gathering(radius), pass, render_photon_pass); });
}

/// By paths, which know no map: free of bias.
Moments by_paths(const Scene& scene) {
  RenderSettings settings;
  settings.samples_per_pixel = 100;
  return means([&](int pass) { return pass_mean(scene, settings, pass, render_path_pass); });
}

void expect_same(const Moments& gathered, const Moments& paths) {
  const Check check = check_same("", gathered, paths);
  EXPECT_LT(check.error, 0.01 * paths.mean());
  EXPECT_GE(check.p, kFalseAlarms) << check.value << " against " << check.exact << " +- " << check.error;
}

// Where every ray is too short for the map nothing is left of its blur.
TEST(SlowFinalGather, NeedsNoMapInACavitySmallerThanItsRadius) {
  const Scene scene = hollow_cube();
  expect_same(by_gathering(scene, 10.0f), by_paths(scene));
}

// White walls end no path: each is cut, at a number of events that all its rays share.
TEST(FinalGather, CutsEndlessPathsAndCountsThem) {
  RenderSettings settings = gathering(10.0f);
  settings.max_events = 20;
  const EyeCounters eye = render_photon_pass(hollow_cube(nullptr, 1.0f), settings, 0).statistics.eye;
  EXPECT_EQ(eye.cut_paths, eye.rays * 8);
  EXPECT_EQ(eye.gather_rays, eye.rays * 8 * 20);
}

// One event each: the wall that the eye sees, the wall that a gathering ray meets.
TEST(FinalGather, BoundariesOnTheWayAreNoEvents) {
  Scene scene;
  add_shape(scene, box_mesh(Vec3d(-1.0), Vec3d(1.0)), Lambertian{Rgb(kReflectance)});
  const Interface vacuum{kVacuum, kVacuum};
  for (const double half : {0.5, 0.6, 0.7, 0.8, 0.9})
    add_shape(scene, box_mesh(Vec3d(-half), Vec3d(half)), Boundary{}, &vacuum);
  scene.lights.push_back(PointLight{Vec3(0.0f), Rgb(1.0f)});
  scene.camera = make_camera(Vec3(0.3f, 0.2f, 0.1f), Vec3(1.0f, 0.3f, 0.2f), Vec3(0, 1, 0), 100.0f, {8, 8});
  scene.geometry.commit();
  finish(scene);
  RenderSettings settings = gathering(1e-6f);
  settings.max_events = 1;
  const EyeCounters eye = render_photon_pass(scene, settings, 0).statistics.eye;
  EXPECT_GT(eye.walk.crossings, 5 * eye.rays);
  EXPECT_EQ(eye.cut_paths, 0u);
}

// The 50 nearest of some 1700 photons per m^2 lie within 0.1 m, whatever the largest radius of the search: few rays are
// shorter, as few as at a radius of 0.1 m. All are shorter than 10 m, and would go on: twice as many rays.
TEST(FinalGather, RaysBeyondTheNearestPhotonsEndInTheMap) {
  const auto rays = [](const RenderSettings& settings) {
    return static_cast<double>(render_photon_pass(hollow_cube(), settings, 0).statistics.eye.gather_rays);
  };
  RenderSettings nearest = gathering(10.0f);
  nearest.surface.mode = GatherMode::nearest;
  EXPECT_NEAR(rays(nearest), rays(gathering(0.1f)), 0.05 * rays(gathering(0.1f)));
}

TEST(FinalGather, ByPhotonsAndIrradianceComputedBeforehandIsTheSameOnAnyNumberOfThreads) {
  const Scene scene = hollow_cube();
  RenderSettings settings = gathering(0.1f);
  settings.indirect.rays_by = GatherBy::photons;
  settings.indirect.irradiance = EndIrradiance::precomputed;
  settings.samples_per_pixel = 16;
  set_threads(1);
  const Pass one = render_photon_pass(scene, settings, 0);
  set_threads(4);
  const Pass four = render_photon_pass(scene, settings, 0);
  set_threads(0);
  EXPECT_EQ(one.image.pixels, four.image.pixels);
  EXPECT_EQ(one.statistics.guiding_photons, four.statistics.guiding_photons);
  EXPECT_EQ(one.statistics.irradiance_points, four.statistics.irradiance_points);
  const EyeCounters& eye = one.statistics.eye;
  EXPECT_GT(eye.irradiance_lookups, 20 * eye.irradiance_misses);
  EXPECT_GT(eye.irradiance_misses, 0u);  // few
}

TEST(FinalGather, CountsItsRays) {
  const Scene scene = hollow_cube();
  RenderSettings settings = gathering(1e-4f);
  settings.indirect.rays = 3;
  const RenderStatistics s = render_photon_pass(scene, settings, 0).statistics;
  EXPECT_GE(s.eye.gather_rays, s.eye.rays * 3);
  EXPECT_LE(s.eye.gather_rays, s.eye.rays * 3 + s.eye.rays / 10);  // a few are shorter than the radius
  EXPECT_EQ(s.caustic_photons, 0u);                                // nothing but diffuse walls
  EXPECT_GT(s.surface_photons, 30'000u);                           // direct ones, too
}

/// What 10,000 photons leave to all maps of surfaces and to a caustic map.
struct Hits {
  std::vector<Photon> surface, caustics;
};
Hits hits_in(const Scene& scene, bool direct_caustics, const PhotonFilter& surface = any_photon) {
  HitRecorder all(scene, surface, HitUse::surface_map),
      caustics(scene, caustic_photons(direct_caustics, true), HitUse::other_map);
  trace_into(scene, {.emitted = 10'000}, {&all, &caustics});
  return {all.photons, caustics.photons};
}

TEST(CausticMap, KeepsWhatNoRoughSurfaceScatteredLast) {
  // Between diffuse walls the direct photons are all there are, one for each emitted.
  const Scene cube = hollow_cube();
  EXPECT_TRUE(hits_in(cube, false).caustics.empty());
  EXPECT_EQ(hits_in(cube, true).caustics.size(), 10'000u);
  // Fog makes more: of every photon that it scatters on its way from wall to wall one that was not stored before.
  Medium fog;
  fog.sigma_t = fog.sigma_s = Rgb(0.5f);
  const Hits in_fog = hits_in(hollow_cube(&fog), false);
  EXPECT_GT(in_fog.caustics.size(), 5'000u);
  EXPECT_LT(in_fog.caustics.size(), in_fog.surface.size());
}

TEST(CausticMap, HoldsTheLightThatGlassAndMirrorsLead) {
  Scene scene;
  add_shape(scene, box_mesh(Vec3d(-1.0), Vec3d(1.0)), Lambertian{Rgb(kReflectance)});
  add_shape(scene, SphereShape{Vec3(0.0f), 0.2f}, Dielectric{1.0f});  // all light passes it, and is indirect from there
  scene.lights.push_back(PointLight{Vec3(0.0f), Rgb(1.0f)});
  scene.geometry.commit();
  finish(scene);
  const Hits hits = hits_in(scene, false, indirect_photon);
  EXPECT_EQ(hits.caustics.size(), 10'000u);
  EXPECT_GT(hits.surface.size(), 15'000u);  // these, and what the walls reflected
}

}  // namespace
}  // namespace vpm
