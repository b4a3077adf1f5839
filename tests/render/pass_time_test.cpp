// A render that is asked for a time, on a clock on which passes take what a test says: which passes it makes, when it
// ends, and what it says where not one fits.
#include "vpm/render/pass_time.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/simulated_clock.h"

namespace vpm {
namespace {

constexpr uint64_t kTiles = 100;

/// A render of passes that take so long each, the last of them for the rest.
struct TimedRender {
  std::shared_ptr<SimulatedClock> clock = std::make_shared<SimulatedClock>();
  std::vector<double> seconds;
  double photons_share = 0.0;  // of a pass, before its first tile
  std::vector<std::string> notes{};
  double foreseen = 0.0;
  std::string what_fits{};

  RenderResult until(double asked, double earlier = 0.0) {
    const auto make = [&](int number, const RenderResult&, const PassProgress& progress) {
      const double pass = seconds[std::min<size_t>(number, seconds.size() - 1)];
      clock->work(photons_share * pass);
      for (uint64_t tile = 0; tile < kTiles; ++tile) {
        clock->work((1.0 - photons_share) * pass / kTiles);
        progress.tiles->advance();
      }
      return Pass(2, 2);
    };
    const auto note = [&](const std::string& text) { notes.push_back(text); };
    return run_passes({.seconds = asked}, {make, kTiles}, {Film(2, 2), {}, earlier, {}},
                      {.clock = clock, .foreseen = foreseen, .what_fits = what_fits, .note = note});
  }
};

TEST(PassTime, MakesEightPassesWhereverEightFitAndEndsInTime) {
  for (const double asked : {0.1, 2.0, 8.0, 30.0})
    for (const double passes : {8.0, 8.5, 20.0, 33.3, 1000.0}) {
      TimedRender render{.seconds = {asked / passes}};
      EXPECT_GE(render.until(asked).film.passes(), 8) << asked << " s, " << passes;
      EXPECT_LE(render.clock->seconds(), 0.5 * (asked + longest_time(asked)) + 1e-9);
      EXPECT_TRUE(render.notes.empty());
    }
}

TEST(PassTime, DropsAPassThatTakesLongerThanThoseBefore) {
  TimedRender render{.seconds = {1.0, 1.0, 1.0, 100.0}};
  const RenderResult result = render.until(10.0);
  EXPECT_EQ(result.film.passes(), 3);
  EXPECT_NEAR(result.seconds, 3.0, 1e-9);
  EXPECT_LE(render.clock->seconds(), longest_time(10.0));
  EXPECT_GE(render.clock->seconds(), 10.0) << "given up too early";
}

TEST(PassTime, BeginsNoPassThatWouldEndTooLate) {
  TimedRender render{.seconds = {1.0}};
  EXPECT_EQ(render.until(10.0).film.passes(), 10);  // an eleventh would end at 11 s, and is dropped after 10.75 s
  EXPECT_NEAR(render.clock->seconds(), 10.0, 1e-9);
}

TEST(PassTime, CountsWhatCameBeforeThePassesAndEarlierRuns) {
  TimedRender render{.seconds = {1.0}};
  render.clock->work(4.0);  // of loading
  const RenderResult result = render.until(10.0, 3.0);
  EXPECT_EQ(result.film.passes(), 3);
  EXPECT_NEAR(result.seconds, 10.0, 1e-9);
}

TEST(PassTime, FinishesAFirstPassThatEndsWithinTwiceTheTime) {
  for (const double photons : {0.0, 0.8}) {
    TimedRender render{.seconds = {7.0}, .photons_share = photons};
    EXPECT_EQ(render.until(4.0).film.passes(), 1);
    EXPECT_NEAR(render.clock->seconds(), 7.0, 1e-9);
    ASSERT_EQ(render.notes.size(), 1u);
    EXPECT_EQ(render.notes[0].substr(0, 36), "no pass is finished after 4 s; the f") << render.notes[0];
  }
}

/// When it gives up a pass that is asked to fit into 4 s. How long that takes is told by whole tiles.
double end_of_pass_that_does_not_fit(TimedRender render, double tolerance = 0.2) {
  try {
    render.until(4.0);
    ADD_FAILURE() << "it fits";
  } catch (const NoPassFits& failure) {
    EXPECT_NE(std::string(failure.what()).find("within the 4 s asked for"), std::string::npos) << failure.what();
    EXPECT_NEAR(failure.pass(), render.seconds[0], tolerance * render.seconds[0]);
  }
  return render.clock->seconds();
}

TEST(PassTime, EndsWhereNotOnePassFits) {
  EXPECT_NEAR(end_of_pass_that_does_not_fit({.seconds = {12.0}}), 4.0, 1e-9);
  EXPECT_NEAR(end_of_pass_that_does_not_fit({.seconds = {40.0}, .photons_share = 0.5, .foreseen = 40.0}), 4.0, 1e-9);
  // That its tiles are slow is seen only after the time that was asked for, and photons count for them in part.
  EXPECT_NEAR(end_of_pass_that_does_not_fit({.seconds = {40.0}, .photons_share = 0.12}, 0.5), 7.2, 1e-9);
}

/// The words are of the time that was asked for, also where earlier runs, or choosing, have taken a part of it.
TEST(PassTime, SaysWhatWasAskedForAndWhatWouldFit) {
  TimedRender render{.seconds = {40.0}, .photons_share = 0.5, .foreseen = 40.0, .what_fits = "less would fit"};
  try {
    render.until(4.0, 1.0);
    ADD_FAILURE() << "it fits";
  } catch (const NoPassFits& failure) {
    EXPECT_STREQ(failure.what(), "no pass is finished within the 4 s asked for: one takes about 40 s; less would fit");
  }
  EXPECT_NEAR(render.clock->seconds(), 3.0, 1e-9);
}

TEST(PassTime, SaysWhereLoadingTookMuchOfTheTime) {
  EXPECT_EQ(spent_text(0.9, 4.0), "");
  TimedRender render{.seconds = {40.0}, .photons_share = 0.5, .foreseen = 40.0};
  render.clock->work(1.5);
  try {
    render.until(4.0);
    ADD_FAILURE() << "it fits";
  } catch (const NoPassFits& failure) {
    EXPECT_STREQ(failure.what(),
                 "no pass is finished within the 4 s asked for: one takes about 40 s; 1.5 s were over before the first "
                 "pass, by loading and choosing");
  }
}

}  // namespace
}  // namespace vpm
