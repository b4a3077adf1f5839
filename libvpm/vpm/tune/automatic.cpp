// By time, a race of ways to render; else radii by where photons lie, and their number by what is counted.
#include "vpm/tune/automatic.h"

#include <fmt/format.h>
#include <optional>

#include "vpm/base/error.h"
#include "vpm/integrators/default_photons.h"
#include "vpm/integrators/default_radii.h"
#include "vpm/integrators/describe.h"
#include "vpm/integrators/open_ways.h"
#include "vpm/integrators/words.h"
#include "vpm/tune/race.h"

namespace vpm {
namespace {

constexpr const char* kIntegratorKey = "integrator.type";

std::vector<Choice> choose_by_counts(const Scene& scene, const AutomaticSettings& automatic, RenderSettings& settings) {
  std::vector<Choice> choices;
  if (automatic.has(kIntegratorKey))
    choices.push_back({kIntegratorKey, word_of(settings.integrator), "the first, as no time is asked for to compare"});
  if (const std::optional<Choice> photons = choose_default_photons(scene, automatic, settings))
    choices.push_back(*photons);
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
                       choices.empty() ? winner.reason : fmt::format("chosen with {}", choices.front().key)});
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

}  // namespace vpm
