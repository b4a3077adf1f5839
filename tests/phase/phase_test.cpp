// Phase functions: normalisation, mean cosine, sampling against value, extreme anisotropy.
#include "vpm/phase/phase.h"

#include <gtest/gtest.h>

#include "support/statistics.h"
#include "vpm/base/rng.h"
#include "vpm/base/warp.h"

namespace vpm {
namespace {

const std::vector<Phase> kPhases{
    Isotropic{}, HenyeyGreenstein{0.0f}, HenyeyGreenstein{0.5f}, HenyeyGreenstein{-0.7f}, HenyeyGreenstein{0.95f},
    Rayleigh{}};

/// The integral of value(mu) f(mu) over the sphere between two cosines, by the midpoint rule.
template <class F>
double integrate(const Phase& phase, double lo, double hi, F&& f) {
  constexpr int kSteps = 200000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double mu = lo + (hi - lo) * (i + 0.5) / kSteps;
    sum += phase_value(phase, static_cast<float>(mu)) * f(mu);
  }
  return 2.0 * kPiD * sum * (hi - lo) / kSteps;
}

TEST(Phase, IsNormalisedWithTheStatedMeanCosine) {
  for (const Phase& phase : kPhases) {
    EXPECT_NEAR(integrate(phase, -1, 1, [](double) { return 1.0; }), 1.0, 1e-4);
    const double mean = std::visit([](const auto& p) { return p.mean_cosine(); }, phase);
    EXPECT_NEAR(integrate(phase, -1, 1, [](double mu) { return mu; }), mean, 1e-4);
  }
}

TEST(Phase, SamplesFollowTheValue) {
  // Chi-square over cosine and azimuth; false-alarm rate 1e-6 for each phase function.
  constexpr int kCosines = 20, kAzimuths = 8, kDraws = 200000;
  const Vec3 travel = glm::normalize(Vec3(0.3f, -0.8f, 0.5f));
  Vec3 s, t;
  make_frame(travel, s, t);
  for (const Phase& phase : kPhases) {
    std::vector<double> counts(kCosines * kAzimuths), probabilities(counts.size());
    std::vector<double> bin(kCosines);
    for (int c = 0; c < kCosines; ++c)
      bin[c] = integrate(phase, -1 + 2.0 * c / kCosines, -1 + 2.0 * (c + 1) / kCosines, [](double) { return 1.0; });
    for (int c = 0; c < kCosines; ++c)
      for (int a = 0; a < kAzimuths; ++a) probabilities[c * kAzimuths + a] = bin[c] / kAzimuths;
    double total = 0.0;
    for (const double p : probabilities) total += p;
    for (double& p : probabilities) p /= total;
    for (int i = 0; i < kDraws; ++i) {
      Rng rng(2, rng_stream(RngUse::test, 0), static_cast<uint64_t>(i));
      const Vec3 d = phase_sample(phase, travel, rng.uniform2());
      ASSERT_NEAR(glm::length(d), 1.0f, 1e-5f);
      const int c = std::clamp(static_cast<int>((glm::dot(d, travel) + 1.0f) / 2.0f * kCosines), 0, kCosines - 1);
      const double azimuth = std::atan2(glm::dot(d, t), glm::dot(d, s)) / (2.0 * kPiD);
      const int a = std::clamp(static_cast<int>((azimuth + 0.5) * kAzimuths), 0, kAzimuths - 1);
      ++counts[c * kAzimuths + a];
    }
    expect_distribution(counts, probabilities, 1e-6, "phase function");
  }
}

TEST(Phase, ForwardScatteringFavoursTheDirectionOfTravel) {
  EXPECT_GT(phase_value(HenyeyGreenstein{0.8f}, 1.0f), 100.0f * phase_value(HenyeyGreenstein{0.8f}, -1.0f));
  EXPECT_GT(phase_value(HenyeyGreenstein{-0.8f}, -1.0f), 100.0f * phase_value(HenyeyGreenstein{-0.8f}, 1.0f));
}

TEST(Phase, ExtremeAnisotropyKeepsItsMeanCosine) {
  for (const float g : {0.9999f, -0.9999f}) {
    Moments away;
    for (uint64_t i = 0; i < 100000; ++i) {
      Rng rng(2, rng_stream(RngUse::test, 1), i);
      const Vec3 d = phase_sample(HenyeyGreenstein{g}, Vec3(0, 0, 1), rng.uniform2());
      ASSERT_TRUE(is_finite(d));
      away.add(d.z);
    }
    expect_mean(away, g, 1e-6, "mean cosine");
    EXPECT_TRUE(std::isfinite(phase_value(HenyeyGreenstein{g}, 1.0f)));
  }
}

}  // namespace
}  // namespace vpm
