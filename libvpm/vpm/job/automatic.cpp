// The rules, and the order in which they are asked: the strategy, the gather in media, the photons, the radii.
#include "vpm/job/automatic.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "vpm/base/count.h"
#include "vpm/base/error.h"
#include "vpm/estimate/pass_map.h"
#include "vpm/job/declare.h"
#include "vpm/job/forecast.h"
#include "vpm/job/pilot.h"
#include "vpm/job/pilot_error.h"
#include "vpm/job/render.h"
#include "vpm/job/setting.h"
#include "vpm/job/validate.h"
#include "vpm/render/plan.h"

namespace vpm {
namespace {

constexpr double kLargestRadius = 0.05;  // of the scene's diagonal
constexpr double kLeastRadius = 0.5;     // pixels
constexpr double kLeastShare = 0.125;    // of what the eye pass costs, for photons
constexpr double kTimingShare = 0.04;    // of the seconds of a render, for each of a few timings of a pass
constexpr double kPassesShare = 0.75;    // of these seconds, that a pilot leaves to passes

constexpr std::string_view kGatherKey = "volume.gather";
/// What volume.gather may be chosen to be: of equals the first.
constexpr std::array kGathersToTry{GatherMode::beam, GatherMode::photon_beams};

/// Of so many decimal digits: enough for a choice, and short to write down.
double rounded(double value, int digits) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) + 1 - digits);
  return unit >= 1.0 ? std::round(value / unit) * unit : std::round(value / unit) / std::round(1.0 / unit);
}

float rounded_radius(double radius) { return static_cast<float>(rounded(radius, 3)); }

/// A gather radius to be chosen.
struct OpenRadius {
  const char* key;
  AskedGather& gather;
  const std::optional<MapDensity>& density;
  double emitted;
};

/// Those of maps that the render has.
std::vector<OpenRadius> open_radii(const Scene& scene, const AutomaticSettings& automatic,
                                   const MapDensities& densities, RenderSettings& s) {
  const Estimators planned = plan_estimators(scene, s, 0);
  const auto has = [&](std::string_view section) {
    for (const MapInfo& map : planned.maps())
      if (map.section == section) return true;
    return false;
  };
  const double emitted = photons_of_pass(s, densities.stored_per_photon);
  const double aimed = s.caustics_emitted > 0 ? static_cast<double>(s.caustics_emitted) : emitted;
  std::vector<OpenRadius> open;
  if (automatic.has("volume.radius") && has("volume"))
    open.push_back({"volume.radius", s.volume, densities.volume, emitted});
  if (automatic.has("surface.radius") && has("surface"))
    open.push_back({"surface.radius", s.surface, densities.surface, emitted});
  if (automatic.has("caustics.radius") && has("caustics"))
    open.push_back({"caustics.radius", s.caustics, densities.caustics, aimed});
  return open;
}

Choice choose_strategy(const Scene& scene, RenderSettings& settings) {
  const bool grids = std::any_of(scene.media.begin(), scene.media.end(), [](const Medium& m) { return m.grid; });
  std::string reason = "no medium is a grid: exact there, and nothing to look up";
  settings.distance.strategy = "homogeneous";
  if (grids) {
    if (!kCounts)
      throw InputError("distance.strategy: this program does not count look-ups, and cannot choose: name a strategy");
    const std::vector<StrategyCost> costs = strategy_costs(scene, settings);
    settings.distance.strategy = cheapest(costs).name;
    reason = "of exact strategies the cheapest in a pilot, in look-ups for a photon:";
    for (const StrategyCost& each : costs) reason += fmt::format(" {} {:.3g}", each.name, each.cost);
  }
  return {"distance.strategy", settings.distance.strategy, reason};
}

