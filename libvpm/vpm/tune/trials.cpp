// Each way is measured by itself, and then all by what the others have seen.
#include "vpm/tune/trials.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>

#include "vpm/base/error.h"
#include "vpm/integrators/describe.h"
#include "vpm/integrators/photon_map/plan.h"
#include "vpm/integrators/render_scene.h"
#include "vpm/integrators/words.h"
#include "vpm/render/pass_time.h"
#include "vpm/render/render.h"
#include "vpm/tune/choice_rules.h"
#include "vpm/tune/choose_records.h"
#include "vpm/tune/pilot_error.h"
#include "vpm/tune/scale_records.h"

namespace vpm {
namespace {

constexpr double kTimingShare = 0.04;  // of the seconds of a render, for each of a few timings of a pass
constexpr std::string_view kIntegratorKey = "integrator.type", kGatherKey = "integrator.volume.type",
                           kTechniquesKey = "integrator.techniques";
constexpr const char* kSeeIntegrator = "with integrator.type, see there";

// What may be tried: of equals the first is chosen.
constexpr std::array kIntegratorsToTry{Integrator::photon, Integrator::combined, Integrator::path};
constexpr std::array<std::string_view, 2> kGathersToTry{"beam", "photon-beams"};

/// Are photons in media to be gathered in a way that is chosen?
bool gathers_in_media(const Scene& scene, const AutomaticSettings& automatic, RenderSettings settings) {
  settings.integrator = Integrator::photon;
  return automatic.has(kGatherKey) && !plan_estimators(scene, settings, 0).volume.empty();
}

/// A way to render, with all that it would choose.
struct Trial {
  RenderSettings settings;
  std::string name;
  std::vector<Choice> choices{};
  std::optional<ScaledPasses> passes{};
  RecordFactors factors{};  // of what else was chosen

  double pass_seconds() const { return passes->seconds_of_pass(factors); }
};

/// One trial of photon maps, or one for each gather in media that may be chosen. What is tried gathers along rays,
/// which "corrected" does not correct ball by ball.
std::vector<Trial> trials_of_maps(const Scene& scene, const AutomaticSettings& automatic, const Trial& photons) {
  if (!gathers_in_media(scene, automatic, photons.settings) ||
      photons.settings.volume.boundary == BoundaryRule::corrected)
    return {photons};
  std::vector<Trial> trials;
  for (const std::string_view type : kGathersToTry) {
    trials.push_back(photons);
    trials.back().settings.volume.choose(type);
    trials.back().name =
        automatic.has(kIntegratorKey) ? fmt::format("{} by {}", photons.name, type) : std::string(type);
  }
  return trials;
}

bool chooses_techniques(const AutomaticSettings& automatic) {
  return automatic.has(kIntegratorKey) || automatic.has(kTechniquesKey);
}

/// One trial of combined techniques, or of those that are used without asking; without beams, which cost most and find
/// nothing where there are no media, and without light tracing, whose shadow rays may cost more than they are worth.
std::vector<Trial> trials_of_techniques(const Scene& scene, const AutomaticSettings& automatic, const Trial& all) {
  if (!chooses_techniques(automatic) || all.settings.combined.techniques != TechniqueSet()) return {all};
  const auto without = [&](std::initializer_list<Technique> left_out) {
    Trial trial = all;
    std::vector<std::string_view> names;
    for (const Technique technique : left_out) {
      trial.settings.combined.techniques.set(technique, false);
      names.push_back(kTechniques[static_cast<size_t>(technique)].name);
    }
    trial.name += fmt::format(" without {}", fmt::join(names, ", "));
    return trial;
  };
  if (!facts_of(scene).scattering_media)
    return {without({Technique::short_beams, Technique::light_tracing}), without({Technique::short_beams})};
  return {without({Technique::short_beams, Technique::light_tracing}), without({Technique::short_beams}), all};
}

/// One trial of each way, allowed or not.
std::vector<Trial> all_trials(const Scene& scene, const AutomaticSettings& automatic, const RenderSettings& settings) {
  std::vector<Trial> trials;
  for (const Integrator integrator : kIntegratorsToTry) {
    if (!automatic.has(kIntegratorKey) && integrator != settings.integrator) continue;
    Trial trial{settings, word_of(integrator)};
    trial.settings.integrator = integrator;
    std::vector<Trial> more = integrator == Integrator::photon     ? trials_of_maps(scene, automatic, trial)
                              : integrator == Integrator::combined ? trials_of_techniques(scene, automatic, trial)
                                                                   : std::vector<Trial>{trial};
    for (Trial& each : more) trials.push_back(std::move(each));
  }
  return trials;
}

/// Those that the settings and the scene allow, and what is wrong with the others.
struct OpenTrials {
  std::vector<Trial> trials;
  std::string refused;
};
OpenTrials open_trials(const Scene& scene, const AutomaticSettings& automatic, const RenderSettings& settings) {
  OpenTrials open;
  std::string last;  // of several ways of the same integrator, which have the same fault
  for (Trial& trial : all_trials(scene, automatic, settings)) {
    try {
      validate(trial.settings, facts_of(scene));
      open.trials.push_back(std::move(trial));
    } catch (const SettingError& error) {
      const bool combined = trial.settings.integrator == Integrator::combined;
      const std::string name = combined ? word_of(Integrator::combined) : trial.name;
      if (error.wrong() != last) open.refused += fmt::format("; not {}: {}", name, error.wrong());
      last = error.wrong();
    }
  }
  return open;
}

/// How long a timing of a pass may take where one way is timed alone, s.
double limit_of_timing(const RenderSettings& settings) {
  const double seconds = settings.until.seconds;
  return seconds > 0.0 ? kTimingShare * seconds : kInfinity;
}

/// The same of each of the four by which records are scaled.
double limit_of_scaling(const RenderSettings& settings) {
  constexpr double kPart = 0.5, kUnlimited = 0.25;
  return std::min(kPart * limit_of_timing(settings), kUnlimited);
}

/// How long each timing of several trials may take, s.
double limit_of_trial(const RenderSettings& settings, size_t trials) {
  constexpr double kUnhurried = 0.25;  // where the time is not limited
  constexpr double kPart = 0.75;       // of the time that a single way has, for all of several
  return settings.until.seconds > 0.0 ? kPart * limit_of_timing(settings) / static_cast<double>(trials) : kUnhurried;
}

/// What trials choose their records by: measured once for all that combine techniques, as it is the same for them.
class DensitiesOfTrials {
 public:
  DensitiesOfTrials(const Scene& scene, const AutomaticSettings& automatic) : scene_(scene), automatic_(automatic) {}

