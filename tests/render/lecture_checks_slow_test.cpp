// The two checks that lectures on photon mapping recommend: photons of direct light, looked at, must look like direct
// light; and a ball of index 1 must leave no shadow once caustics are there.
#include <gtest/gtest.h>

#include "vpm/base/progress.h"
#include "vpm/image/metrics.h"
#include "vpm/render/photon_pass.h"
#include "vpm/scene/build.h"
#include "vpm/study/validate/check.h"

namespace vpm {
namespace {

constexpr double kFalseAlarms = 1e-4;  // of each check: half of them by the mean, half by any pixel
constexpr int kFilm = 8;               // pixels along an edge

/// A floor under a square light, and, of an index of refraction > 0, a ball between them.
Scene floor_under_lamp(float ior) {
  Scene scene;
  const QuadLight lamp{Vec3(-0.5f, 2.0f, -0.5f), Vec3(1, 0, 0), Vec3(0, 0, 1), Rgb(4.0f, 3.0f, 2.0f)};
  scene.lights.push_back(lamp);
  add_shape(scene, quad_mesh(lamp.corner, lamp.edge_u, lamp.edge_v), Lambertian{Rgb(0.0f)}, nullptr, 0);
  add_shape(scene, quad_mesh(Vec3d(-3, 0, 3), Vec3d(6, 0, 0), Vec3d(0, 0, -6)), Lambertian{Rgb(0.6f)});
  if (ior > 0.0f) add_shape(scene, SphereShape{Vec3(0.0f, 0.8f, 0.0f), 0.3f}, Dielectric{ior});
  scene.camera = make_camera(Vec3(0.9f, 0.4f, 0.0f), Vec3(0.0f), Vec3(0, 1, 0), 30.0f, {kFilm, kFilm});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

RenderSettings settings_of(DirectLight direct, IndirectLight indirect) {
  RenderSettings settings;
  settings.photons_emitted = 200'000;
  settings.radii = RadiusSchedule::constant;
  settings.surface.radius = settings.caustics.radius = 0.06f;
  settings.surface_direct = direct;
  settings.surface_indirect = indirect;
  settings.caustics_emitted = indirect == IndirectLight::final_gather ? 50'000 : 0;
  return settings;
}

/// Every pixel's channels over passes, and after them those of the mean.
std::vector<Moments> pixels(const Scene& scene, RenderSettings settings, uint64_t seed) {
  settings.seed = seed;
  std::vector<Moments> result(3 * kFilm * kFilm + 3);
  for (int pass = 0; pass < 24; ++pass) {
    const Image image = render_photon_pass(scene, settings, pass, kGoOn).image;
    for (size_t i = 0; i < image.pixels.size(); ++i)
      for (int c = 0; c < 3; ++c) result[3 * i + static_cast<size_t>(c)].add(image.pixels[i][c]);
    const Rgbd mean = channel_means(image);
    for (int c = 0; c < 3; ++c) result[3 * image.pixels.size() + static_cast<size_t>(c)].add(mean[c]);
  }
  return result;
}

void expect_same(const std::vector<Moments>& a, const std::vector<Moments>& b) {
  for (size_t i = 0; i < a.size(); ++i) {
    const Check check = check_same("", a[i], b[i]);
    const bool of_mean = i >= a.size() - 3;
    EXPECT_GE(check.p, 0.5 * kFalseAlarms / (of_mean ? 3.0 : static_cast<double>(a.size() - 3)))
        << "pixel " << i / 3 << ", channel " << i % 3 << ": " << a[i].mean() << " against " << b[i].mean() << " +- "
        << check.error;
  }
}

/// The light's light is so smooth on the floor that the blur of 6 cm changes it by less than 0.1 %: a tenth of the
/// noise of pixels.
TEST(LectureChecks, PhotonsOfDirectLightLookLikeDirectLight) {
  const Scene scene = floor_under_lamp(0.0f);
  expect_same(pixels(scene, settings_of(DirectLight::photons, IndirectLight::photons), 1),
              pixels(scene, settings_of(DirectLight::shadow_rays, IndirectLight::photons), 2));
}

/// Shadow rays stop at the ball whatever its index: what they miss the caustic map brings, of photons that are aimed.
TEST(LectureChecks, ABallOfIndexOneLeavesNoShadow) {
  expect_same(pixels(floor_under_lamp(1.0f), settings_of(DirectLight::shadow_rays, IndirectLight::final_gather), 3),
              pixels(floor_under_lamp(0.0f), settings_of(DirectLight::shadow_rays, IndirectLight::photons), 4));
}

}  // namespace
}  // namespace vpm
