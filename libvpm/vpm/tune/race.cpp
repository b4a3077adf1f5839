// Each way is compared by the error that it would leave with the best radii and number of photons for it.
#include "vpm/tune/race.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "vpm/base/statistics/moments.h"
#include "vpm/image/metrics.h"
#include "vpm/integrators/default_radii.h"
#include "vpm/integrators/describe.h"
#include "vpm/tune/way_pilot.h"

namespace vpm {
namespace {

constexpr double kPilotShare = 0.2, kAloneShare = 0.1;  // of the seconds of a render; where one way is left
constexpr double kMostShare = 0.5, kSizeShare = 0.4;  // likewise, at the most; of a pilot's, to find the size of passes
constexpr double kNothingShown = 0.5;                 // an error of which a pilot says nothing
constexpr double kFewest = 1000.0;                    // photons
constexpr const char* kPhotonsKey = "integrator.photons.emitted";
constexpr int kPassesOfRound = 2, kMostRounds = 30;
constexpr double kAlike = 1.5, kAlikeAtFirst = 4.0;  // times, which no pilot tells apart; by its first few passes

struct Runner {
  WayPilot pilot;
  size_t turn;  // in the list of all ways
  PassModel model{};
  ShownLight light{};
  PassSize best{};              // of passes that leave the least error, by the model
  double error = kInfinity;     // at the end of the time with these; infinite where no pass fits
  std::vector<double> noise{};  // of blocks