  std::optional<MapDensities> of(const RenderSettings& settings) {
    if (settings.integrator != Integrator::combined) return densities_for_records(scene_, automatic_, settings);
    if (!measured_) combined_ = densities_for_records(scene_, automatic_, settings);
    measured_ = true;
    return combined_;
  }

 private:
  const Scene& scene_;
  const AutomaticSettings& automatic_;
  std::optional<MapDensities> combined_;
  bool measured_ = false;
};

/// Chooses what else is to be chosen, and then measures what passes cost and what error they leave.
void run_trial(const Scene& scene, const AutomaticSettings& automatic, DensitiesOfTrials& densities, double limit,
               Trial& trial) {
  trial.choices = choose_records(scene, automatic, densities.of(trial.settings), limit, trial.settings);
  trial.passes.emplace(scene, limit, trial.settings, trial.choices);
  trial.factors = trial.passes->best_factors();
}

/// Runs all, and leaves those that came to an end, or else the first with default radii. Returns "; not NAME: ..." of
/// the others.
std::string run_trials(const Scene& scene, const AutomaticSettings& automatic, const ChoosingTime& time,
                       std::vector<Trial>& trials) {
  const double limit = limit_of_trial(trials.front().settings, trials.size());
  DensitiesOfTrials densities(scene, automatic);
  std::vector<Trial> measured;
  std::string others;
  for (size_t i = 0; i < trials.size(); ++i) {
    Trial trial = trials[i];
    if (time.clock.finish_by(time.end_of_next(trials.size() - i),
                             [&] { run_trial(scene, automatic, densities, limit, trial); }))
      measured.push_back(std::move(trial));
    else
      others += fmt::format("; not {}: the time does not allow to measure it", trial.name);
  }
  if (measured.empty()) {
    measured.push_back(trials.front());
    Trial& first = measured.front();
    first.choices = choose_default_radii(scene, automatic, first.settings);
  }
  trials = std::move(measured);
  return others;
}

/// The time after which trials are compared, s: that of the render, or else what the least number of the longest passes
/// takes.
double seconds_to_compare(const std::vector<Trial>& trials) {
  double seconds = trials.front().settings.until.seconds;
  if (seconds > 0.0) return seconds;
  for (const Trial& trial : trials) seconds = std::max(seconds, kLeastPasses * trial.pass_seconds());
  return seconds;
}

/// Does a pass fit into the time that is asked for, if any is?
bool fits(const Trial& trial) {
  const double seconds = trial.settings.until.seconds;
  return seconds == 0.0 || trial.pass_seconds() <= longest_time(seconds);
}

/// What each trial leaves after that time. Light that the rays of one have not met is noise of it. Nothing good is said
/// of those of which no pass fits, where others do; where none does, the quickest is best.
std::vector<double> errors_after(double seconds, const std::vector<Trial>& trials) {
  constexpr double kMostPasses = 10'000.0;  // that errors are compared after
  const bool any_fits = std::any_of(trials.begin(), trials.end(), fits);
  std::vector<double> errors;
  for (const Trial& trial : trials) {
    if (!fits(trial)) {
      errors.push_back(any_fits ? kInfinity : trial.pass_seconds());
      continue;
    }
    double unseen = 0.0;
    for (const Trial& other : trials)
      unseen = std::max(unseen, unseen_light(trial.passes->shown(), other.passes->shown()));
    const double passes = std::clamp(seconds / trial.pass_seconds(), 1.0, kMostPasses);
    errors.push_back(
        trial.passes->error_after_passes(passes, trial.factors, unseen / trial.settings.samples_per_pixel));
  }
  return errors;
}

/// "least error in a pilot, as relative MSE after 20 s of passes: beam 0.01 (0.2 s each), photon-beams 0.02 (1 s each)"
std::string reason_of(double seconds, const std::vector<Trial>& trials, const std::vector<double>& errors) {
  std::string reason = fmt::format("least error in a pilot, as relative MSE after {:.2g} s of passes:", seconds);
  for (size_t i = 0; i < trials.size(); ++i) {
    const std::string error = fits(trials[i]) ? fmt::format(" {:.2g}", errors[i]) : "";
    reason += fmt::format("{} {}{} ({:.2g} s each{})", i > 0 ? "," : "", trials[i].name, error,
                          trials[i].pass_seconds(), error.empty() ? ", too long" : "");
  }
  return reason;
}

/// Tries all, and leaves the one with the least error first. Returns why.
std::string put_best_first(const Scene& scene, const AutomaticSettings& automatic, const ChoosingTime& time,
                           std::vector<Trial>& trials) {
  const std::string unmeasured = run_trials(scene, automatic, time, trials);
  if (!trials.front().passes) return "the first of all" + unmeasured;
  const double seconds = seconds_to_compare(trials);
  const std::vector<double> errors = errors_after(seconds, trials);
  std::string reason = reason_of(seconds, trials, errors) + unmeasured;
  std::swap(trials.front(), trials[least_error(errors)]);
  Trial& best = trials.front();
  scale(scene, best.factors, best.settings, best.choices);
  return reason;
}

/// What was tried, with the reason: the integrator, and the gather of photons in media, or the techniques.
std::vector<Choice> choices_of(const Scene& scene, const AutomaticSettings& automatic, const Trial& best,
                               const std::string& reason) {
  std::vector<Choice> choices;
  const RenderSettings& settings = best.settings;
  if (automatic.has(kIntegratorKey))
    choices.push_back({std::string(kIntegratorKey), word_of(settings.integrator), reason});
  if (settings.integrator == Integrator::photon && gathers_in_media(scene, automatic, settings)) {
    const bool ball_by_ball = settings.volume.boundary == BoundaryRule::corrected;
    const std::string why = ball_by_ball ? "only balls are corrected one by one, as 'boundary' asks for" : reason;
    choices.push_back({std::string(kGatherKey), settings.volume.type(), choices.empty() ? why : kSeeIntegrator});
  }
  RenderSettings chosen = settings;
  if (settings.integrator == Integrator::combined && chooses_techniques(automatic))
    choices.push_back({std::string(kTechniquesKey), std::get<std::string>(find_setting(chosen, kTechniquesKey)->get()),
                       choices.empty() ? reason : kSeeIntegrator});
  for (const Choice& choice : best.choices) choices.push_back(choice);
  return choices;
}

}  // namespace

bool asks_for_trials(const Scene& scene, const AutomaticSettings& automatic, const RenderSettings& settings) {
  if (automatic.has(kIntegratorKey)) return true;
  if (settings.integrator == Integrator::combined) return automatic.has(kTechniquesKey);
  return settings.integrator == Integrator::photon && gathers_in_media(scene, automatic, settings);
}

std::string choose_and_scale_records(const Scene& scene, const AutomaticSettings& automatic, const ChoosingTime& time,
                                     RenderSettings& settings, std::vector<Choice>& choices) {
  RenderSettings tried = settings;
  std::vector<Choice> found;
  const auto choose = [&] { found = choose_records(scene, automatic, limit_of_timing(settings), tried); };
  if (!time.clock.finish_by(time.end, choose)) {
    choices = choose_default_radii(scene, automatic, settings);
    return "the time does not allow to choose photons and radii";
  }
  settings = tried;
  choices = found;
  const auto scale = [&] { scale_records(scene, limit_of_scaling(settings), tried, found); };
  if (!time.clock.finish_by(time.end, scale)) return "the time does not allow to scale photons and radii";
  settings = tried;
  choices = found;
  return "";
}

std::vector<Choice> choose_by_trials(const Scene& scene, const AutomaticSettings& automatic, const ChoosingTime& time,
                                     RenderSettings& settings) {
  auto [trials, refused] = open_trials(scene, automatic, settings);
  if (trials.empty()) throw InputError(fmt::format("nothing can be chosen{}", refused));
  std::string reason;
  if (trials.size() == 1) {
    Trial& only = trials.front();
    reason = "no other way is open" + refused;
    const std::string not_chosen = choose_and_scale_records(scene, automatic, time, only.settings, only.choices);
    if (!not_chosen.empty()) reason += "; " + not_chosen;
  } else {
    reason = put_best_first(scene, automatic, time, trials) + refused;
  }
  settings = trials.front().settings;
  return choices_of(scene, automatic, trials.front(), reason);
}

}  // namespace vpm
