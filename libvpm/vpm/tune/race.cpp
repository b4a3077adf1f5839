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
constexpr int kPassesOfRound = 2;

struct Runner {
  WayPilot pilot;
  size_t turn;  // as they began
  PassModel model{};
  PassSize best{};              // for it
  double error = kInfinity;     // that it would leave then; infinite where no pass fits
  std::vector<double> noise{};  // of blocks

  /// What few samples say of rare bright ones is too little: those that differ most are trusted least.
  double high_error() const {
    const Moments blocks = moments_of_known(noise);
    return blocks.mean() > 0.0 ? error * (1.0 + 2.0 * blocks.variance_of_mean() / (blocks.mean() * blocks.mean()))
                               : error;
  }
};

/// By what one way surely shows in each square of pixels: the most of all, as others may miss it.
Scales scales_of(const std::vector<Runner>& runners) {
  Scales most(kSquares, Rgbd(NAN));
  for (const Runner& runner : runners) {
    const std::vector<Rgbd> shown = surely_shown(runner.pilot.squares());
    for (size_t i = 0; i < kSquares; ++i)
      for (int channel = 0; channel < 3; ++channel) most[i][channel] = std::fmax(most[i][channel], shown[i][channel]);
  }
  for (int channel = 0; channel < 3; ++channel) {
    Moments squares;
    for (const Rgbd& light : most)
      if (!std::isnan(light[channel])) squares.add(light[channel]);
    for (Rgbd& light : most) light[channel] = relative_scale(light[channel], squares.mean());
  }
  return most;
}

/// The photons and radii that leave clearly less error in so many seconds than usual ones. They stay near these, as
/// rare bright samples make the noise of few photons look small.
void find_best(double seconds, Runner& runner) {
  constexpr std::array kPhotons{1.0, 1.4, 2.0};
  constexpr std::array kRadii{0.5, 0.7, 1.0, 1.4, 2.0};
  constexpr double kClearlyLess = 0.8;
  const WayPilot& pilot = runner.pilot;
  const PassSize usual = pilot.usual();
  const auto error_of = [&](const PassSize& size) {
    const double passes = std::floor(seconds / runner.model.seconds(size.photons, size.radii));
    return passes < 1.0 ? kInfinity : runner.model.error(passes, size.photons, size.radii, pilot.way().settings);
  };
  runner.best = usual;
  runner.error = error_of(runner.best);
  double least = kClearlyLess * runner.error;
  for (const double more : kPhotons)
    for (const double wider : kRadii) {
      const PassSize size{more * usual.photons, wider};
      const bool photons_open = more == 1.0 || (pilot.chooses_photons() && size.photons <= pilot.most_photons());
      const bool open = photons_open && (wider == 1.0 || !pilot.radii().empty());
      if (const double error = open ? error_of(size) : kInfinity; error < least) {
        least = runner.error = error;
        runner.best = size;
      }
    }
}

/// Computes the errors after so many seconds of passes, and sorts by them.
void compare(double seconds, std::vector<Runner>& runners) {
  const Scales scales = scales_of(runners);
  std::vector<ShownLight> lights;
  for (const Runner& runner : runners) lights.push_back(runner.pilot.light());
  for (size_t i = 0; i < runners.size(); ++i) {
    Runner& runner = runners[i];
    runner.model = runner.pilot.model(scales);
    double missing = 0.0;
    for (const ShownLight& light : lights) missing = std::max(missing, unseen_by(lights[i], light));
    // Kernels take light away from edges. Where there are none, a ray that meets such light is rarer than one in all
    // that went there, and so its square is at least their number times that of the mean.
    if (runner.model.power_of_noise == 0.0)
      runner.model.unseen = runner.pilot.rays_of_block() * missing;
    else
      runner.model.bias2 = std::max(runner.model.bias2, missing);
    runner.noise = runner.pilot.noise_of_blocks(scales);
    find_best(seconds, runner);
  }
  std::stable_sort(runners.begin(), runners.end(),
                   [](const Runner& a, const Runner& b) { return a.high_error() < b.high_error(); });
}

/// The relative standard error of the ratio of two ways' noise, where blocks count as samples: none if one is as many
/// times that of the other everywhere.
double doubt_of_ratio(const std::vector<double>& a, const std::vector<double>& b) {
  Moments all_a, all_b, differences;
  const auto each_block = [&](const auto& use) {
    for (size_t i = 0; i < a.size(); ++i)
      if (!std::isnan(a[i] + b[i])) use(a[i], b[i]);
  };
  each_block([&](double of_a, double of_b) { all_a.add(of_a), all_b.add(of_b); });
  each_block([&](double of_a, double of_b) { differences.add(of_a / all_a.mean() - of_b / all_b.mean()); });
  return std::sqrt(differences.variance_of_mean());
}

/// Drops those that are surely behind the first, unless that one shows next to nothing. Returns their names, each
/// behind
/// ", ".
std::string drop_behind(std::vector<Runner>& runners) {
  constexpr double kAlike = 1.5, kSure = 2.0;  // times, which no pilot tells apart; standard errors
  const auto is_behind = [&first = runners.front()](const Runner& other) {
    if (first.error > kNothingShown) return false;
    return std::isinf(other.error) ||
           other.error > first.error * (kAlike + kSure * doubt_of_ratio(first.noise, other.noise));
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
Winner with_numbers(const Scene& scene, const Runner& best, const std::string& reason) {
  Winner winner{best.pilot.way().settings, {}, reason};
  if (best.pilot.chooses_photons()) {
    winner.settings.photons.emitted = static_cast<uint64_t>(rounded(best.best.photons, 2));
    winner.choices.push_back({"integrator.photons.emitted", fmt::format("{}", winner.settings.photons.emitted),
                              "with what passes of two sizes took and showed"});
  }
  if (best.best.radii != 1.0) scale_radii(best.pilot.radii(), best.best.radii, scene, winner.settings);
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

/// More passes of each, the best first, as long as they end in time: half of it at the most for one, which may have
/// fewer photons then. Were there any?
bool go_on(double end, const Clock& clock, std::vector<Runner>& runners) {
  constexpr double kFewest = 4000.0;  // photons
  bool any = false;
  for (Runner& runner : runners) {
    const double left = end - clock.seconds();
    const auto taken = [&](const PassSize& size) { return kPassesOfRound * runner.pilot.seconds_of_passes(size); };
    PassSize size = runner.best;
    while (taken(size) > 0.5 * left && size.photons > kFewest) size.photons *= 0.5;
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
    RenderSettings first = ways.front().settings;
    const std::vector<Choice> radii = choose_default_radii(scene, automatic, first);
    return {first, radii, "the first of all" + late};
  }
  std::string behind;
  do {
    compare(begin + seconds - clock.seconds(), runners);
    behind = drop_behind(runners) + behind;
  } while (go_on(begin + (runners.size() > 1 ? kPilotShare : kAloneShare) * seconds, clock, runners));
  const bool nothing_shown = runners.front().error > kNothingShown;
  std::stable_sort(runners.begin(), runners.end(), [](const Runner& a, const Runner& b) { return a.turn < b.turn; });
  if (nothing_shown) runners.front().best = runners.front().pilot.usual();
  std::string reason = "the least error by pilot passes";
  if (runners.size() > 1) reason = "the first of those that pilot passes do not tell apart";
  for (size_t i = 1; i < runners.size(); ++i) reason += ", " + runners[i].pilot.way().name;
  if (!behind.empty()) reason += "; behind" + behind.substr(1);
  if (ways.size() == 1) reason = "no other way is open";
  return with_numbers(scene, runners.front(), reason + late);
}

}  // namespace vpm
