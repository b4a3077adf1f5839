// Free flights along a ray against reference numbers, and against what holds exactly.
#include "vpm/study/exact/profile.h"

#include <gtest/gtest.h>

#include <cmath>

#include "study/oracles.h"
#include "vpm/study/exact/quadrature.h"

namespace vpm::exact {
namespace {

using Json = nlohmann::json;

double number(const Json& value) {
  return value.is_string() ? std::stod(value.get<std::string>()) : value.get<double>();
}

Profile voxel_of(const Json& params) {
  double corners[2][2][2];
  for (int x = 0; x < 2; ++x)
    for (int y = 0; y < 2; ++y)
      for (int z = 0; z < 2; ++z) corners[x][y][z] = number(params.at("corner_density_xyz")[x][y][z]);
  const auto point = [](const Json& p) { return Vec3d(number(p[0]), number(p[1]), number(p[2])); };
  return voxel_profile(corners, number(params.at("scale")), point(params.at("p0")), point(params.at("p1")));
}

Profile profile_of(const Json& oracle) {
  const std::string kind = oracle.at("kind");
  const Json& params = oracle.at("params");
  const double length = oracle.at("L");
  const auto get = [&](const char* name) { return number(params.at(name)); };
  if (kind == "homogeneous") return {ConstantProfile{get("sigma_t")}, length};
  if (kind == "linear_ramp") return {RampProfile{get("sigma0"), (get("sigmaL") - get("sigma0")) / length}, length};
  if (kind == "exponential_atmosphere")
    return {ExponentialProfile{get("sigma0") * std::exp(-get("h0") / get("H")), get("mu") / get("H")}, length};
  if (kind == "gaussian_blob") {
    const double b = get("impact") / get("width");
    return {GaussianProfile{get("sigma0") * std::exp(-0.5 * b * b), get("width"), get("t_closest")}, length};
  }
  if (kind == "piecewise_constant") {
    std::vector<double> ends = params.at("boundaries");
    ends.erase(ends.begin());
    return {LayeredProfile{ends, params.at("sigma")}, length};
  }
  EXPECT_EQ(kind, "trilinear_voxel");
  return voxel_of(params);
}

// The oracle's parameters may have been rounded from decimals on their way to us.
constexpr double kParameters = 2e-15;

void expect_near(const Bounded& ours, double oracle) {
  EXPECT_NEAR(ours.value, oracle, ours.error + kParameters * std::abs(oracle));
}

void expect_quantile(const Profile& profile, double u, const Json& oracle) {
  const std::optional<Bounded> t = flight_quantile(profile, u);
  ASSERT_EQ(t.has_value(), !oracle.is_null()) << u;
  if (!t) return;
  EXPECT_NEAR(t->value, oracle.get<double>(), 2.0 * t->error) << u;
  EXPECT_LT(t->error, 1e-12 * t->value) << u;
}

TEST(ExactProfile, IsAsTheOracleSays) {
  for (const auto& oracle : oracle_cases("s1_freeflight")) {
    SCOPED_TRACE(oracle.at("id"));
    const Profile profile = profile_of(oracle);
    EXPECT_NEAR(profile.length, oracle.at("L"), 4e-16 * profile.length);
    expect_near(optical_thickness(profile, profile.length), oracle.at("tau_total"));
    expect_near(collision_cdf(profile, profile.length), oracle.at("collision_probability"));
    expect_near(mean_flight(profile), oracle.at("mean_min_t_L"));
    for (const Json& at : oracle.at("profile")) {
      const double t = std::min(at.at("t").get<double>(), profile.length);
      if (t < profile.length) {  // at the end of the last layer, extinction is the next one's
        EXPECT_NEAR(extinction(profile, t), at.at("sigma_t"), 1e-14 * extinction(profile, t)) << t;
      }
      expect_near(optical_thickness(profile, t), at.at("tau"));
      // A relative error of tau is an absolute one of its exponential.
      const double tau = at.at("tau"), through = at.at("transmittance");
      EXPECT_NEAR(transmittance(profile, t).value, through,
                  transmittance(profile, t).error + kParameters * (1.0 + tau) * through);
    }
    const double collisions = oracle.at("collision_probability");
    for (const Json& at : oracle.at("quantiles")) {
      const double u = at.at("u");
      expect_quantile(profile, u, at.at("t"));
      if (u * collisions < 0.9) expect_quantile(profile, u * collisions, at.at("t_conditional"));
    }
  }
}

TEST(ExactProfile, QuantilesInvertTheDistribution) {
  const double corners[2][2][2] = {{{0.0, 1e-12}, {0.0, 2.0}}, {{0.0, 0.0}, {3.0, 0.0}}};
  const std::vector<Profile> profiles{
      {ConstantProfile{1e-6}, 1e7},
      {RampProfile{0.0, 3.0}, 1.0},
      {RampProfile{2.0, -1.0}, 2.0},
      {ExponentialProfile{2.0, -3.0}, 1.0},
      {ExponentialProfile{2.0, 0.0}, 1.0},
      {GaussianProfile{8.0, 0.1, 3.0}, 5.0},
      {LayeredProfile{{0.5, 1.0, 1.5}, {0.0, 4.0, 0.0}}, 1.5},
      voxel_profile(corners, 5.0, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}),
  };
  for (const Profile& profile : profiles)
    for (const double u : {0.0, 1e-15, 1e-6, 0.2, 0.7}) {
      SCOPED_TRACE(profile.shape.index());
      const std::optional<Bounded> t = flight_quantile(profile, u);
      if (!t) {
        EXPECT_LT(collision_cdf(profile, profile.length).value, u);
        continue;
      }
      const Bounded cdf = collision_cdf(profile, t->value);
      EXPECT_NEAR(cdf.value, u, cdf.error + t->error * extinction(profile, t->value) + 1e-15 * u);
    }
}

// In a blob's tails its error function is nearly constant.
TEST(ExactProfile, GaussianTailsKeepTheirDigits) {
  for (const double center : {1.0, -0.8}) {
    const Profile profile{GaussianProfile{1e12, 0.1, center}, 0.3};
    const Bounded sum = integrate([&](double t) { return extinction(profile, t); }, 0.0, profile.length);
    const Bounded tau = optical_thickness(profile, profile.length);
    EXPECT_NEAR(tau.value, sum.value, tau.error + sum.error);
    EXPECT_LT(tau.error, 1e-12 * tau.value);
  }
}

// The first free path of a very dense medium is not overlooked on a long ray.
TEST(ExactProfile, DenseMediaHaveShortFlights) {
  EXPECT_NEAR(mean_flight({ConstantProfile{1e9}, 1e3}).value, 1e-9, 1e-23);
  EXPECT_NEAR(mean_flight({LayeredProfile{{1e-6, 1e3}, {4e7, 0.0}}, 1e3}).value, 2.5e-8 + 1e3 * std::exp(-40.0), 1e-21);
  EXPECT_DOUBLE_EQ(mean_flight({ConstantProfile{0.0}, 7.0}).value, 7.0);
}

}  // namespace
}  // namespace vpm::exact
