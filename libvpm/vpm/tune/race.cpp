// Each way is compared by the error that it would leave with the best radii and number of photons for it.
#include "vpm/tune/race.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "vpm/base/settings/setting_error.h"
#include "vpm/base/statistics/moments.h"
#include "vpm/image/metrics.h"
#include "vpm/integrators/default_radii.h"
#include "vpm/integrators/describe.h"
#include "vpm/integrators/words.h"
#include "vpm/tune/way_pilot.h"

namespace vpm {
namespace {

constexpr double kPilotShare = 0.2, kMostShare = 0.5;  // of the seconds of a render
constexpr double kSizeShare = 0.4;                     // of these, to find the size of passes
constexpr double kAloneShare = 0.1;                    // likewise, where one way is left
constexpr double kNothingShown = 0.5;                  // an error of which a pilot says nothing
constexpr int kPassesOfRound = 2, kMostRounds = 30;

struct Runner {
  WayPilot pilot;
  size_t turn;  // as they began
  PassModel model{};
  PassSize best{};           // for it
  double error = kInfinity;  // that it would leave then; infinite where no pass fits
  double doubt = 0.0;        // of that, relative

  /// What few samples say of rare bright ones is too little: those that differ most are trusted least.
  double high_error() const { return error * (1.0 + 2.0 * doubt * doubt); }