/// Sets the radii that are chosen, for the settings' number of photons.
std::vector<Choice> choose_radii(const Scene& scene, const AutomaticSettings& automatic, const MapDensities& densities,
                                 RenderSettings& settings) {
  std::vector<Choice> choices;
  const double diagonal = scene.bounds.diagonal();
  for (const OpenRadius& open : open_radii(scene, automatic, densities, settings)) {
    ChosenRadius chosen;
    if (open.gather.goes_by_count())
      chosen = {rounded_radius(kDefaultSearch * diagonal), "a tenth of the scene at the most: 'count' decides"};
    else if (!open.density)
      chosen = {rounded_radius(kDefaultRadius * diagonal), "a hundredth of the scene: the pilot met too few photons"};
    else
      chosen = choose_radius(*open.density, open.emitted, diagonal);
    open.gather.radius = chosen.radius;
    choices.push_back({open.key, fmt::format("{}", chosen.radius), chosen.reason});
  }
  return choices;
}

/// For points, whose eye pass takes about as long under radii that are chosen for any number of photons.
ChosenCount choose_count_of_points(double seconds, const std::function<PassCost(uint64_t)>& cost_of) {
  constexpr uint64_t kFirst = 20'000;    // photons
  constexpr uint64_t kMost = 1'000'000;  // of a pilot that asks again with the number found
  ChosenCount chosen{kFirst, ""};
  for (int round = 0; round < 2; ++round) chosen = choose_count(cost_of(std::min(chosen.count, kMost)), seconds);
  if (seconds == 0.0) return chosen;
  return make_fit(chosen, seconds,
                  [&](uint64_t photons) { return cost_of(photons).seconds(static_cast<double>(photons)); });
}

/// How long a timing of a pass may take, s: of one way to gather, or of several that are tried.
double limit_of_timing(const RenderSettings& settings) {
  const double seconds = settings.until.seconds;
  return seconds > 0.0 ? kTimingShare * seconds : kInfinity;
}
double limit_of_trial(const RenderSettings& settings) {
  constexpr double kUnhurried = 1.0;  // where the time is not limited
  return settings.until.seconds > 0.0 ? limit_of_timing(settings) / kGathersToTry.size() : kUnhurried;
}

/// Costs a pass under radii as they would be, in timings of `limit` s at the most.
Choice choose_photons(const Scene& scene, const AutomaticSettings& automatic, const MapDensities& densities,
                      double limit, RenderSettings& settings) {
  const double seconds = settings.until.seconds;
  RenderSettings tried = settings;
  const auto cost_of = [&](uint64_t photons) {
    tried.photons_emitted = photons;
    choose_radii(scene, automatic, densities, tried);
    return time_pass(scene, tried, limit);
  };
  const ChosenCount chosen = (settings.volume.gathers_flights() ? choose_count_of_flights : choose_count_of_points)(
      kPassesShare * seconds, cost_of);
  settings.photons_emitted = chosen.count;
  return {"photons.emitted", fmt::format("{}", chosen.count), chosen.reason};
}

/// The photons and the radii that are to be chosen, for the settings' gathers, by timings of `limit` s at the most.
std::vector<Choice> choose_photons_and_radii(const Scene& scene, const AutomaticSettings& automatic, double limit,
                                             RenderSettings& settings) {
  const bool photons = automatic.has("photons.emitted");
  const bool radii =
      automatic.has("volume.radius") || automatic.has("surface.radius") || automatic.has("caustics.radius");
  if (plan_estimators(scene, settings, 0).maps().empty() || !(radii || photons)) return {};
  std::vector<Choice> choices;
  const MapDensities densities = map_densities(scene, settings);
  if (photons) choices.push_back(choose_photons(scene, automatic, densities, limit, settings));
  for (Choice& choice : choose_radii(scene, automatic, densities, settings)) choices.push_back(std::move(choice));
  return choices;
}

/// A way to gather photons in media, with the photons and radii that it would have.
struct GatherTrial {
  RenderSettings settings;
  std::vector<Choice> choices{};
  double pass_seconds = 0.0;
  PassError error{};  // of a pass
};

