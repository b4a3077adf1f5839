// Pictures of white furnaces with large radii: white up to the borders where estimates are corrected, with dark rims
// where they are not.
#include <gtest/gtest.h>

#include "support/scenes.h"
#include "support/statistics.h"
#include "vpm/base/progress.h"
#include "vpm/base/tails.h"
#include "vpm/render/photon_pass.h"

namespace vpm {
namespace {

constexpr double kFalseAlarms = 1e-6;  // of each comparison

struct Picture {
  Moments means;  // over the pixels, pass by pass
  GatherCounters gather;
};
Picture render(const Scene& scene, const RenderSettings& settings, int passes) {
  Picture picture;
  for (int pass = 0; pass < passes; ++pass) {
    const Pass found = render_photon_pass(scene, settings, pass, kGoOn);
    double sum = 0.0;
    for (const Rgb& p : found.image.pixels) sum += p.g / static_cast<double>(found.image.pixels.size());
    picture.means.add(sum);
    picture.gather.merge(found.statistics.eye.gather);
  }
  return picture;
}

RenderSettings settings_of(float radius, BoundaryRule rule) {
  RenderSettings settings;
  settings.photons_emitted = 10000;
  settings.radii = RadiusSchedule::constant;
  settings.volume.radius = settings.surface.radius = radius;
  settings.volume.boundary = settings.surface.boundary = rule;
  settings.surface_direct = DirectLight::photons;
  return settings;
}

/// Radiance 1 is expected, to the given bias; without the correction at most `plain`.
void expect_white(const Scene& scene, float radius, double bias, double plain) {
  const Picture corrected = render(scene, settings_of(radius, BoundaryRule::corrected), 24);
  const double noise = normal_quantile(kFalseAlarms) * std::sqrt(corrected.means.variance_of_mean());
  EXPECT_NEAR(corrected.means.mean(), 1.0, bias + noise);
  EXPECT_LT(noise, 0.05);
  EXPECT_GT(corrected.gather.corrected, 0u);
  EXPECT_EQ(corrected.gather.least_shares, 0u);
  const Picture dark = render(scene, settings_of(radius, BoundaryRule::none), 8);
  EXPECT_LT(dark.means.mean(), plain);
  EXPECT_EQ(dark.gather.corrected, 0u);
}

TEST(SlowBoundaries, AWhiteMediumIsWhiteUpToItsFaces) {
  Medium medium = make_medium(nullptr, Rgb(1.5f), 1.0f);
  medium.phase = HenyeyGreenstein{0.3f};
  Scene scene = boxed_medium(medium, ConstantEnvironment{Rgb(1.0f)});
  scene.camera = make_camera(Vec3(3.0f, 2.5f, 4.0f), Vec3(0.0f), Vec3(0, 1, 0), 14.0f, {8, 8});
  expect_white(scene, 0.6f, 0.005, 0.85);
}

TEST(SlowBoundaries, AWhiteGridIsWhiteWhereItsDensityEnds) {
  GridFrame frame;
  frame.hi = Vec3i(11);
  frame.interpolation = Interpolation::nearest;
  frame.index_to_world = glm::translate(glm::scale(Mat4d(1.0), Vec3d(2.0 / 12.0)), Vec3d(-5.5));
  // A ball of voxels: the box around it is empty in its corners.
  const auto density = [](int x, int y, int z) {
    return glm::length(Vec3d(x, y, z) - 5.5) < 5.0 ? 1.0 + 0.5 * lattice_noise(x, y, z) : 0.0;
  };
  Scene scene = boxed_medium(make_medium(make_grid(frame, density), Rgb(1.5f), 1.0f), ConstantEnvironment{Rgb(1.0f)});
  scene.camera = make_camera(Vec3(3.0f, 2.5f, 4.0f), Vec3(0.0f), Vec3(0, 1, 0), 14.0f, {8, 8});
  expect_white(scene, 0.4f, 0.01, 0.92);
}

TEST(Boundaries, AWhiteSheetIsWhiteUpToItsCorner) {
  Scene scene;
  add_shape(scene, quad_mesh(Vec3d(-1, 0, 1), Vec3d(2, 0, 0), Vec3d(0, 0, -2)), Lambertian{Rgb(1.0f)});
  scene.lights.push_back(ConstantEnvironment{Rgb(1.0f)});
  scene.camera = make_camera(Vec3(0.72f, 4.0f, 0.72f), Vec3(0.72f, 0.0f, 0.72f), Vec3(1, 0, 0), 7.0f, {8, 8});
  scene.geometry.commit();
  finish(scene);
  expect_white(scene, 0.5f, 0.005, 0.75);
}

}  // namespace
}  // namespace vpm