  const std::string& name() const { return pilot.way().name; }
};

/// By what one way surely shows in each square of pixels: the most of all, as others may miss it.
Scales scales_of(const std::vector<Runner>& runners) {
  Scales most = runners.front().pilot.surely_shown();
  for (const Runner& runner : runners) {
    const std::vector<Rgbd> shown = runner.pilot.surely_shown();
    for (size_t i = 0; i < most.size(); ++i)
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

/// The photons and radii that leave the least error in so many seconds. They stay near those that the pilot began with,
/// as rare bright samples make the noise of few photons look small.
void find_best(double seconds, Runner& runner) {
  constexpr std::array kPhotons{0.7, 1.0, 1.4, 2.0};
  constexpr std::array kRadii{0.5, 0.7, 1.0, 1.4, 2.0};
  constexpr double kClearlyLess = 0.9;
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
      if (more != 1.0 && (!pilot.chooses_photons() || size.photons > pilot.most_photons())) continue;
      if (wider != 1.0 && pilot.radii().empty()) continue;
      if (const double error = error_of(size); error < least) {
        least = runner.error = error;
        runner.best = size;
      }
    }
}

/// Computes the errors after so many seconds of passes, and sorts by them. Returns what they are relative to.
Scales compare(double seconds, std::vector<Runner>& runners) {
  Scales scales = scales_of(runners);
  for (Runner& runner : runners) {
    runner.model = runner.pilot.model(scales);
    Unseen unseen;
    for (const Runner& other : runners) {
      const Unseen beside = runner.pilot.unseen_beside(other.pilot);
      unseen.in_blocks = std::max(unseen.in_blocks, beside.in_blocks);
      unseen.in_all = std::max(unseen.in_all, beside.in_all);
    }
    // Kernels take light away from edges. Where there are none, a ray that meets such light is rarer than one in all
    // that went there, and so its square is at least their number times that of the mean.
    if (runner.model.power_of_noise == 0.0)
      runner.model.unseen = runner.pilot.rays() * std::max(unseen.in_blocks / runner.pilot.blocks(), unseen.in_all);
    else
      runner.model.bias2 = std::max({runner.model.bias2, unseen.in_blocks, unseen.in_all});
    runner.doubt = runner.pilot.doubt(scales);
    find_best(seconds, runner);
  }
  std::stable_sort(runners.begin(), runners.end(),
                   [](const Runner& a, const Runner& b) { return a.high_error() < b.high_error(); });
  return scales;
}

/// Is a way surely behind the first? The errors of both differ from block to block, and so does their difference.
bool is_behind(const Runner& first, const Runner& other, const Scales& scales) {
  constexpr double kSure = 2.0;  // standard errors
  const std::vector<double> of_first = first.pilot.noise_of_blocks(scales),
                            of_other = other.pilot.noise_of_blocks(scales);
  Moments differences, firsts, others;
  for (size_t block = 0; block < of_first.size(); ++block) {
    if (std::isnan(of_first[block]) || std::isnan(of_other[block])) continue;
    firsts.add(of_first[block]);
    others.add(of_other[block]);
  }
  if (!(firsts.mean() > 0.0 && others.mean() > 0.0)) return std::isinf(other.error);
  for (size_t block = 0; block < of_first.size(); ++block)
    if (!std::isnan(of_first[block]) && !std::isnan(of_other[block]))
      differences.add(other.error * of_other[block] / others.mean() - first.error * of_first[block] / firsts.mean());
  return std::isinf(other.error) || differences.mean() > kSure * std::sqrt(differences.variance_of_mean());
}

/// Drops those that are surely behind the first. Returns their names, each behind ", ".
std::string drop_behind(const Scales& scales, std::vector<Runner>& runners) {
  std::string names;
  for (size_t i = runners.size(); i-- > 1;)
    if (is_behind(runners.front(), runners[i], scales)) {
      names = ", " + runners[i].name() + names;
      runners.erase(runners.begin() + static_cast<std::ptrdiff_t>(i));
    }
  return names;
}

/// What the winner chose besides its components.
Winner with_numbers(const Runner& best) {
  Winner winner{best.pilot.way().settings};
  if (best.pilot.chooses_photons()) {
    winner.settings.photons.emitted = static_cast<uint64_t>(rounded(best.best.photons, 2));
    winner.choices.push_back({"integrator.photons.emitted", fmt::format("{}", winner.settings.photons.emitted),
                              "with what passes of two sizes took and showed"});
  }
  if (best.best.radii != 1.0) best.pilot.scale_radii(best.best.radii, winner.settings);
  for (Choice choice : best.pilot.radii()) {
    const std::string value = text_of(find_setting(winner.settings, choice.key)->get());
    if (value != choice.value)
      choice.reason = fmt::format("{}: {}; then times {:.2g}, up to a twentieth of the scene, by pilot passes",
                                  choice.value, choice.reason, best.best.radii);
    choice.value = value;
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

OpenWays open_ways(const Scene& scene, const AutomaticSettings& automatic, const RenderSettings& settings) {
  constexpr std::array kIntegrators{Integrator::photon, Integrator::combined, Integrator::path};
  OpenWays open;
  std::string last;  // of several ways of the same integrator, which have the same fault
  for (const Integrator integrator : kIntegrators) {
    if (!automatic.has("integrator.type") && integrator != settings.integrator) continue;
    Way given{word_of(integrator), settings};
    given.settings.integrator = integrator;
    const auto ways = info_of(integrator).ways;
    for (Way& way : ways ? ways(scene, automatic, given) : std::vector<Way>{given}) {
      try {
        validate(way.settings, facts_of(scene));
        open.ways.push_back(std::move(way));
      } catch (const SettingError& error) {
        if (error.wrong() != last) open.refused += fmt::format("; not {}: {}", way.name, error.wrong());
        last = error.wrong();
      }
    }
  }
  return open;
}

Winner race(const Scene& scene, const AutomaticSettings& automatic, const std::vector<Way>& ways, const Clock& clock) {
  const double begin = clock.seconds(), seconds = ways.front().settings.until.seconds;
  std::vector<Runner> runners;
  const std::string late = start(ways, scene, automatic, seconds, clock, runners);
  if (runners.empty()) {
    Winner winner{ways.front().settings};
    winner.choices = choose_default_radii(scene, automatic, winner.settings);
    winner.reason = "the first of all" + late;
    return winner;
  }
  std::string behind;
  for (int round = 0; round < kMostRounds; ++round) {
    const Scales scales = compare(begin + seconds - clock.seconds(), runners);
    behind = drop_behind(scales, runners) + behind;
    if (!go_on(begin + (runners.size() > 1 ? kPilotShare : kAloneShare) * seconds, clock, runners)) break;
  }
  for (size_t i = runners.size(); i-- > 1;) behind = ", " + runners[i].name() + behind;
  const bool nothing_shown = runners.front().error > kNothingShown;
  if (nothing_shown) {
    std::stable_sort(runners.begin(), runners.end(), [](const Runner& a, const Runner& b) { return a.turn < b.turn; });
    runners.front().best = runners.front().pilot.usual();
  }
  Winner winner = with_numbers(runners.front());
  if (nothing_shown)
    winner.reason = "the first of all, as pilot passes show next to nothing";
  else if (behind.empty())
    winner.reason = "no other way is open";
  else
    winner.reason = "the least error by pilot passes; behind it" + behind.substr(1);
  winner.reason += late;
  return winner;
}

}  // namespace vpm