/// The ways that the settings and the scene allow, and what is wrong with the others.
struct OpenGathers {
  std::vector<GatherTrial> trials;
  std::string refused;
};
OpenGathers open_gathers(const Scene& scene, const RenderSettings& settings) {
  OpenGathers open;
  for (const GatherMode mode : kGathersToTry) {
    GatherTrial trial{.settings = settings};
    trial.settings.volume.mode = mode;
    try {
      validate(trial.settings, facts_of(scene));
      open.trials.push_back(std::move(trial));
    } catch (const SettingError& error) {
      open.refused += fmt::format("; not {}: {}", word_of(mode), error.wrong());
    }
  }
  return open;
}

/// Chooses what else is to be chosen, and then measures what a pass costs and what error it leaves.
void run_trial(const Scene& scene, const AutomaticSettings& automatic, GatherTrial& trial) {
  const double limit = limit_of_trial(trial.settings);
  trial.choices = choose_photons_and_radii(scene, automatic, limit, trial.settings);
  const PassCost cost = time_pass(scene, trial.settings, limit);
  trial.pass_seconds = cost.seconds(photons_of_pass(trial.settings, cost.stored_per_photon));
  trial.error = error_of_pass(scene, trial.settings, cost, limit);
}

/// The time after which trials are compared, s: that of the render, or else what the least number of the longer passes
/// takes.
double seconds_to_compare(const std::vector<GatherTrial>& trials) {
  double seconds = trials.front().settings.until.seconds;
  if (seconds > 0.0) return seconds;
  for (const GatherTrial& trial : trials) seconds = std::max(seconds, kLeastPasses * trial.pass_seconds);
  return seconds;
}

/// Takes the trial that leaves the least error, with all that it chose.
std::vector<Choice> choose_of_trials(const Scene& scene, const AutomaticSettings& automatic, RenderSettings& settings) {
  constexpr double kMostPasses = 10'000.0;  // that errors are compared after
  OpenGathers open = open_gathers(scene, settings);
  if (open.trials.empty()) throw InputError(fmt::format("{}: nothing can be chosen{}", kGatherKey, open.refused));
  for (GatherTrial& trial : open.trials) run_trial(scene, automatic, trial);
  const double seconds = seconds_to_compare(open.trials);
  std::vector<double> errors;
  std::string reason = fmt::format("least error in a pilot, as relative MSE after {:.2g} s of passes:", seconds);
  for (const GatherTrial& trial : open.trials) {
    const double passes = std::clamp(seconds / trial.pass_seconds, 1.0, kMostPasses);
    errors.push_back(error_after(trial.error, trial.settings, static_cast<int>(passes)));
    reason += fmt::format("{} {} {:.2g} ({:.2g} s each)", errors.size() > 1 ? "," : "",
                          word_of(trial.settings.volume.mode), errors.back(), trial.pass_seconds);
  }
  GatherTrial& best = open.trials[least_error(errors)];
  settings = best.settings;
  best.choices.insert(best.choices.begin(),
                      {std::string(kGatherKey), word_of(settings.volume.mode), reason + open.refused});
  return best.choices;
}

/// What is tried gathers along rays, which "corrected" does not correct ball by ball.
std::vector<Choice> choose_gather(const Scene& scene, const AutomaticSettings& automatic, RenderSettings& settings) {
  if (settings.volume.boundary != BoundaryRule::corrected) return choose_of_trials(scene, automatic, settings);
  std::vector<Choice> choices = choose_photons_and_radii(scene, automatic, limit_of_timing(settings), settings);
  choices.insert(choices.begin(), {std::string(kGatherKey), word_of(settings.volume.mode),
                                   "only balls are corrected one by one, as 'boundary' asks for"});
  return choices;
}

