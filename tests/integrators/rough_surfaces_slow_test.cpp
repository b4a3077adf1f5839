// Rough surfaces in whole renders: parallel light from both sides, and shadow rays behind them.
#include <gtest/gtest.h>

#include "support/scenes.h"
#include "vpm/base/progress.h"
#include "vpm/integrators/path/path_tracer.h"
#include "vpm/integrators/photon_map/photon_pass.h"

namespace vpm {
namespace {

constexpr double kSpread = 1e-5;  // relative, of what rays less than 1e-3 rad apart see of a smooth lobe

/// A sheet in the plane z = 0 seen from far away, at 45 degrees, by rays less than 1e-3 rad apart.
Scene sheet(const Material& material, const Light& light, bool from_outside) {
  Scene scene;
  const Vec3d u(0, 4, 0), v(4, 0, 0);
  add_shape(scene, from_outside ? quad_mesh(Vec3d(-2, -2, 0), v, u) : quad_mesh(Vec3d(-2, -2, 0), u, v), material);
  scene.lights.push_back(light);
  scene.camera = make_camera(Vec3(50, 0, 50), Vec3(0.0f), Vec3(0, 1, 0), 0.05f, {4, 4});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

/// As the scene has it: with what its facets give back.
const Material& material_of_sheet(const Scene& scene) { return scene.materials[scene.shapes[0].material]; }

RenderSettings settings_of(DirectLight direct) {
  RenderSettings settings;
  settings.photons.emitted = 20000;
  settings.surface.radius = 0.4f;
  settings.radii = RadiusSchedule::constant;
  settings.direct.type = direct;
  settings.samples_per_pixel = direct == DirectLight::photons ? 1 : 60;
  return settings;
}

/// Means of the green channel over the picture, pass by pass.
template <class RenderPass>
Moments means(const Scene& scene, const RenderSettings& settings, RenderPass&& render) {
  Moments result;
  for (int pass = 0; pass < 12; ++pass) {
    const Image image = render(scene, settings, pass, PassProgress{}).image;
    double sum = 0.0;
    for (const Rgb& p : image.pixels) sum += p.g;
    result.add(sum / static_cast<double>(image.pixels.size()));
  }
  return result;
}

/// `bound`: of what separates the expectations, besides the noise of 12 passes: 8 standard errors are 1e-5 of Student's
/// t.
void expect_near(const Moments& samples, double expected, double bound, const std::string& what) {
  const double error = std::sqrt(samples.variance_of_mean());
  EXPECT_LE(std::abs(samples.mean() - expected), 8.0 * error + bound)
      << what << ": " << samples.mean() << " +- " << error << ", expected " << expected;
}

const Material kMaterials[] = {Phong{Rgb(0.2f), Rgb(0.7f), 20.0f}, RoughConductor{Rgb(0.4f), Rgb(2.5f), 0.4f},
                               RoughDielectric{1.5f, 0.3f}, RoughDielectric{0.7f, 0.5f}};

// Light from one direction: the BSDF itself, before and behind the sheet. What the pictures' rays see differs from it
// by their spread and by single precision. Photons remember a direction close to the light's.
TEST(RoughSurfaces, SendOutTheirBsdfInParallelLight) {
  for (const Material& material : kMaterials)
    for (const bool behind : {false, true}) {
      const Vec3 light = glm::normalize(Vec3(behind ? 0.5f : -0.8f, 0.1f, behind ? 1.0f : -1.0f));
      const Scene scene = sheet(material, DirectionalLight{light, Rgb(1.0f)}, true);
      const Vec3 eye = glm::normalize(Vec3(1, 0, 1));
      const auto radiance = [&](const Vec3& travel) {
        const ScatterValue scattered = scatter_value(material_of_sheet(scene), {0, 0, 1}, travel, eye);
        return double{scattered.value.g / eye.z * std::abs(light.z)};
      };
      const double expected = radiance(light);
      EXPECT_EQ(expected > 0.0, !behind || scatters_through(material));
      const std::string name = std::to_string(&material - kMaterials) + (behind ? " behind" : " before");
      expect_near(means(scene, settings_of(DirectLight::photons), render_photon_pass),
                  radiance(PackedDirection(light).unpack()), kSpread * expected, name + ", photons");
      expect_near(means(scene, settings_of(DirectLight::shadow_rays), render_photon_pass), expected, kSpread * expected,
                  name + ", shadow rays");
      expect_near(means(scene, settings_of(DirectLight::shadow_rays), render_path_pass), expected, kSpread * expected,
                  name + ", paths");
    }
}

// A light in an absorbing ball of rough glass, which lets through some of its light: by photons alone, and by shadow
// rays that start within the glass.
TEST(RoughSurfaces, ShadowRaysStartInTheMediumBehindThem) {
  Scene scene;
  scene.media.push_back(make_medium(nullptr, Rgb(0.8f), 0.0f));
  const Interface media{0, kVacuum};
  add_shape(scene, SphereShape{Vec3(0.0f), 1.0f}, RoughDielectric{1.3f, 0.4f}, &media);
  scene.lights.push_back(PointLight{Vec3(0, 0, 0), Rgb(1.0f)});
  scene.camera = make_camera(Vec3(0, 0, 50), Vec3(0.0f), Vec3(0, 1, 0), 0.6f, {4, 4});
  scene.geometry.commit();
  finish(scene);
  RenderSettings by_photons = settings_of(DirectLight::photons), by_rays = settings_of(DirectLight::shadow_rays);
  constexpr float kRadius = 0.02f;  // its square is more than what the sphere's curvature changes
  by_photons.surface.radius = by_rays.surface.radius = kRadius;
  const Moments paths = means(scene, by_rays, render_path_pass);
  EXPECT_GT(paths.mean(), 0.05);
  for (const RenderSettings& settings : {by_photons, by_rays})
    expect_near(means(scene, settings, render_photon_pass), paths.mean(), kRadius * kRadius * paths.mean(), "photons");
}

}  // namespace
}  // namespace vpm
