// Light that techniques combined find by kernels alone: as much as is missing without them.
#include "vpm/tune/kernel_light.h"

#include <gtest/gtest.h>

#include "support/scenes.h"
#include "support/simulated_clock.h"
#include "vpm/base/statistics/moments.h"
#include "vpm/image/metrics.h"
#include "vpm/integrators/combined/combined_pass.h"
#include "vpm/integrators/render_scene.h"
#include "vpm/job/render_job.h"
#include "vpm/render/render.h"
#include "vpm/tune/lost_light.h"

namespace vpm {
namespace {

/// A floor under a slab of glass, which the camera sees through it, as a light above does. A wall beside it is seen
/// straight.
Scene floor_under_glass(const Light& light) {
  Scene scene;
  add_shape(scene, quad_mesh(Vec3d(-1, 0, 1), Vec3d(2, 0, 0), Vec3d(0, 0, -2)), Lambertian{Rgb(0.5f)});
  add_shape(scene, quad_mesh(Vec3d(-1, 0, -1.2), Vec3d(2, 0, 0), Vec3d(0, 2, 0)), Lambertian{Rgb(0.5f)});
  add_shape(scene, box_mesh(Vec3d(-1.1, 0.3, -1.1), Vec3d(1.1, 0.5, 1.1)), Dielectric{1.5f});
  scene.lights.push_back(light);
  scene.camera = make_camera(Vec3(0, 2.5f, 2.5f), Vec3(0, 0.3f, -0.2f), Vec3(0, 1, 0), 40.0f, {32, 32});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

RenderSettings settings_of(Heuristic heuristic) {
  RenderSettings settings;
  settings.integrator = Integrator::combined;
  settings.photons_emitted = 20'000;
  settings.surface.radius = 0.1f;
  settings.radii = RadiusSchedule::constant;
  settings.combined.heuristic = heuristic;
  return settings;
}

RenderSettings without_kernels(RenderSettings settings) {
  settings.combined.techniques.set(Technique::surface_merging, false);
  return settings;
}

Moments mean_light(const Scene& scene, const RenderSettings& settings) {
  constexpr int kPasses = 30;
  Moments means;
  for (int pass = 0; pass < kPasses; ++pass)
    means.add(channel_means(render_combined_pass(scene, settings, pass).image).g);
  return means;
}

const PointLight kLamp{Vec3(0.3f, 2.0f, 0.2f), Rgb(5.0f)};

/// The floor's light, of a lamp that nothing hits, through the glass and back through it.
TEST(KernelLight, IsWhatIsMissingWithoutKernels) {
  const Scene scene = floor_under_glass(kLamp);
  // Where vertices beyond the first from the eye are connected, too, as they are without kernels.
  const RenderSettings settings = settings_of(Heuristic::balance);
  const Moments all = mean_light(scene, settings), rest = mean_light(scene, without_kernels(settings));
  const std::optional<KernelLight> found = kernel_light_of(scene, settings);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->lights, std::vector<size_t>{0});
  EXPECT_GT(found->share.value, 0.1);
  const double missing = 1.0 - rest.mean() / all.mean();
  const double variance = (all.variance_of_mean() + rest.variance_of_mean()) / (all.mean() * all.mean());
  // Right code is off by so much once in 15,000 times.
  EXPECT_NEAR(found->share.value, missing,
              4.0 * std::sqrt(variance + found->share.standard_error * found->share.standard_error));
  EXPECT_LT(found->share.standard_error, 0.02);
}

TEST(KernelLight, IsMoreWhereFewerTechniquesFindIt) {
  const Scene scene = floor_under_glass(kLamp);
  RenderSettings settings = settings_of(Heuristic::balance);
  const std::optional<KernelLight> least = kernel_light_of(scene, settings);
  const std::optional<KernelLight> first_vertex = kernel_light_of(scene, settings_of(Heuristic::correlation_aware));
  settings.combined.techniques.set(Technique::light_tracing, false);  // finds the wall, lit by the glass
  const std::optional<KernelLight> untraced = kernel_light_of(scene, settings);
  ASSERT_TRUE(least && first_vertex && untraced);
  EXPECT_GT(first_vertex->share.value, least->share.value) << "of vertices beyond the first none is connected";
  EXPECT_GT(untraced->share.value, least->share.value);
}

TEST(KernelLight, IsNoneWhereOtherTechniquesFindAll) {
  const RenderSettings settings = settings_of(Heuristic::balance);
  EXPECT_FALSE(kernel_light_of(floor_under_glass(SphereLight{Vec3(0.3f, 2.0f, 0.2f), 0.1f, Rgb(9.0f)}), settings))
      << "rays hit the lamp";
  Scene seen = floor_under_glass(kLamp);
  for (Material& material : seen.materials)
    if (is_dielectric(material)) material = Lambertian{Rgb(0.5f)};
  EXPECT_FALSE(kernel_light_of(seen, settings)) << "there is no glass";
  RenderSettings merging = settings;
  merging.combined.techniques.set(Technique::connections, false);
  EXPECT_FALSE(kernel_light_of(floor_under_glass(kLamp), merging)) << "nothing is said of what was left out";
  EXPECT_FALSE(kernel_light_of(floor_under_glass(kLamp), without_kernels(settings)));
}

TEST(KernelLight, ThatTheTimeDoesNotAllowToLookIsSaid) {
  RenderSettings settings = settings_of(Heuristic::balance);
  settings.until = {.seconds = 2.0};
  RenderJob job = make_job({floor_under_glass(kLamp), {}, {}}, settings);
  look_for_kernel_light(job, HastyClock());
  EXPECT_FALSE(job.kernel_light);
  EXPECT_EQ(job.notes,
            (std::vector<std::string>{"the time does not allow to look for light that is found by kernels alone"}));
}

TEST(KernelLight, IsToldWithTheNamesOfLights) {
  const std::string text = text_of({{0.1234, 0.0021}, {0, 2}}, {"sun", "", ""});
  EXPECT_TRUE(text.starts_with("0.12 +- 0.002 of the light is found by kernels alone")) << text;
  EXPECT_NE(text.find("no ray hits the lights 'sun', number 2"), std::string::npos) << text;
  EXPECT_EQ(text.find("light-tracing"), std::string::npos) << text;
  EXPECT_NE(text_of({{0.1, 0.01}, {0}, false}, {""}).find("\"light-tracing\" among them"), std::string::npos);
}

TEST(LostLight, IsToldOfPathsWhereLightsWithoutExtentShineOnGlass) {
  const Scene scene = floor_under_glass(kLamp);
  RenderSettings paths;
  paths.integrator = Integrator::path;
  const std::string text = text_of_lost_light(scene, paths, {"lamp"});
  EXPECT_NE(text.find("what light 'lamp' may send by way of mirrors or glass"), std::string::npos) << text;
  EXPECT_EQ(text_of_lost_light(scene, settings_of(Heuristic::balance), {"lamp"}), "");
  EXPECT_EQ(text_of_lost_light(floor_under_glass(ConstantEnvironment{Rgb(1.0f)}), paths, {""}), "");
  Scene bare;
  add_shape(bare, quad_mesh(Vec3d(-1, 0, 1), Vec3d(2, 0, 0), Vec3d(0, 0, -2)), Lambertian{Rgb(0.5f)});
  bare.lights.push_back(kLamp);
  bare.geometry.commit();
  finish(bare);
  EXPECT_EQ(text_of_lost_light(bare, paths, {"lamp"}), "") << "no mirror, no glass";
}

/// That there is such light: photons find in the floor what paths do not.
TEST(LostLight, IsWhatPhotonsFindAndPathsDoNot) {
  const Scene scene = floor_under_glass(kLamp);
  RenderSettings settings;
  settings.until.passes = 8;
  settings.photons_emitted = 20'000;
  settings.surface.radius = 0.1f;
  const auto mean = [&](Integrator integrator) {
    settings.integrator = integrator;
    return channel_means(render(scene, settings, nothing_rendered(scene.camera)).film.mean()).g;
  };
  EXPECT_LT(mean(Integrator::path), 0.7 * mean(Integrator::photon));
}

}  // namespace
}  // namespace vpm