/// Light sub-paths as many as rays from the camera, and radii as photon maps of so many photons would have: neither
/// goes by a clock.
std::vector<Choice> choose_for_combined(const Scene& scene, const AutomaticSettings& automatic,
                                        RenderSettings& settings) {
  if (automatic.has(kGatherKey))
    throw InputError(
        fmt::format("{}: where render.integrator is \"combined\" it is of no use: leave it out", kGatherKey));
  std::vector<Choice> choices;
  if (automatic.has("photons.emitted")) {
    constexpr double kMostSubPaths = 1e6;
    const double rays = static_cast<double>(scene.camera.width) * scene.camera.height * settings.samples_per_pixel;
    settings.photons_emitted = std::max(kLeastCount, static_cast<uint64_t>(rounded(std::min(rays, kMostSubPaths), 2)));
    choices.push_back({"photons.emitted", fmt::format("{}", settings.photons_emitted),
                       rays > kMostSubPaths ? "the most" : "as many as rays of a pass"});
  }
  if (!automatic.has("volume.radius") && !automatic.has("surface.radius")) return choices;
  RenderSettings maps = settings;
  maps.integrator = Integrator::photon;
  maps.volume.mode = maps.surface.mode = GatherMode::radius;
  for (Choice& choice : choose_radii(scene, automatic, map_densities(scene, maps), maps))
    choices.push_back(std::move(choice));
  settings.volume.radius = maps.volume.radius;
  settings.surface.radius = maps.surface.radius;
  return choices;
}

}  // namespace

ChosenRadius choose_radius(const MapDensity& density, double emitted, double diagonal) {
  const double share = kPhotonsWithin / density.within * density.emitted / emitted;
  const double wanted = density.reach * std::pow(share, 1.0 / density.dimension);
  const double least = kLeastRadius * density.footprint, most = kLargestRadius * diagonal;
  const std::string would = fmt::format("{:.3g} m would hold {:g} {} at a typical place of the picture", wanted,
                                        kPhotonsWithin, density.records);
  if (wanted > most) return {rounded_radius(most), "a twentieth of the scene; " + would};
  if (wanted < least) return {rounded_radius(least), "half a pixel; " + would};
  return {rounded_radius(wanted),
          fmt::format("{:g} {} of the first pass are within it at a typical place of the picture", kPhotonsWithin,
                      density.records)};
}

ChosenCount choose_count(const PassCost& cost, double seconds) {
  const char* const others = cost.caustics > 0.0 ? "eye pass with the caustic photons" : "eye pass";
  const double rest = cost.rest(), balanced = rest / cost.photon;
  double count = balanced;
  std::string reason = fmt::format("tracing and sorting them takes as long as the {}, {:.2g} s", others, rest);
  const auto fit = [&](double passes) { return (seconds / passes - rest) / cost.photon; };  // so many passes
  const double least = kLeastShare * balanced;
  if (seconds > 0.0 && fit(kLeastPasses) < balanced) {
    count = std::max(fit(kLeastPasses), least);
    reason =
        count > least
            ? fmt::format("{} passes fit into {:g} s; the {} takes {:.2g} s", kLeastPasses, seconds, others, rest)
            : fmt::format("an eighth of the time of the {}, {:.2g} s; {} passes of that alone do not fit into {:g} s",
                          others, rest, kLeastPasses, seconds);
    if (fit(1) < count && fit(1) >= kLeastCount) {
      count = fit(1);
      reason = fmt::format("a pass fits into {:g} s; the {} takes {:.2g} s of these", seconds, others, rest);
    }
  }
  if (count * cost.stored_per_photon > kMostStored) {
    count = kMostStored / cost.stored_per_photon;
    reason = fmt::format("maps of {:g} photons, the most", kMostStored);
  }
  if (count < kLeastCount) return {kLeastCount, "the least; " + reason};
  return {static_cast<uint64_t>(rounded(count, 2)), reason};
}

ChosenCount make_fit(ChosenCount chosen, double seconds, const std::function<double(uint64_t)>& pass_seconds) {
  constexpr double kFewer = 0.125, kGain = 0.8;
  double taken = pass_seconds(chosen.count);
  while (taken > seconds && kFewer * static_cast<double>(chosen.count) >= static_cast<double>(kLeastCount)) {
    const auto fewer = static_cast<uint64_t>(rounded(kFewer * static_cast<double>(chosen.count), 2));
    const double less = pass_seconds(fewer);
    if (less > kGain * taken) break;
    chosen = {fewer,
              fmt::format("with more the radii would be smaller, and the eye pass longer: a pass takes {:.2g} s, "
                          "and would take {:.2g} s with {}",
                          less, taken, chosen.count)};
    taken = less;
  }
  return chosen;
}

