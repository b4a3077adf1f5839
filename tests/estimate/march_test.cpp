// The eye's march: exact where it must be, unbiased everywhere, whatever the steps.
#include "vpm/estimate/march.h"

#include <gtest/gtest.h>

#include "support/grids.h"
#include "support/statistics.h"

namespace vpm {
namespace {

const Ray kRay{Vec3(-2.0f, 0.1f, -0.2f), glm::normalize(Vec3(1.0f, 0.05f, 0.1f))};

Medium noise_medium(const Rgb& sigma_t) {
  const GridFrame frame = centered_frame(10, 0.1);
  return make_medium(
      make_grid(frame, [](int x, int y, int z) { return x % 5 == 0 ? 0.0 : 2.0 * lattice_noise(x, y, z); }), sigma_t);
}

TEST(March, IntegratesAConstantWithoutNoise) {
  for (const float sigma : {1e-7f, 0.3f, 20.0f})
    for (const StepLimits& limits : {StepLimits{0.05f, 10.0f}, StepLimits{0.7f, 0.2f}, StepLimits{100.0f, 1e9f}}) {
      const Medium medium = noise_medium(Rgb(sigma));
      Marcher marcher;
      Rng rng(1, 0, 0);
      double sum = 0.0;
      const Marched marched =
          marcher.march(medium, kRay, {0.0f, 4.0f}, limits, rng, [&](const Vec3&, const Rgb& w) { sum += w.r; });
      const double crossed = density_integral(medium, kRay, {0.0f, 4.0f}).value;
      EXPECT_NEAR(marched.integral, crossed, 1e-12);
      if (std::exp(-sigma * crossed) < 0.01) continue;  // roulette
      EXPECT_NEAR(sum, attenuated_integral(sigma, crossed), 1e-5 * crossed);
    }
}

/// f of the tests: a smooth function of position.
double probe(const Vec3& p) { return 1.0 + p.x + 0.5 * p.x * p.x; }

/// The integral of Tr density f by fine quadrature over the exact field.
double reference(const Medium& medium, float sigma, float t1, bool times_density) {
  constexpr int kSteps = 40000;
  double sum = 0.0, crossed = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double width = t1 / double(kSteps);
    const Vec3 p = kRay.at(static_cast<float>((i + 0.5) * width));
    const double density = medium.density(p);
    sum += std::exp(-sigma * (crossed + 0.5 * density * width)) * (times_density ? density : 1.0) * probe(p) * width;
    crossed += density * width;
  }
  return sum;
}

TEST(SlowMarch, IsUnbiasedForAnyStep) {
  const Rgb sigma(0.2f, 1.0f, 6.0f);
  const Medium medium = noise_medium(sigma);
  for (const StepLimits& limits :
       {StepLimits{0.06f, 0.5f}, StepLimits{0.8f, 1e9f}, StepLimits{50.0f, 0.7f}, StepLimits{50.0f, 1e9f}}) {
    std::array<Moments, 3> sums;
    Marcher marcher;
    for (uint64_t i = 0; i < 20000; ++i) {
      Rng rng(1, rng_stream(RngUse::test, 0), i);
      Rgb sum(0.0f);
      const Marched m = marcher.march(medium, kRay, {0.0f, 4.0f}, limits, rng,
                                      [&](const Vec3& p, const Rgb& w) { sum += w * static_cast<float>(probe(p)); });
      for (int c = 0; c < 3; ++c) sums[c].add(sum[c]);
      EXPECT_NEAR(m.integral, density_integral(medium, kRay, {0.0f, 4.0f}).value, 1e-12);
    }
    for (int c = 0; c < 3; ++c) expect_mean(sums[c], reference(medium, sigma[c], 4.0f, true), kFalseAlarms, "march");
  }
}

TEST(March, EndsInEndlessMediaThatAreClearInOneChannel) {
  const Medium medium = make_medium(nullptr, Rgb(0.5f, 0.0f, 0.2f));
  Marcher marcher;
  Rng rng(1, rng_stream(RngUse::test, 3), 0);
  const Marched marched =
      marcher.march(medium, kRay, {}, {0.5f, 0.3f, glm::bvec3(true, false, true)}, rng, [](auto&&...) {});
  EXPECT_LT(marched.steps, 1000u);
  EXPECT_EQ(transmittance(medium, marched.integral), Rgb(0.0f, 1.0f, 0.0f));
}

TEST(March, EvenStepsAreUnbiasedToo) {
  const Medium medium = noise_medium(Rgb(1.0f));
  const double exact = reference(medium, 1.0f, 4.0f, false);
  for (const float cut : {0.0f, 2.1f}) {  // in one march, and in two
    DensityIntegralsAlong integrals;
    integrals.walk(&medium, kRay, {0.0f, 4.0f});
    const SeenThrough seen{kRay, integrals, medium.sigma_t};
    Moments sums;
    for (uint64_t i = 0; i < 20000; ++i) {
      Rng rng(1, rng_stream(RngUse::test, 2), i);
      double sum = 0.0;
      const auto add = [&](const Vec3& p, const Rgb& w) { sum += w.r * probe(p); };
      if (cut > 0.0f) march_evenly(seen, {0.0f, cut}, 0.3f, rng, add);
      march_evenly(seen, {cut, 4.0f}, 0.3f, rng, add);
      sums.add(sum);
    }
    expect_mean(sums, exact, kFalseAlarms, "even steps");
  }
}

}  // namespace
}  // namespace vpm
