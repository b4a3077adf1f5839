// Light that paths do not find, and that techniques combined find by kernels alone.
#include "vpm/job/lost_light.h"

#include <gtest/gtest.h>

#include "support/scenes.h"
#include "vpm/image/metrics.h"
#include "vpm/integrators/render_scene.h"
#include "vpm/render/render.h"

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
  settings.photons.emitted = 20'000;
  settings.surface.radius = 0.1f;
  settings.radii = RadiusSchedule::constant;
  settings.combined.heuristic = heuristic;
  return settings;
}

const PointLight kLamp{Vec3(0.3f, 2.0f, 0.2f), Rgb(5.0f)};

TEST(KernelLight, IsNotedWhereOtherTechniquesMayNotFindIt) {
  const RenderSettings settings = settings_of(Heuristic::balance);
  const Scene scene = floor_under_glass(kLamp);
  const std::string text = text_of_kernel_light(scene, settings, {"lamp"});
  EXPECT_NE(text.find("what light 'lamp' may send by way of mirrors or glass"), std::string::npos) << text;
  EXPECT_EQ(
      text_of_kernel_light(floor_under_glass(SphereLight{Vec3(0.3f, 2.0f, 0.2f), 0.1f, Rgb(9.0f)}), settings, {""}), "")
      << "rays hit the lamp";
  Scene seen = floor_under_glass(kLamp);
  for (Material& material : seen.materials)
    if (is_dielectric(material)) material = Lambertian{Rgb(0.5f)};
  EXPECT_EQ(text_of_kernel_light(seen, settings, {""}), "") << "there is no glass";
  RenderSettings few = settings;
  few.combined.techniques.set(Technique::connections, false);
  EXPECT_EQ(text_of_kernel_light(scene, few, {""}), "") << "nothing is said of what was left out";
  RenderSettings connecting = settings;
  for (const Technique technique :
       {Technique::surface_merging, Technique::points_3d, Technique::points_2d, Technique::short_beams})
    connecting.combined.techniques.set(technique, false);
  EXPECT_EQ(text_of_kernel_light(scene, connecting, {""}), "") << "there are no kernels";
  EXPECT_EQ(text_of_kernel_light(scene, {}, {""}), "") << "photon maps find it as all else";
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
  settings.photons.emitted = 20'000;
  settings.surface.radius = 0.1f;
  const auto mean = [&](Integrator integrator) {
    settings.integrator = integrator;
    return channel_means(render(scene, settings, nothing_rendered(scene.camera)).film.mean()).g;
  };
  EXPECT_LT(mean(Integrator::path), 0.7 * mean(Integrator::photon));
}

}  // namespace
}  // namespace vpm