ChosenCount choose_count_of_flights(double seconds, const std::function<PassCost(uint64_t)>& cost_of) {
  constexpr uint64_t kMore = 4;
  constexpr double kStoredOfFlight = (kFlightBytes + kBeamBytes) / kMapBytes;  // photons that take as much memory
  const double limit = seconds > 0.0 ? seconds / kLeastPasses : kInfinity;
  uint64_t count = kLeastCount;
  for (double before = 0.0;; count *= kMore) {
    const PassCost cost = cost_of(count);
    const auto photons = static_cast<double>(count);
    const double taken = cost.seconds(photons);
    if (taken > limit && count == kLeastCount)
      return {count, fmt::format("the least; a pass takes {:.2g} s, and {} do not fit into {:g} s", taken, kLeastPasses,
                                 seconds)};
    if (taken > limit) {  // between two numbers a pass goes by a power of them
      const double power = std::log(limit / before) / std::log(taken / before);
      return {static_cast<uint64_t>(rounded(photons / kMore * std::pow(double{kMore}, power), 2)),
              fmt::format("{} passes fit into {:g} s; most of their time goes with the flights that eye rays cross",
                          kLeastPasses, seconds)};
    }
    if (photons * cost.photon >= cost.rest())
      return {count,
              fmt::format("tracing and sorting them takes as long as the eye pass, {:.2g} s, or longer", cost.rest())};
    if (kMore * photons * (cost.stored_per_photon + kStoredOfFlight * cost.flights_per_photon) > kMostStored)
      return {count, fmt::format("maps of {} times as many would take the memory of more than {:g} photons, the most",
                                 kMore, kMostStored)};
    before = taken;
  }
}

size_t least_error(std::span<const double> errors) {
  constexpr double kClearlyLess = 0.9;
  size_t best = 0;
  for (size_t i = 1; i < errors.size(); ++i)
    if (errors[i] < kClearlyLess * errors[best]) best = i;
  return best;
}

StrategyCost cheapest(std::span<const StrategyCost> costs) {
  assert(!costs.empty());
  return *std::min_element(costs.begin(), costs.end(),
                           [](const StrategyCost& a, const StrategyCost& b) { return a.cost < b.cost; });
}

std::vector<Choice> choose_settings(const Scene& scene, const AutomaticSettings& automatic, RenderSettings& settings) {
  std::vector<Choice> choices;
  if (automatic.has("distance.strategy") && !scene.media.empty()) choices.push_back(choose_strategy(scene, settings));
  if (settings.integrator == Integrator::combined) {
    for (Choice& choice : choose_for_combined(scene, automatic, settings)) choices.push_back(std::move(choice));
    return choices;
  }
  const bool gather = automatic.has(kGatherKey) && !plan_estimators(scene, settings, 0).volume.empty();
  std::vector<Choice> more = gather ? choose_gather(scene, automatic, settings)
                                    : choose_photons_and_radii(scene, automatic, limit_of_timing(settings), settings);
  for (Choice& choice : more) choices.push_back(std::move(choice));
  return choices;
}

void set_chosen(RenderSettings& settings, const std::string& key, const std::string& value) {
  const Setting* const setting = find_setting(key, settings);
  if (!setting || !setting->automatic) throw InputError(fmt::format("{} is no setting that a render chooses", key));
  const std::optional<SettingValue> chosen = parse(*setting, value);
  if (!chosen || chosen == SettingValue(uint64_t{0}))
    throw InputError(fmt::format("'{}' is no value of {} that a render chooses", value, key));
  setting->member.set(settings, *chosen);
}

}  // namespace vpm
