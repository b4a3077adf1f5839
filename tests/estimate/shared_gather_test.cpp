// When one ray's gather stands for its neighbours', and by how much that blurs beside kernels.
#include "vpm/estimate/shared_gather.h"

#include <gtest/gtest.h>

#include "vpm/estimate/gather.h"
#include "vpm/medium/phase/phase.h"

namespace vpm {
namespace {

// The second moments of all kernels, by the integral of the part of the kernel beyond each distance: the mean of the
// square of the distance is that of 2 t (1 - within(t)).
TEST(SharedGather, KernelVariancesAreSecondMoments) {
  for (const KernelInfo& info : kKernels)
    for (int dimension = 1; dimension <= 3; ++dimension) {
      constexpr int kSteps = 20'000;
      double mean = 0.0;
      for (int i = 0; i < kSteps; ++i) {
        const double t = (i + 0.5) / kSteps;
        mean += 2.0 * t * (1.0 - kernel_within(info.kind, dimension, t).value) / kSteps;
      }
      EXPECT_NEAR(kernel_variance(info.kind, dimension), mean / dimension, 1e-6) << info.name << dimension;
    }
}

TEST(SharedGather, SquaresHaveTheVarianceOfTwoPlaces) {
  for (int edge = 1; edge <= 4; ++edge) {
    double sum = 0.0;
    for (int a = 0; a < edge; ++a)
      for (int b = 0; b < edge; ++b) sum += double(a - b) * (a - b);
    EXPECT_FLOAT_EQ(variance_in_square(edge), static_cast<float>(sum / (edge * edge)));
  }
}

TEST(SharedGather, BlursAtMostAQuarterOfKernels) {
  const SharedGather shared(1e-4f);
  const float kernels = variance_of({.radius = 0.3f}, 2);  // 0.015 m^2
  EXPECT_FLOAT_EQ(shared.blur(2.0f, kernels).value(), 1e-4f * 4.0f / 0.015f);
  EXPECT_TRUE(shared.blur(6.0f, kernels));
  EXPECT_FALSE(shared.blur(6.2f, kernels));
  EXPECT_FALSE(shared.blur(0.0f, 0.0f));
  EXPECT_FALSE(shared.blur(0.0f, variance_of({.radius = 0.3f, .kernel = KernelKind::order_4}, 2)));
  EXPECT_FALSE(shared.blur(0.0f, variance_of({.mode = GatherMode::nearest, .radius = 0.3f}, 2)));
}

// Over twice the standard deviation from the peak, a function that counts as smooth falls by less than 3 %.
TEST(SharedGather, PeaksOfPhaseFunctionsAreNotBlurred) {
  for (const float g : {0.0f, 0.3f, -0.8f, 0.95f, 0.999f}) {
    const HenyeyGreenstein phase{g};
    float variance = 1.0f;
    while (!is_smooth_over(phase, variance)) variance *= 0.9f;
    const float away = 2.0f * std::sqrt(variance), peak = g < 0.0f ? -1.0f : 1.0f;
    EXPECT_GT(phase.value(peak * std::cos(away)), 0.97f * phase.value(peak)) << g;
    EXPECT_GT(variance, 1e-4f * (1.0f - std::abs(g)) * (1.0f - std::abs(g))) << g;
  }
  EXPECT_FALSE(is_smooth_over(Phase(Tabulated{}), 1e-12f));
  // A narrow lobe that has little of the light.
  EXPECT_FALSE(is_smooth_over(Phase(TwoLobes(0.99f, 0.0f, 0.001f)), 1e-4f));
  EXPECT_TRUE(is_smooth_over(Phase(TwoLobes(0.5f, 0.0f, 0.001f)), 1e-4f));
  EXPECT_FALSE(is_smooth_over(Phase(Droplets(50.0f)), 1e-4f));
}

TEST(SharedGather, RaysSeeTheSame) {
  const SeenSegment one{.medium = 0, .shape = 3, .end = Vec3(0, 1, 0), .length = 2.0f};
  const auto changed = [&](auto&& change) {
    SeenSegment other = one;
    change(other);
    return is_alike(one, other);
  };
  EXPECT_TRUE(changed([](SeenSegment& s) { s.length = 2.09f; }));
  EXPECT_FALSE(changed([](SeenSegment& s) { s.length = 2.2f; }));
  EXPECT_FALSE(changed([](SeenSegment& s) { s.medium = 1; }));
  EXPECT_FALSE(changed([](SeenSegment& s) { s.shape = 4; }));
  EXPECT_FALSE(changed([](SeenSegment& s) { s.shape = -1; }));
  EXPECT_FALSE(changed([](SeenSegment& s) { s.end = Vec3(1, 0, 0); }));
  const SeenSegment endless{.medium = 0, .length = kInfinity};
  EXPECT_TRUE(is_alike(endless, endless));
}

}  // namespace
}  // namespace vpm
