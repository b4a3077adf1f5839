// The exact picture of a ball of fog: where it is known without any theory, against the path tracer, and what is
// refused.
#include "vpm/study/compare/exact_picture.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/statistics.h"
#include "vpm/base/error.h"
#include "vpm/base/statistics/tails.h"
#include "vpm/integrators/path/path_tracer.h"
#include "vpm/medium/grid/make_grid.h"
#include "vpm/scene/build.h"
#include "vpm/study/sample_moments.h"

namespace vpm {
namespace {

const Vec3 kCenter(0.5f, -1.0f, 2.0f);
constexpr float kRadius = 1.5f;
const Rgb kSky(0.5f, 1.0f, 2.0f);

Medium fog(const Rgb& sigma_t, const Rgb& albedo) {
  Medium medium;
  medium.sigma_t = sigma_t;
  medium.sigma_s = albedo * sigma_t;
  medium.phase = Isotropic{};
  return medium;
}

/// The ball with that in it, before finish().
Scene ball_of(const Medium& medium, const Material& material = Boundary{}) {
  Scene scene;
  scene.media.push_back(medium);
  const Interface media{0, kVacuum};
  add_shape(scene, SphereShape{kCenter, kRadius}, material, &media);
  scene.lights.push_back(ConstantEnvironment{kSky});
  scene.camera = make_camera(kCenter + Vec3(1.0f, 2.0f, 5.0f), kCenter, Vec3(0, 1, 0), 40.0f, {24, 16});
  return scene;
}
Scene finished(Scene scene) {
  scene.geometry.commit();
  finish(scene);
  return scene;
}

TEST(ExactPicture, WhiteFogCannotBeSeen) {
  const Image image = exact_picture(finished(ball_of(fog(Rgb(0.2f, 2.0f, 20.0f), Rgb(1.0f)))));
  for (const Rgb& p : image.pixels)
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(p[c], kSky[c], 1e-5f * kSky[c]);
}

/// How long the ray is in the ball, m.
double chord(const Ray& ray) {
  const Vec3d to_center = Vec3d(kCenter) - Vec3d(ray.origin);
  const double along = glm::dot(to_center, Vec3d(ray.direction));
  const double beside2 = glm::dot(to_center, to_center) - along * along;
  return 2.0 * std::sqrt(std::max(0.0, static_cast<double>(kRadius) * kRadius - beside2));
}

// The last channel is all but opaque: a step at the rim.
TEST(SlowExactPicture, BlackFogOnlyAttenuates) {
  constexpr int kAlong = 500;  // rays along each side of a pixel
  const Rgb sigma_t(0.0f, 0.3f, 50.0f);
  const Scene scene = finished(ball_of(fog(sigma_t, Rgb(0.0f))));
  const Image image = exact_picture(scene);
  int whole = 0, cut = 0;
  for (int y = 0; y < image.height; y += 4)
    for (int x = 0; x < image.width; x += 3) {
      Rgbd sum(0.0);
      int met = 0;
      for (int i = 0; i < kAlong * kAlong; ++i) {
        const double in = chord(scene.camera.ray(Vec2(x, y) + (Vec2(i % kAlong, i / kAlong) + 0.5f) / 500.0f));
        met += in > 0.0;
        sum += glm::exp(-in * Rgbd(sigma_t));
      }
      const bool rim = met > 0 && met < kAlong * kAlong;
      ++(rim ? cut : whole);
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(image.at(x, y)[c] / kSky[c], sum[c] / (kAlong * kAlong), rim ? 2e-3 : 1e-4) << x << ", " << y;
    }
  EXPECT_GT(whole, 20);
  EXPECT_GE(cut, 3);
}

TEST(SlowExactPicture, IsWhatThePathTracerSees) {
  const Scene scene = finished(ball_of(fog(Rgb(0.5f, 1.0f, 2.0f), Rgb(0.5f, 0.9f, 0.99f))));
  const Image image = exact_picture(scene);
  const PathContext context = make_path_context(scene, {});
  for (const Vec2& pixel : {Vec2(11, 7), Vec2(8, 4), Vec2(15, 10), Vec2(1, 1)}) {
    const auto radiance = sample_moments(3, 30'000, 5, [&](Rng& rng, double* out) {
      EyeCounters counters;
      const Ray ray = scene.camera.ray(pixel + rng.uniform2());
      const Rgb seen = path_radiance(context, ray, scene.camera_medium, rng, counters);
      for (int c = 0; c < 3; ++c) out[c] = seen[c];
    });
    const Rgb& exact = image.at(static_cast<int>(pixel.x), static_cast<int>(pixel.y));
    for (int c = 0; c < 3; ++c) {
      const double noise = normal_quantile(kFalseAlarms) * std::sqrt(radiance[c].variance_of_mean());
      EXPECT_NEAR(radiance[c].mean(), exact[c], noise + 1e-5 * kSky[c]) << pixel.x << ", " << pixel.y;
      EXPECT_LT(noise, 0.05 * kSky[c]);
    }
  }
}

void expect_refused(const Scene& scene, const std::string& why) {
  try {
    exact_picture(scene);
    ADD_FAILURE() << "not refused: " << why;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
  }
}

TEST(ExactPicture, RefusesWhatTheoryDoesNotKnow) {
  const Medium known = fog(Rgb(1.0f), Rgb(0.9f));
  Medium forward = known, grid = known;
  forward.phase = HenyeyGreenstein{0.5f};
  grid.grid = make_grid(centered_frame(4, 1.0), [](int, int, int) { return 1.0f; });
  expect_refused(finished(ball_of(forward)), "isotropically");
  expect_refused(finished(ball_of(grid)), "grid");
  expect_refused(finished(ball_of(known, Lambertian{Rgb(0.5f)})), "boundary");
  Scene empty = ball_of(known);
  std::swap(empty.shapes[0].media.inside, empty.shapes[0].media.outside);
  expect_refused(finished(std::move(empty)), "does not hold fog in vacuum");
  Scene two = ball_of(known), lamp = ball_of(known), inside = ball_of(known);
  const Interface media{0, kVacuum};
  add_shape(two, SphereShape{kCenter + 5.0f, 1.0f}, Boundary{}, &media);
  expect_refused(finished(std::move(two)), "one shape");
  lamp.lights.push_back(PointLight{kCenter + 9.0f, Rgb(1.0f)});
  expect_refused(finished(std::move(lamp)), "its light is no");
  inside.camera = make_camera(kCenter, kCenter + 1.0f, Vec3(0, 1, 0), 40.0f, {4, 4});
  inside.camera_medium = 0;
  expect_refused(finished(std::move(inside)), "camera");
  Scene box;
  box.media.push_back(known);
  add_shape(box, box_mesh(Vec3d(-1.0), Vec3d(1.0)), Boundary{}, &media);
  box.lights.push_back(ConstantEnvironment{kSky});
  expect_refused(finished(std::move(box)), "no sphere");
}

}  // namespace
}  // namespace vpm
