// The rules by which a render chooses settings, each a pure function: exact.
#include <gtest/gtest.h>

#include <cmath>

#include "vpm/base/error.h"
#include "vpm/tune/automatic.h"
#include "vpm/tune/choice_rules.h"
#include "vpm/tune/eye_blocks.h"
#include "vpm/tune/pilot.h"
#include "vpm/tune/pilot_error.h"

namespace vpm {
namespace {

/// 16 photons of 100,000 lie within 0.2 m.
MapDensity density(int dimension) { return {0.2, 16.0, 1e5, dimension, 0.01}; }

TEST(Automatic, RadiusHoldsSoManyPhotonsWhateverIsEmitted) {
  // As many photons per emitted as in the pilot: (0.5 / 16)^(1/2) of its reach under 100 times the photons.
  const float surface = choose_radius(density(2), kPhotonsWithin / 0.5 * 1e5, 10.0).radius;
  EXPECT_FLOAT_EQ(surface, 0.0354f);  // 0.2 sqrt(1/32) = 0.035355
  const float volume = choose_radius(density(3), kPhotonsWithin / 2.0 * 1e5, 10.0).radius;
  EXPECT_FLOAT_EQ(volume, 0.1f);  // 0.2 (1/8)^(1/3)
  EXPECT_NE(choose_radius(density(3), 1e6, 10.0).reason.find("of the first pass"), std::string::npos);
}

TEST(Automatic, RadiusStaysBetweenHalfAPixelAndATwentiethOfTheScene) {
  const ChosenRadius fine = choose_radius(density(2), 1e12, 10.0);
  EXPECT_FLOAT_EQ(fine.radius, 0.005f);
  EXPECT_EQ(fine.reason.substr(0, 12), "half a pixel");
  const ChosenRadius wide = choose_radius(density(2), 1e3, 3.0);
  EXPECT_FLOAT_EQ(wide.radius, 0.15f);
  EXPECT_EQ(wide.reason.substr(0, 11), "a twentieth");
}

TEST(Automatic, RadiusStaysWithinTheMediumUnlessTooFewPhotonsWouldBeWithin) {
  MapDensity thin = density(3);  // 0.1 m hold two of 100,000, 0.09 m hold 1.458
  thin.thickness = 1.0;
  const ChosenRadius tenth = choose_radius(thin, 6.0 * 1e5, 10.0);
  EXPECT_FLOAT_EQ(tenth.radius, 0.1f);
  EXPECT_EQ(tenth.reason.substr(0, 40), "a tenth of the medium's thickness; 0.161");
  thin.free_path = 0.09;
  const ChosenRadius path = choose_radius(thin, 8.0 * 1e5, 10.0);
  EXPECT_FLOAT_EQ(path.radius, 0.09f);
  EXPECT_EQ(path.reason.substr(0, 24), "the mean free path there");
  thin.thickness = kInfinity;
  const ChosenRadius few = choose_radius(thin, 5.0 * 1e5, 10.0);
  EXPECT_FLOAT_EQ(few.radius, 0.1f);
  EXPECT_EQ(few.reason.substr(0, 3), "10 ");
  EXPECT_NE(few.reason.find("fewer within the mean free path"), std::string::npos) << few.reason;
}

constexpr size_t kPixels = 4;  // of each block
constexpr double kRays = 3.0 * 2.0 * kPixels;

/// Two passes, in which all pixels show a light of 1 but those of one block in one channel: these show `there` there,
/// with that standard error.
PilotError pilot(float there, float standard_error, float correction = 0.0f) {
  PilotError error{.pixels = kPixels, .corrections = std::vector<Rgb>(kEyeBlocks * kPixels, Rgb(0.0f))};
  for (const float off : {standard_error, -standard_error}) {
    error.shown.emplace_back(kEyeBlocks * kPixels, Rgb(1.0f));
    for (size_t i = 0; i < kPixels; ++i) error.shown.back()[6 * kPixels + i].y = there + off;
  }
  for (size_t i = 0; i < kPixels; ++i) error.corrections[6 * kPixels + i].y = correction;
  return error;
}

/// The square of what is missing, of one ray, where others show 1 there.
double unseen(double missing) { return kRays * missing * missing / (1.0 + 0.01) / (3.0 * kEyeBlocks); }

TEST(Automatic, LightThatOthersShowForCertainIsNoise) {
  EXPECT_NEAR(unseen_light(pilot(0.0f, 0.0f), pilot(1.0f, 0.0f)), unseen(1.0), 1e-6);
  EXPECT_NEAR(unseen_light(pilot(0.0f, 0.0f), pilot(1.0f, 0.1f)), unseen(0.6), 1e-6);
  EXPECT_NEAR(unseen_light(pilot(0.2f, 0.05f), pilot(1.0f, 0.1f)), unseen(0.2), 1e-6);
  EXPECT_NEAR(unseen_light(pilot(0.0f, 0.0f), pilot(1.0f, 0.0f, -0.2f)), unseen(0.6), 1e-6);
  EXPECT_EQ(unseen_light(pilot(1.0f, 0.0f), pilot(0.0f, 0.0f)), 0.0);  // brighter is not blind
  EXPECT_EQ(unseen_light(pilot(0.5f, 0.0f), pilot(1.0f, 0.2f)), 0.0);  // within what is certain
}

/// A pilot of one pixel of each block beside one of four: the first of these is what both have.
TEST(Automatic, LightIsMissingOnlyWherePilotsSeeTheSamePixels) {
  PilotError few{.pixels = 1, .corrections = std::vector<Rgb>(kEyeBlocks, Rgb(0.0f))};
  few.shown.assign(2, std::vector<Rgb>(kEyeBlocks, Rgb(1.0f)));
  PilotError many = pilot(1.0f, 0.0f);
  for (std::vector<Rgb>& pass : many.shown) pass[3] = Rgb(100.0f);
  EXPECT_EQ(unseen_light(few, many), 0.0);
  for (std::vector<Rgb>& pass : many.shown) pass[0] = Rgb(100.0f);
  EXPECT_GT(unseen_light(few, many), 0.0);
}

/// A tenth is missing everywhere, which no block is sure of: their noise is large, and all of them together have none.
TEST(Automatic, LightThatIsMissingInAllBlocksTogetherIsNoise) {
  const auto noisy = [](float mean) {
    PilotError error{.pixels = 1, .corrections = std::vector<Rgb>(kEyeBlocks, Rgb(0.0f))};
    for (const float sign : {1.0f, -1.0f}) {
      error.shown.emplace_back();
      for (size_t block = 0; block < kEyeBlocks; ++block)
        error.shown.back().emplace_back(mean + (block % 2 == 0 ? sign : -sign) * 0.1f);
    }
    return error;
  };
  EXPECT_NEAR(unseen_light(noisy(0.9f), noisy(1.0f)), 6.0 * kEyeBlocks * 0.1 * 0.1 / 1.01, 1e-4);
  EXPECT_EQ(unseen_light(noisy(1.0f), noisy(0.9f)), 0.0);
}

TEST(Automatic, PhotonsCostWhatTheEyePassCosts) {
  const PassCost cost{2e-6, 0.5, 3.0};
  EXPECT_EQ(choose_count(cost, 0.0).count, 250'000u);
  EXPECT_EQ(choose_count(cost, 100.0).count, 250'000u);  // eight passes of a second fit
  EXPECT_EQ(choose_count(cost, 6.4).count, 150'000u);    // (0.8 - 0.5) s / 2 us
  EXPECT_EQ(choose_count(cost, 1.0).count, 31'000u);     // an eighth: 31,250
  EXPECT_EQ(choose_count({2e-6, 1e-4, 3.0}, 0.0).count, kLeastCount);
  EXPECT_EQ(choose_count({2e-6, 100.0, 4.0}, 0.0).count, 5'000'000u);  // of 4 records each
  EXPECT_NE(choose_count(cost, 6.4).reason, choose_count(cost, 1.0).reason);
}

TEST(Automatic, PhotonsLeaveTimeToThoseThatAreAimed) {
  const PassCost cost{.photon = 2e-6, .eye = 0.2, .stored_per_photon = 3.0, .caustics = 0.3, .stored_caustics = 1e6};
  EXPECT_EQ(choose_count(cost, 0.0).count, 250'000u);
  EXPECT_EQ(choose_count(cost, 6.4).count, 150'000u);  // (0.8 - 0.2 - 0.3) s / 2 us
  EXPECT_NE(choose_count(cost, 6.4).reason.find("the caustic photons takes 0.5 s"), std::string::npos);
}

TEST(Automatic, FewerPhotonsThanAnEighthLetAPassFit) {
  const PassCost cost{2e-6, 0.8, 3.0};
  EXPECT_EQ(choose_count(cost, 1.0).count, 50'000u);   // an eighth
  EXPECT_EQ(choose_count(cost, 0.85).count, 25'000u);  // (0.85 - 0.8) s / 2 us
  EXPECT_NE(choose_count(cost, 0.85).reason.find("a pass fits"), std::string::npos);
  EXPECT_EQ(choose_count(cost, 0.5).count, 50'000u);  // no number lets it fit
}

TEST(Automatic, FewerPhotonsMakeAPassFitWhereTheyMakeItShorter) {
  const auto wide = [](uint64_t photons) { return 1e-2 * std::sqrt(static_cast<double>(photons)); };
  EXPECT_EQ(make_fit({160'000, ""}, 4.0, wide).count, 160'000u);                          // 4 s
  EXPECT_EQ(make_fit({640'000, ""}, 4.0, wide).count, 80'000u);                           // 8 s, 2.8 s
  EXPECT_EQ(make_fit({640'000, ""}, 0.1, wide).count, 1'300u);                            // as few as there may be
  EXPECT_EQ(make_fit({640'000, ""}, 4.0, [](uint64_t) { return 8.0; }).count, 640'000u);  // radii that are given
}

/// Eye rays cross flights in proportion to the root of the photons' number, under radii that 50 flights pass within.
TEST(Automatic, FlightsAreAsManyAsLetPassesFit) {
  std::vector<uint64_t> timed;
  const auto cost_of = [&](uint64_t photons) {
    timed.push_back(photons);
    return PassCost{.photon = 1e-7, .eye = 1e-3 * std::sqrt(static_cast<double>(photons)), .flights_per_photon = 4.0};
  };
  EXPECT_NEAR(choose_count_of_flights(1.6, cost_of).count, 38'000, 2000);  // 0.2 s a pass, 4 % for photons
  EXPECT_EQ(timed, (std::vector<uint64_t>{1000, 4000, 16'000, 64'000}));
  const ChosenCount least = choose_count_of_flights(0.16, cost_of);
  EXPECT_EQ(least.count, kLeastCount);
  EXPECT_EQ(least.reason.substr(0, 9), "the least");
  EXPECT_EQ(choose_count_of_flights(0.0, cost_of).count, 256'000u);  // memory: four times as many have 4e7 / 9 flights
  const auto even = [](uint64_t) { return PassCost{.photon = 1e-5, .eye = 0.1}; };
  EXPECT_EQ(choose_count_of_flights(0.0, even).count, 16'000u);
}

TEST(Automatic, TheCheapestStrategyIsTheFirstOfEquals) {
  const std::vector<StrategyCost> costs{{"a", 3.0}, {"b", 2.0}, {"c", 2.0}};
  EXPECT_EQ(cheapest(costs).name, "b");
}

TEST(Automatic, RefusesChoicesThatAreNone) {
  RenderSettings settings;
  set_chosen(settings, "integrator.volume.radius", "0.0123");
  EXPECT_EQ(settings.volume.radius.metres(), 0.0123f);
  set_chosen(settings, "integrator.photons.emitted", "170000");
  EXPECT_EQ(settings.photons.emitted, 170'000u);
  set_chosen(settings, "integrator.distance.type", "delta");
  EXPECT_EQ(settings.distance.strategy, "delta");
  EXPECT_THROW(set_chosen(settings, "integrator.volume.radius", "-1"), InputError);
  EXPECT_THROW(set_chosen(settings, "integrator.volume.radius", "1 m"), InputError);
  EXPECT_THROW(set_chosen(settings, "integrator.photons.emitted", "0"), InputError);
  EXPECT_THROW(set_chosen(settings, "integrator.distance.type", "woodcock"), InputError);
  EXPECT_THROW(set_chosen(settings, "film.width", "3"), InputError);
  EXPECT_THROW(set_chosen(settings, "render.passes", "3"), InputError);
}

/// The noise of rays falls with passes; radii that shrink let the bias fall, and hold up the noise of photons: by the
/// factors 1, 5/6 and 5/6 * 8/9 of the areas of discs in the first three passes.
TEST(Automatic, ErrorsFallAsRadiiShrink) {
  RenderSettings settings;
  settings.radii = RadiusSchedule::constant;
  EXPECT_DOUBLE_EQ(error_after({4e-3, 2e-3, 1e-3}, settings, 8), 6e-3 / 8 + 1e-3);
  settings.radii = RadiusSchedule::per_pass;
  EXPECT_DOUBLE_EQ(error_after({4e-3, 0.0, 0.0}, settings, 3), 4e-3 / 3);
  const double second = 5.0 / 6.0, third = second * 8.0 / 9.0;
  EXPECT_NEAR(error_after({0.0, 9e-3, 0.0}, settings, 3), 1e-3 * (1.0 + 1.0 / second + 1.0 / third), 1e-9);
  const double bias = 1.0 + std::pow(second, 0.25 * kPowerOfBias) + std::pow(third, 0.25 * kPowerOfBias);
  EXPECT_NEAR(error_after({0.0, 0.0, 9e-3}, settings, 3), 1e-3 * bias * bias, 1e-9);
}

}  // namespace
}  // namespace vpm
