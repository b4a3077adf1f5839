// Phase functions of any anisotropy: normalised, reciprocal, and the same by cosine and by directions.
#include "support/properties.h"
#include "vpm/base/error.h"
#include "vpm/base/warp.h"
#include "vpm/medium/phase/phase.h"

namespace vpm {
namespace {

rc::Gen<Phase> any_phase() {
  return rc::gen::oneOf(
      rc::gen::element<Phase>(Isotropic{}, Rayleigh{}, TwoLobes(0.9f, -0.5f, 0.8f)),
      rc::gen::map(number(5.0, 50.0), [](double d) { return Phase(Droplets(static_cast<float>(d))); }),
      rc::gen::map(rc::gen::pair(number(-0.99, 0.99), number(0.0, 100.0)),
                   [](const std::pair<double, double>& numbers) {
                     return Phase(Draine{static_cast<float>(numbers.first), static_cast<float>(numbers.second)});
                   }),
      rc::gen::map(number(-0.9999, 0.9999), [](double g) { return Phase(HenyeyGreenstein{static_cast<float>(g)}); }));
}

RC_GTEST_PROP(PhaseProperty, IsNormalised, ()) {
  const Phase phase = *any_phase();
  // In the variable ln(away), away = 1 - |cos| to the peak: dense where the value is large.
  double sum = 0.0;
  constexpr int kSteps = 4000;
  const double lo = std::log(1e-14), hi = std::log(2.0), width = (hi - lo) / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const double away = std::exp(lo + (i + 0.5) * width);
    const Vec3 axis(0, 0, std::visit([](const auto& p) { return p.mean_cosine(); }, phase) < 0.0f ? -1 : 1);
    const Vec3 d(Vec3d(std::sqrt(away * (2.0 - away)), 0.0, axis.z * (1.0 - away)));
    sum += phase_value(phase, Vec3(0, 0, 1), d) * 2.0 * kPiD * away * width;
  }
  RC_ASSERT(std::abs(sum - 1.0) < 1e-4);
}

RC_GTEST_PROP(PhaseProperty, IsReciprocalAndTheSameTurnedRound, ()) {
  const Phase phase = *any_phase();
  const Vec3 before = *unit_vector(), after = *unit_vector();
  const float value = phase_value(phase, before, after);
  RC_ASSERT(std::isfinite(value) && value > 0.0f);
  RC_ASSERT(phase_value(phase, after, before) == value);
  RC_ASSERT(phase_value(phase, -after, -before) == value);
}

RC_GTEST_PROP(PhaseProperty, DirectionsAndCosinesAgreeAwayFromThePeak, ()) {
  const Phase phase = *any_phase();
  const Vec3 before = *unit_vector(), after = *unit_vector();
  const double cosine = glm::dot(Vec3d(before), Vec3d(after));
  RC_PRE(std::abs(cosine) < 0.99);
  const float by_cosine = phase_value(phase, static_cast<float>(cosine));
  RC_ASSERT(std::abs(phase_value(phase, before, after) / by_cosine - 1.0f) < 1e-4f);
}

RC_GTEST_PROP(PhaseProperty, SamplesInvertTheCumulativeDistribution, ()) {
  // Of Henyey and Greenstein's function the share of directions with less than 1 - |cos| to the peak is known: it must
  // be 1 - u.x, whatever the axis and the azimuth.
  const auto g = static_cast<float>(*number(0.01, 0.9999));
  const Vec3 travel = *unit_vector();
  const Vec2 u = *uniform_pair();
  const bool backward = *rc::gen::arbitrary<bool>();
  RC_ASSERT(std::isfinite(phase_value(HenyeyGreenstein{backward ? -g : g}, backward ? -1.0f : 1.0f)));
  const Vec3 d = phase_sample(HenyeyGreenstein{backward ? -g : g}, travel, u);
  RC_ASSERT(std::abs(glm::length(Vec3d(d)) - 1.0) < 5e-7);
  const Vec3d apart = Vec3d(d) - (backward ? -1.0 : 1.0) * Vec3d(travel);
  const double e = 1.0 - g, away = 0.5 * glm::dot(apart, apart), gg = g;
  const double share = (1.0 + gg) * e / (2.0 * gg) * (1.0 / e - 1.0 / std::sqrt(e * e + 2.0 * gg * away));
  // Rounding moves a direction by 1e-7 rad, some share of a peak e wide.
  RC_ASSERT(std::abs(share - (1.0 - u.x)) < 1e-5 + 1e-6 / e * 0.5);
}

/// The share of Draine's function that lies farther from the peak than a sample is 1 - u.x: by midpoints in t = (1 +
/// a^2
/// - 2 a cos)^(1/2), as the density falls with 1/t^2 there.
RC_GTEST_PROP(PhaseProperty, SamplesOfDraineInvertTheCumulativeDistribution, ()) {
  const Draine phase{static_cast<float>(*number(0.0, 0.98)), static_cast<float>(*number(0.0, 100.0))};
  const Vec3 travel = *unit_vector();
  const Vec2 u = *uniform_pair();
  const Vec3d d(phase.sample(travel, u));
  RC_ASSERT(std::abs(glm::length(d) - 1.0) < 5e-7);
  const Vec3d apart = d - Vec3d(travel);
  const double away = 0.5 * glm::dot(apart, apart);
  constexpr int kSteps = 20'000;
  double share = 0.0;
  for (int i = 0; i < kSteps; ++i) {  // away = sampled x^2: dense near the peak
    const double x = (i + 0.5) / kSteps, at = away * x * x;
    share += 2.0 * kPiD * phase.value(Vec3(0, 0, 1), Vec3(Vec3d(std::sqrt(at * (2.0 - at)), 0.0, 1.0 - at))) * 2.0 *
             away * x / kSteps;
  }
  RC_ASSERT(std::abs(share - u.x) < 2e-4);
}

PhaseTable table_of_henyey_greenstein(double g, double step) {
  std::vector<double> degrees, values;
  for (double angle = 0.0; angle < 180.0 - 0.5 * step; angle += step) degrees.push_back(angle);
  degrees.push_back(180.0);
  for (const double angle : degrees)
    values.push_back(7.0 / std::pow(1.0 + g * g - 2.0 * g * std::cos(angle * kPiD / 180.0), 1.5));
  return {degrees, values};
}

/// Linear in between, a table of 0.05 degrees is within 1e-4 of the function.
TEST(Tabulated, IsTheFunctionThatTheTableIsOf) {
  const HenyeyGreenstein phase{0.75f};
  const Tabulated table{std::make_shared<const PhaseTable>(table_of_henyey_greenstein(0.75, 0.05))};
  EXPECT_NEAR(table.table->total(), 7.0 * 4.0 * kPiD / (1.0 - 0.75 * 0.75), 1e-2);
  for (int i = 0; i <= 1800; ++i) {
    const double angle = i * kPiD / 1800.0;
    const Vec3 before(0, 0, 1), after(Vec3d(std::sin(angle), 0.0, std::cos(angle)));
    ASSERT_NEAR(table.value(before, after) / phase.value(before, after), 1.0f, 1e-4f) << angle;
  }
  EXPECT_NEAR(table.mean_cosine(), 0.75f, 1e-5f);
  EXPECT_NEAR(table.mean_square_cosine(), phase.mean_square_cosine(), 1e-5f);
  for (const float u : {0.0f, 1e-6f, 0.1f, 0.5f, 0.99f, 0.999999f}) {
    const Vec3 d = table.sample(Vec3(0, 0, 1), {u, 0.3f});
    const double away = 1.0 - double{d.z};
    double share = 0.0;
    for (int i = 0; i < 20'000; ++i) {
      const double x = (i + 0.5) / 20'000, at = away * x * x;
      share += 4.0 * kPiD * away * x / 20'000 * table.value(static_cast<float>(1.0 - at));
    }
    EXPECT_NEAR(share, u, 1e-3f);
  }
}

TEST(Tabulated, OtherTablesAreRefused) {
  const auto refused = [](std::vector<double> degrees, std::vector<double> values) {
    EXPECT_THROW(PhaseTable(degrees, values), InputError);
  };
  refused({0.0, 90.0}, {1.0, 1.0});
  refused({1.0, 180.0}, {1.0, 1.0});
  refused({0.0, 90.0, 90.0, 180.0}, {1.0, 1.0, 1.0, 1.0});
  refused({0.0, 180.0}, {1.0, -1.0});
  refused({0.0, 180.0}, {0.0, 0.0});
  refused({0.0, 180.0}, {1.0});
  refused({}, {});
}

/// Alpha = 0 is Henyey and Greenstein's function, and alpha = 1 with g = 0 Rayleigh's.
TEST(Draine, HoldsTheOthers) {
  for (const float cosine : {-1.0f, -0.3f, 0.0f, 0.8f, 1.0f}) {
    EXPECT_FLOAT_EQ((Draine{0.7f, 0.0f}.value(cosine)), HenyeyGreenstein{0.7f}.value(cosine));
    EXPECT_FLOAT_EQ((Draine{0.0f, 1.0f}.value(cosine)), Rayleigh{}.value(cosine));
  }
}

/// Of 10 um the fits of [Jendersie2023], computed by hand from its formulae.
TEST(Droplets, AreThoseOfTheFits) {
  const Droplets droplets(10.0f);
  EXPECT_NEAR(droplets.a.g, 0.98818f, 1e-5f);
  EXPECT_NEAR(droplets.b.g, 0.55567f, 1e-4f);
  EXPECT_NEAR(droplets.b.alpha, 21.995f, 2e-2f);
  EXPECT_NEAR(droplets.first, 1.0f - 0.48193f, 1e-4f);
  EXPECT_NEAR(droplets.mean_cosine(), 0.864f, 1e-3f);
}

}  // namespace
}  // namespace vpm
