// Final gathering: closed cavities, where it is exact, and what is left to the caustic map.
#include <gtest/gtest.h>

#include "photon/trace.h"
#include "render/photon_pass.h"
#include "scene/build.h"
#include "support/statistics.h"

namespace vpm {
namespace {

constexpr double kFalseAlarms = 1e-6;  // of each comparison
constexpr float kReflectance = 0.5f;

/// A diffuse hollow cube of 2 m with a lamp of 1 W in the middle, seen from inside.
Scene hollow_cube(const Medium* fog = nullptr) {
  Scene scene;
  if (fog) {
    scene.media.push_back(*fog);
    scene.world_medium = 0;
  }
  add_shape(scene, box_mesh(Vec3d(-1.0), Vec3d(1.0)), Lambertian{Rgb(kReflectance)});
  scene.lights.push_back(PointLight{Vec3(0.0f), Rgb(0.25f / kPi)});
  scene.camera = make_camera(Vec3(0.3f, 0.2f, 0.1f), Vec3(1.0f, 0.3f, 0.2f), Vec3(0, 1, 0), 100.0f, 8, 8, {});
  scene.camera_medium = scene.world_medium;
  scene.geometry.commit();
  finish(scene);
  return scene;
}

/// The mean radiance over the pixels, pass by pass.
Moments pass_means(const Scene& scene, const RenderSettings& settings, int passes) {
  static const std::atomic<bool> kGoOn{false};
  Moments means;
  for (int pass = 0; pass < passes; ++pass) {
    const Image image = render_photon_pass(scene, settings, pass, kGoOn).image;
    double sum = 0.0;
    for (const Rgb& p : image.pixels) sum += p.g;
    means.add(sum / static_cast<double>(image.pixels.size()));
  }
  return means;
}

RenderSettings gathering(float radius) {
  RenderSettings settings;
  settings.photons_emitted = 20'000;
  settings.surface.radius = settings.caustics.radius = radius;
  settings.shrink_radii = false;
  settings.surface_indirect = IndirectLight::final_gather;
  settings.samples_per_pixel = 4;
  return settings;
}

// Over the walls of any closed cavity the mean of irradiance is Phi / (A (1 - rho)); on those of a cube it varies, but
// the same rays see the same walls by the plain map of a tiny radius, whose bias is far below the noise.
TEST(FinalGather, SeesWhatThePlainMapSees) {
  const Scene scene = hollow_cube();
  RenderSettings plain = gathering(0.05f);
  plain.surface_indirect = IndirectLight::photons;
  const Moments reference = pass_means(scene, plain, 40);
  for (const float radius : {0.02f, 0.1f}) {
    const Moments gathered = pass_means(scene, gathering(radius), 40);
    const double error = std::sqrt(gathered.variance_of_mean() + reference.variance_of_mean());
    EXPECT_LT(error, 0.005 * reference.mean());
    EXPECT_LT(std::abs(gathered.mean() - reference.mean()),
              normal_quantile(kFalseAlarms) * error + 0.005 * reference.mean())
        << radius << ": " << gathered.mean() << " against " << reference.mean() << " +- " << error;
  }
}

TEST(FinalGather, CountsItsRays) {
  static const std::atomic<bool> kGoOn{false};
  const Scene scene = hollow_cube();
  RenderSettings settings = gathering(1e-4f);
  settings.gather_rays = 3;
  const RenderStatistics s = render_photon_pass(scene, settings, 0, kGoOn).statistics;
  EXPECT_GE(s.eye.gather_rays, s.eye.rays * 3);
  EXPECT_LE(s.eye.gather_rays, s.eye.rays * 3 + s.eye.rays / 10);  // a few are shorter than the radius
  EXPECT_EQ(s.caustic_photons, 0u);                                // nothing but diffuse walls
  EXPECT_GT(s.surface_photons, 30'000u);                           // direct ones, too
}

TracedPhotons trace(const Scene& scene, const TraceSettings& settings) {
  Progress silent("photons", 0, false);
  return trace_photons(scene, *make_distance_strategy({}), settings, silent);
}

TEST(CausticMap, KeepsWhatNoRoughSurfaceScatteredLast) {
  TraceSettings settings;
  settings.emitted = 10'000;
  settings.keep_caustics = true;
  // Between diffuse walls the direct photons are all there are, one for each emitted.
  const Scene cube = hollow_cube();
  EXPECT_TRUE(trace(cube, settings).caustics.empty());
  settings.keep_direct_caustics = true;
  EXPECT_EQ(trace(cube, settings).caustics.size(), 10'000u);
  // Fog makes more: of every photon that it scatters on its way from wall to wall one that was not stored before.
  settings.keep_direct_caustics = false;
  Medium fog;
  fog.sigma_t = fog.sigma_s = Rgb(0.5f);
  const TracedPhotons in_fog = trace(hollow_cube(&fog), settings);
  EXPECT_GT(in_fog.caustics.size(), 5'000u);
  EXPECT_LT(in_fog.caustics.size(), in_fog.surface.size());
}

TEST(CausticMap, HoldsTheLightThatGlassAndMirrorsLead) {
  TraceSettings settings;
  settings.emitted = 10'000;
  settings.keep_caustics = true;
  settings.keep_direct_surface = false;
  Scene scene;
  add_shape(scene, box_mesh(Vec3d(-1.0), Vec3d(1.0)), Lambertian{Rgb(kReflectance)});
  add_shape(scene, SphereShape{Vec3(0.0f), 0.2f}, Dielectric{1.0f});  // all light passes it, and is indirect from there
  scene.lights.push_back(PointLight{Vec3(0.0f), Rgb(1.0f)});
  scene.geometry.commit();
  finish(scene);
  const TracedPhotons photons = trace(scene, settings);
  EXPECT_EQ(photons.caustics.size(), 10'000u);
  EXPECT_GT(photons.surface.size(), 15'000u);  // these, and what the walls reflected
}

}  // namespace
}  // namespace vpm
