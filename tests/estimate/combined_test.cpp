// The combined estimator: its maps, and that its pictures depend on no threads.
#include "vpm/estimate/combined/combined.h"

#include <gtest/gtest.h>

#include <set>

#include "support/scenes.h"
#include "vpm/base/parallel.h"
#include "vpm/base/warp.h"
#include "vpm/image/metrics.h"
#include "vpm/render/combined_pass.h"

namespace vpm {
namespace {

const std::atomic<bool> kGoOn{false};

Vec3 random_place(Rng& rng) { return 2.0f * Vec3(rng.uniform(), rng.uniform(), rng.uniform()); }

TEST(VertexMap, FindsWhatASearchThroughAllFinds) {
  constexpr float kRadius = 0.15f;
  for (const int count : {0, 1, 17, 3000}) {
    Rng rng(1, rng_stream(RngUse::test, 1), static_cast<uint64_t>(count));
    std::vector<Vec3> positions;
    for (int i = 0; i < count; ++i) positions.push_back(random_place(rng));
    const VertexMap map(positions, kRadius);
    for (int query = 0; query < 50; ++query) {
      const Vec3 point = random_place(rng);
      const Ray ray{point, uniform_sphere(rng.uniform2())};
      const Interval interval{0.2f, 1.1f};
      std::set<uint32_t> near, beside, near_found, beside_found;
      for (uint32_t i = 0; i < positions.size(); ++i) {
        const Vec3 offset = positions[i] - point;
        const float t = glm::dot(offset, ray.direction), square = glm::dot(offset, offset);
        if (square < kRadius * kRadius) near.insert(i);
        if (t >= interval.t0 && t < interval.t1 && square - t * t < kRadius * kRadius) beside.insert(i);
      }
      map.visit_near(point, [&](uint32_t i, float) { EXPECT_TRUE(near_found.insert(i).second); });
      map.visit_near_ray(ray, interval, [&](uint32_t i, float) { EXPECT_TRUE(beside_found.insert(i).second); });
      EXPECT_EQ(near_found, near);
      EXPECT_EQ(beside_found, beside);
    }
  }
}

/// A box of fog over a floor, which the camera sees from outside.
Scene foggy_box() {
  Scene scene;
  scene.media.push_back(make_medium(nullptr, Rgb(0.8f, 1.0f, 1.3f), 0.7f));
  const Interface media{0, kVacuum};
  add_shape(scene, box_mesh(Vec3d(-1.0), Vec3d(1.0)), Boundary{}, &media);
  add_shape(scene, quad_mesh(Vec3d(-3, -1.1, 3), Vec3d(6, 0, 0), Vec3d(0, 0, -6)), Lambertian{Rgb(0.6f)});
  scene.lights.push_back(PointLight{Vec3(0.3f, 2.0f, 0.4f), Rgb(5.0f)});
  scene.camera = make_camera(Vec3(0.5f, 1.0f, 4.0f), Vec3(0.0f), Vec3(0, 1, 0), 40.0f, {24, 20});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

RenderSettings combined_settings_of(uint64_t paths) {
  RenderSettings settings;
  settings.integrator = Integrator::combined;
  settings.photons_emitted = paths;
  settings.volume.radius = settings.surface.radius = 0.1f;
  return settings;
}

TEST(Combined, IsTheSameBitForBitOnAnyNumberOfThreads) {
  const Scene scene = foggy_box();
  const RenderSettings settings = combined_settings_of(5'000);
  set_threads(1);
  const Image one = render_combined_pass(scene, settings, 3, kGoOn).image;
  set_threads(3);
  const Image three = render_combined_pass(scene, settings, 3, kGoOn).image;
  set_threads(0);
  EXPECT_EQ(one.pixels, three.pixels);
}

/// The mean of many passes by one technique, and the relative square error of another's, moved by so many columns.
Image mean_picture(const Scene& scene, Technique technique, uint64_t seed) {
  RenderSettings settings = combined_settings_of(20'000);
  settings.seed = seed;
  for (const TechniqueInfo& info : kTechniques)
    settings.combined.techniques.set(info.technique, info.technique == technique);
  constexpr int kPasses = 40;
  Image sum(scene.camera.width, scene.camera.height);
  for (int pass = 0; pass < kPasses; ++pass) {
    const Image image = render_combined_pass(scene, settings, pass, kGoOn).image;
    for (size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += image.pixels[i] / float{kPasses};
  }
  return sum;
}

double difference(const Image& a, const Image& b, int columns) {
  double sum = 0.0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 1; x + 1 < a.width; ++x) {
      const double d = a.at(x, y).g - b.at(x + columns, y).g;
      sum += d * d;
    }
  return sum;
}

/// A floor behind a filter that reaches into neighbouring pixels: light tracing finds the same light as light that is
/// sampled, in the mean and pixel by pixel.
TEST(Combined, LightTracingFillsPixelsAsTheirFiltersSay) {
  Scene scene = foggy_box();
  scene.camera.filter = {FilterKind::tent, 1.0f};
  const Image traced = mean_picture(scene, Technique::light_tracing, 1);
  const Image sampled = mean_picture(scene, Technique::connections, 2);
  EXPECT_NEAR(channel_means(traced).g / channel_means(sampled).g, 1.0, 0.02);
  const double here = difference(traced, sampled, 0);
  EXPECT_LT(here, 0.5 * difference(traced, sampled, 1));
  EXPECT_LT(here, 0.5 * difference(traced, sampled, -1));
}

}  // namespace
}  // namespace vpm