  /// What few samples say of rare bright ones is too little: a way whose blocks differ much counts for less.
  double high_error() const {
    const Moments blocks = moments_of(noise);
    if (!(blocks.mean() > 0.0)) return error;
    return error * (1.0 + 2.0 * blocks.variance_of_mean() / (blocks.mean() * blocks.mean()));
  }
};

/// Of the most that one way surely shows in each square of pixels, as others may miss it.
Scales scales_of(const std::vector<Runner>& runners) {
  Scales most(kSquares, Rgbd(0.0));
  for (const Runner& runner : runners) {
    const std::vector<Rgbd> shown = surely_shown(runner.pilot.squares());
    for (size_t i = 0; i < kSquares; ++i) most[i] = glm::max(most[i], shown[i]);
  }
  Rgbd mean(0.0);
  for (const Rgbd& light : most) mean += light / double{kSquares};
  for (Rgbd& light : most)
    for (int channel = 0; channel < 3; ++channel) light[channel] = relative_scale(light[channel], mean[channel]);
  return most;
}

/// The photons and radii that leave clearly less error in so many seconds than usual ones, and fewer photons where no
/// pass fits. Else they stay near these, as rare bright samples make the noise of few photons look small.
void find_best(double seconds, Runner& runner) {
  constexpr std::array kPhotons{1.0, 1.4, 2.0};
  constexpr std::array kRadii{0.5, 0.7, 1.0, 1.4, 2.0};
  constexpr double kClearlyLess = 0.8;
  const WayPilot& pilot = runner.pilot;
  const auto error_of = [&](const PassSize& size) {
    const double passes = std::floor(seconds / runner.model.seconds(size.photons, size.radii));
    return passes < 1.0 ? kInfinity : runner.model.error(passes, size.photons, size.radii, pilot.way().settings);
  };
  PassSize usual = pilot.usual();
  while (pilot.chooses_photons() && std::isinf(error_of(usual)) && usual.photons > kFewest) usual.photons *= 0.5;
  runner.best = usual;
  runner.error = error_of(usual);
  double least = kClearlyLess * runner.error;
  for (const double more : kPhotons)
    for (const double wider : kRadii) {
      const PassSize size{more * usual.photons, wider};
      const bool photons_open = more == 1.0 || (pilot.chooses_photons() && size.photons <= pilot.most_photons());
      const bool radii_open = wider == 1.0 || (!pilot.radii().empty() && wider <= pilot.widest());
      if (const double error = photons_open && radii_open ? error_of(size) : kInfinity; error < least) {
        least = runner.error = error;
        runner.best = size;
      }
    }
}

/// Computes the errors after so many seconds of passes, and sorts by them.
void compare(double seconds, std::vector<Runner>& runners) {
  const Scales scales = scales_of(runners);
  for (Runner& runner : runners) runner.light = runner.pilot.light();
  const bool all_black = std::all_of(runners.begin(), runners.end(), [](const Runner& r) { return is_black(r.light); });
  for (Runner& runner : runners) {
    runner.model = runner.pilot.model(scales);
    double missing = 0.0;
    for (const Runner& other : runners) missing = std::max(missing, unseen_by(runner.light, other.light));
    // Kernels take light away from edges. A way without them has not met that light in any of its N pixels of a block:
    // fewer than one in N does, so that the variance is N times the square of the mean at least.
    if (runner.model.power_of_noise == 0.0)
      runner.model.unseen = runner.pilot.pixels_of_block() * missing;
    else
      runner.model.bias2 = std::max(runner.model.bias2, missing);
    runner.noise = runner.pilot.noise_of_blocks(scales);
    find_best(seconds, runner);
    if (is_black(runner.light) && !all_black) runner.error = kInfinity;  // without light there is no noise either
  }
  std::stable_sort(runners.begin(), runners.end(),
                   [](const Runner& a, const Runner& b) { return a.high_error() < b.high_error(); });
}

/// The relative standard error of the ratio of two ways' noise, where blocks count as samples: none if one is as many
/// times that of the other everywhere, or 0.
double doubt_of_ratio(const std::vector<double>& a, const std::vector<double>& b) {
  const double mean_a = moments_of(a).mean(), mean_b = moments_of(b).mean();
  if (!(mean_a > 0.0 && mean_b > 0.0)) return 0.0;
  Moments differences;
  for (size_t i = 0; i < a.size(); ++i) differences.add(a[i] / mean_a - b[i] / mean_b);
  return std::sqrt(differences.variance_of_mean());
}

/// Drops the ways that are surely behind the first by more than that many times, unless that one shows next to nothing,
/// or less light than they do.
/// Returns ", NAME" of each.
std::string drop_behind(double alike, std::vector<Runner>& runners) {
  constexpr double kSure = 2.0;  // standard errors
  const auto is_behind = [&first = runners.front(), alike](const Runner& other) {
    if (std::isinf(other.error) || first.error > kNothingShown)
      return std::isinf(other.error) && !std::isinf(first.error);
    // Without kernels it may have missed rare bright samples.
    if (first.model.power_of_noise == 0.0 && is_clearly_darker(first.light, other.light)) return false;
    return other.error > first.error * (alike + kSure * doubt_of_ratio(first.noise, other.noise));
  };
  std::string names;
  for (size_t i = runners.size(); i-- > 1;)
    if (is_behind(runners[i])) {
      names = ", " + runners[i].pilot.way().name + names;
      runners.erase(runners.begin() + static_cast<std::ptrdiff_t>(i));
    }
  return names;
}

/// What the winner chose besides its components.
Winner with_numbers(const Runner& best, const std::string& reason) {
  Winner winner{best.pilot.way().settings, {}, reason};
  if (best.pilot.chooses_photons()) {
    winner.settings.photons.emitted = static_cast<uint64_t>(rounded(best.best.photons, 2));
    winner.choices.push_back({kPhotonsKey, fmt::format("{}", winner.settings.photons.emitted),
                              "with what passes of two sizes took and showed"});
  }
  if (best.best.radii != 1.0) scale_radii(best.pilot.radii(), best.best.radii, winner.settings);
  for (Choice choice : best.pilot.radii()) {
    const std::string first = std::exchange(choice.value, text_of(find_setting(winner.settings, choice.key)->get()));
    if (choice.value != first) choice.reason = fmt::format("{}: {}; changed by pilot passes", first, choice.reason);
    winner.choices.push_back(choice);
  }
  return winner;
}

/// Gives each way its turn, and leaves those that made passes. Returns "; not NAME: ..." of the others.
std::string start(const std::vector<Way>& ways, const Scene& scene, const AutomaticSettings& automatic, double seconds,
                  const Clock& clock, std::vector<Runner>& runners) {
  std::string late;
  const double begin = clock.seconds();
  for (size_t i = 0; i < ways.size(); ++i) {
    const double left = begin + kMostShare * seconds - clock.seconds();
    const double turn = kSizeShare * kPilotShare * seconds / static_cast<double>(ways.size());
    Runner runner{WayPilot(scene, automatic, clock, ways[i]), i};
    const auto first_passes = [&] {
      runner.pilot.find_size(turn);
      runner.pilot.add_passes(kPassesOfRound, runner.pilot.usual());
    };
    if (clock.finish_by(clock.seconds() + left / static_cast<double>(ways.size() - i), first_passes))
      runners.push_back(std::move(runner));
    else
      late += fmt::format("; not {}: a small pass takes too much of the time", ways[i].name);
  }
  return late;
}

/// Two more passes of each way, the best first, that end in time. Of one that would take more than half of what is left
/// the photons are halved. Were there any?
bool go_on(double end, const Clock& clock, std::vector<Runner>& runners) {
  bool any = false;
  for (Runner& runner : runners) {
    const double left = end - clock.seconds();
    const auto taken = [&](const PassSize& size) { return kPassesOfRound * runner.pilot.seconds_of_passes(size); };
    PassSize size = runner.best;
    while (taken(size) > 0.5 * left && size.photons > 4.0 * kFewest) size.photons *= 0.5;
    if (taken(size) > left) continue;
    runner.pilot.add_passes(kPassesOfRound, size);
    any = true;
  }
  return any;
}

}  // namespace

Winner race(const Scene& scene, const AutomaticSettings& automatic, const std::vector<Way>& ways, const Clock& clock) {
  const double begin = clock.seconds(), seconds = ways.front().settings.until.seconds;
  std::vector<Runner> runners;
  const std::string late = start(ways, scene, automatic, seconds, clock, runners);
  if (runners.empty()) {
    Winner first{ways.front().settings, {}, "the first of all" + late};
    first.choices = choose_default_radii(scene, automatic, first.settings);
    if (automatic.has(kPhotonsKey) && info_of(first.settings.integrator).power_of_noise)
      first.choices.push_back({kPhotonsKey, fmt::format("{}", first.settings.photons.emitted), "the default" + late});
    return first;
  }
  std::string worse;
  for (int round = 0; round < kMostRounds; ++round) {
    compare(begin + seconds - clock.seconds(), runners);
    worse = drop_behind(round == 0 ? kAlikeAtFirst : kAlike, runners) + worse;
    if (!go_on(begin + (runners.size() > 1 ? kPilotShare : kAloneShare) * seconds, clock, runners)) break;
  }
  worse = drop_behind(kAlike, runners) + worse;
  const bool nothing_shown = runners.front().error > kNothingShown;
  std::stable_sort(runners.begin(), runners.end(), [](const Runner& a, const Runner& b) { return a.turn < b.turn; });
  if (nothing_shown) runners.front().best = runners.front().pilot.usual();
  std::string reason = "the least error by pilot passes";
  if (runners.size() > 1) reason = "the first of those that pilot passes do not tell apart";
  for (size_t i = 1; i < runners.size(); ++i) reason += ", " + runners[i].pilot.way().name;
  if (!worse.empty()) reason += "; clearly more:" + worse.substr(1);
  if (ways.size() == 1) reason = "no other way is open";
  return with_numbers(runners.front(), reason + late);
}

}  // namespace vpm
