// Airlight against reference numbers, and against what holds exactly.
#include "vpm/study/exact/airlight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "study/oracles.h"
#include "vpm/base/vec.h"
#include "vpm/study/exact/quadrature.h"

namespace vpm::exact {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST(ExactAirlight, IsAsTheOracleSays) {
  for (const auto& oracle : oracle_cases("s3_airlight")) {
    SCOPED_TRACE(oracle.at("id"));
    const double t1 = oracle.at("t1").is_string() ? kInfinite : oracle.at("t1").get<double>();
    const AirlightSolution ours = solve_airlight({oracle.at("sigma_t"), oracle.at("albedo"), oracle.at("g"),
                                                  oracle.at("d"), oracle.at("t_l"), oracle.at("t0"), t1});
    const double error = oracle.at("rel_err").get<double>() + 2e-13, log10_l = oracle.at("log10_L");
    EXPECT_NEAR(ours.radiance.value, oracle.at("L"), error * ours.radiance.value);
    EXPECT_LE(ours.radiance.error, 2e-12 * ours.radiance.value);
    EXPECT_NEAR(ours.log10_radiance, log10_l, 2e-14 * std::abs(log10_l) + 1e-13);
  }
}

// In a medium too thin to attenuate, isotropic scattering over the whole ray has the closed form sigma_s (pi - psi0) /
// (4 pi d), psi0 the angle at which the source sees the camera.
TEST(ExactAirlight, ThinMediaHaveAClosedForm) {
  const double d = 0.7, closest = 2.0, sigma_t = 1e-14;
  const AirlightSolution ours = solve_airlight({sigma_t, 1.0, 0.0, d, closest, 0.0, kInfinite});
  const double psi0 = std::atan2(d, closest);
  EXPECT_NEAR(ours.radiance.value, sigma_t * (kPiD - psi0) / (4.0 * kPiD * d), 1e-11 * ours.radiance.value);
}

// The integral as it stands, without our substitution.
TEST(ExactAirlight, IsTheIntegralOverTheRay) {
  for (const double g : {-0.9, 0.0, 0.6}) {
    const Airlight a{1.3, 0.8, g, 0.4, 0.9, 0.2, 2.5};
    const Bounded direct = integrate(
        [&](double t) {
          const double r = std::hypot(a.distance, t - a.closest), cosine = (a.closest - t) / r;
          const double phase = (1.0 - g * g) / (4.0 * kPiD * std::pow(1.0 + g * g - 2.0 * g * cosine, 1.5));
          return a.albedo * a.sigma_t * phase * std::exp(-a.sigma_t * (t + r)) / (r * r);
        },
        a.t0, a.t1);
    const Bounded ours = solve_airlight(a).radiance;
    EXPECT_NEAR(ours.value, direct.value, ours.error + direct.error);
  }
}

// The same of a beam's closed form, from behind, aside and into a narrow peak.
TEST(ExactAirlight, OfABeamIsTheIntegralOverTheChord) {
  for (const auto& [g, cosine] : {std::pair(0.0, 0.9), std::pair(-0.4, 0.0), std::pair(0.999, -0.9999)}) {
    const BeamAirlight a{0.02, 0.8, g, 0.5, cosine, 50.0, 40.0};
    const double half = a.beam_radius / std::sqrt(1.0 - cosine * cosine);
    const double phase = (1.0 - g * g) / (4.0 * kPiD * std::pow(1.0 + g * g + 2.0 * g * cosine, 1.5));
    const Bounded direct = integrate(
        [&](double t) {
          return a.albedo * a.sigma_t * phase * std::exp(-a.sigma_t * (a.flown + t * cosine + a.seen + t));
        },
        -half, half);
    const Bounded ours = solve_beam_airlight(a);
    EXPECT_NEAR(ours.value, direct.value, ours.error + direct.error + 1e-12 * direct.value);
  }
}

TEST(ExactAirlight, StretchesAddUp) {
  Airlight whole{2.0, 0.9, 0.99, 1e-3, 1.0, 0.0, kInfinite}, near = whole, far = whole;
  near.t1 = far.t0 = 1.0005;
  const double sum = solve_airlight(near).radiance.value + solve_airlight(far).radiance.value;
  EXPECT_NEAR(sum, solve_airlight(whole).radiance.value, 1e-12 * sum);
}

}  // namespace
}  // namespace vpm::exact
