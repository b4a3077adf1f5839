// By time, a race of ways to render; else radii by where photons lie, and their number by what is counted.
#include "vpm/tune/automatic.h"

#include <fmt/format.h>
#include <algorithm>
#include <optional>

#include "vpm/base/counters.h"
#include "vpm/base/error.h"
#include "vpm/integrators/default_radii.h"
#include "vpm/integrators/describe.h"
#include "vpm/integrators/words.h"
#include "vpm/tune/race.h"
#include "vpm/tune/small_pass.h"

namespace vpm {
namespace {

constexpr const char* kIntegratorKey = "integrator.type";
constexpr const char* kPhotonsKey = "integrator.photons.emitted";

/// As many photons as have as many rays and look-ups as those from the eye; nothing where there are none.
std::optional<Choice> photons_by_counts(const Scene& scene, RenderSettings settings) {
  constexpr double kPilot = 20'000.0, kFewest = 1000.0;  // photons
  settings.seed = ~settings.seed;
  settings.photons.emitted = static_cast<uint64_t>(kPilot);
  settings.caustics.emitted = std::min(settings.caustics.emitted, settings.photons.emitted);
  const SmallPass pass = render_small(scene, settings, 0, BlocksTaken::all, WallClock());
  if (pass.photon_steps == 0) return std::nullopt;
  const double balanced = pass.eye_steps / static_cast<double>(pass.photon_steps) * pass.photons;
  const double most = std::max(kFewest, pass.most_photons());
  std::string reason = "as many rays and look-ups as from the eye";
  if (balanced < kFewest) reason = "the least; fewer have " + reason;
  if (balanced > most) reason = "maps of 1.3 GB, the most; more have " + reason;
  const auto photons = static_cast<uint64_t>(rounded(std::clamp(balanced, kFewest, most), 2));
  return Choice{kPhotonsKey, fmt::format("{}", photons), reason};
}

std::vector<Choice> choose_by_counts(const Scene& scene, const AutomaticSettings& automatic, RenderSettings& settings) {
  std::vector<Choice> choices;
  if (automatic.has(kIntegratorKey))
    choices.push_back({kIntegratorKey, word_of(settings.integrator), "the first, as no time is asked for to compare"});
  if (automatic.has(kPhotonsKey) && settings.integrator != Integrator::path && kCounts) {
    if (const std::optional<Choice> photons = photons_by_counts(scene, settings)) {
      set_chosen(settings, photons->key, photons->value);
      choices.push_back(*photons);
    }
  }
  for (Choice& choice : choose_default_radii(scene, automatic, settings)) choices.push_back(std::move(choice));
  return choices;
}

/// The components of the winner that were to be chosen: the integrator first.
std::vector<Choice> components_of(const AutomaticSettings& automatic, const Winner& winner) {
  std::vector<Choice> choices;
  RenderSettings settings = winner.settings;
  for (const Setting& setting : describe(settings)) {
    const bool is_component =
        std::holds_alternative<Words>(setting.domain) || std::holds_alternative<WordSet>(setting.domain);
    const bool open = automatic.has(setting.key) || automatic.has(kIntegratorKey);
    if (!setting.automatic || !is_component || !open) continue;
    choices.push_back({setting.key, std::get<std::string>(setting.get()),
                       choices.empty() ? winner.reason : fmt::format("with {}, see there", choices.front().key)});
  }
  return choices;
}

}  // namespace

std::vector<Choice> choose_settings(const Scene& scene, const AutomaticSettings& automatic, const Clock& clock,
                                    RenderSettings& settings) {
  if (settings.until.seconds == 0.0) return choose_by_counts(scene, automatic, settings);
  const OpenWays open = open_ways(scene, automatic, settings);
  if (open.ways.empty()) throw InputError(fmt::format("nothing can be chosen{}", open.refused));
  Winner winner = race(scene, automatic, open.ways, clock);
  winner.reason += open.refused;
  settings = winner.settings;
  std::vector<Choice> choices = components_of(automatic, winner);
  for (Choice& choice : winner.choices) choices.push_back(std::move(choice));
  return choices;
}

void set_chosen(RenderSettings& settings, const std::string& key, const std::string& value) {
  const std::optional<Setting> setting = find_setting(settings, key);
  if (!setting || !setting->automatic) throw InputError(fmt::format("{} is no setting that a render chooses", key));
  const std::optional<SettingValue> chosen = parse(*setting, value);
  if (!chosen || chosen == SettingValue(uint64_t{0}))
    throw InputError(fmt::format("'{}' is no value of {} that a render chooses", value, key));
  setting->set(*chosen);
}

}  // namespace vpm
