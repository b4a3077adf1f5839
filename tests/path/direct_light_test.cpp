// Shadow rays take transmittances as estimators give them: below 0, above 1, in every medium crossed.
#include "vpm/path/direct_light.h"

#include <gtest/gtest.h>

#include "support/scenes.h"
#include "support/statistics.h"
#include "vpm/base/statistics/tails.h"
#include "vpm/integrators/path/path_tracer.h"

namespace vpm {
namespace {

/// Says the same of every stretch.
class Stub final : public TransmittanceEstimator {
 public:
  explicit Stub(const Rgb& value) : value_(value) {}
  TransmittanceEstimate estimate(const Medium&, const Ray&, const Interval&, Rng&) const override {
    return {value_, 3};
  }

 private:
  Rgb value_;
};

TEST(DirectLight, TransmittancesBelowZeroAndAboveOneAreKept) {
  // From outside the box to a lamp in it, one medium; through the box to a light behind it, the same.
  const Stub estimator(Rgb(-0.5f, 3.0f, 0.0f));
  Rng rng(1, 0, 0);
  WalkCounters counters;
  const Scene scene = boxed_medium(make_medium(nullptr, Rgb(1.0f)), PointLight{Vec3(0.0f), Rgb(1.0f)});
  const ShadowRays rays{scene, estimator, rng, counters};
  const Ray ray{Vec3(-3.0f, 0.1f, 0.2f), Vec3(1, 0, 0)};
  EXPECT_EQ(visibility(rays, ray, 3.0f, 0, kVacuum), Rgb(-0.5f, 3.0f, 0.0f));
  EXPECT_EQ(visibility(rays, ray, 6.0f, 0, kVacuum), Rgb(-0.5f, 3.0f, 0.0f));
  EXPECT_EQ(counters.lookups, 6u);
  const DirectSample sample = sample_direct(rays, 0, {Vec3(-3.0f, 0.0f, 0.0f), kVacuum});
  EXPECT_FLOAT_EQ(sample.irradiance.r, -0.5f / 9.0f);
  EXPECT_FLOAT_EQ(sample.irradiance.g, 3.0f / 9.0f);
}

TEST(SlowDirectLight, ThePathTracerKeepsNegativeSamples) {
  // A light behind a slab that is denser than a march can see: many samples are negative, none is dropped, and their
  // mean is that of the exact estimator.
  const GridFrame frame = centered_frame(10, 0.1, Interpolation::nearest);
  const auto sheets = make_grid(frame, [](int x, int, int) { return x == -3 || x == 4 ? 5.0 : 0.0; });
  Scene scene;
  scene.media.push_back(make_medium(sheets, Rgb(4.0f), 0.0f));
  const Interface media{0, kVacuum};
  add_shape(scene, box_mesh(Vec3d(-1.0), Vec3d(1.0)), Boundary{}, &media);
  scene.lights.push_back(PointLight{Vec3(-3.0f, 0, 0), Rgb(1.0f)});
  add_shape(scene, quad_mesh(Vec3(2, -1, 1), Vec3(0, 0, -2), Vec3(0, 2, 0)), Lambertian{Rgb(0.8f)});
  scene.geometry.commit();
  finish(scene);
  const Ray ray{Vec3(1.5f, 0.3f, 0.2f), Vec3(1, 0, 0)};
  const auto samples = [&](const char* estimator) {
    RenderSettings settings;
    settings.transmittance.estimator = estimator;
    const PathContext context = make_path_context(scene, settings);
    EyeCounters counters;
    std::pair<Moments, int> found;
    for (uint64_t i = 0; i < 200000; ++i) {
      Rng rng(2, rng_stream(RngUse::test, 0), i);
      const float radiance = path_radiance(context, ray, kVacuum, rng, counters).r;
      found.first.add(radiance);
      found.second += radiance < 0.0f;
    }
    EXPECT_EQ(counters.non_finite, 0u);
    return found;
  };
  const auto exact = samples("regular"), march = samples("unbiased-ray-march");
  EXPECT_EQ(exact.second, 0);
  EXPECT_GT(march.second, 100);
  const double error = std::sqrt(exact.first.variance_of_mean() + march.first.variance_of_mean());
  EXPECT_LT(error, 0.1 * exact.first.mean());
  EXPECT_LT(std::abs(march.first.mean() - exact.first.mean()), normal_quantile(1e-6) * error);  // false alarms: 1e-6
}

/// A floor at y = 0 and a wall at z = 0, whose coordinates have no rounding to stay clear of: rays that go as far as a
/// place on one of them may meet it just before.
TEST(DirectLight, PlacesOnSurfacesAreSeen) {
  const Stub estimator(Rgb(1.0f));
  WalkCounters counters;
  Scene scene;
  const int floor = static_cast<int>(
      add_shape(scene, quad_mesh(Vec3d(0.0), Vec3d(0.0, 0.0, 3.0), Vec3d(3.0, 0.0, 0.0)), Lambertian{Rgb(0.5f)}));
  add_shape(scene, quad_mesh(Vec3d(0.0), Vec3d(3.0, 0.0, 0.0), Vec3d(0.0, 3.0, 0.0)), Lambertian{Rgb(0.5f)});
  scene.geometry.commit();
  Rng rng(1, 0, 0);
  const ShadowRays rays{scene, estimator, rng, counters};
  for (int i = 0; i < 10'000; ++i) {
    const Vec2 from = 0.01f + 2.9f * rng.uniform2(), to = 0.01f + 2.9f * rng.uniform2();
    const Vec3 way = Vec3(to.x, 0.0f, to.y) - Vec3(from.x, from.y, 0.0f);
    const float length = glm::length(way);
    const Ray ray{Vec3(from.x, from.y, 0.0f), way / length};
    EXPECT_EQ(visibility_of_place(rays, ray, length, kVacuum, floor), Rgb(1.0f));
    EXPECT_EQ(visibility_of_place(rays, ray, 1.01f * length, kVacuum, floor), Rgb(0.0f)) << "behind the floor";
  }
}

}  // namespace
}  // namespace vpm
