// The order in which settings are chosen: the strategy, the way to render, what a pass stores.
#include "vpm/tune/automatic.h"

#include <fmt/format.h>
#include <algorithm>
#include <utility>

#include "vpm/base/counters.h"
#include "vpm/base/error.h"
#include "vpm/integrators/describe.h"
#include "vpm/tune/choice_rules.h"
#include "vpm/tune/pilot.h"
#include "vpm/tune/trials.h"

namespace vpm {
namespace {

Choice choose_strategy(const Scene& scene, RenderSettings& settings) {
  const bool grids = std::any_of(scene.media.begin(), scene.media.end(), [](const Medium& m) { return m.grid; });
  std::string reason = "no medium is a grid: exact there, and nothing to look up", strategy = "homogeneous";
  if (grids) {
    if (!kCounts)
      throw InputError(
          "integrator.distance.type: this program does not count look-ups, and cannot choose: name a strategy");
    const std::vector<StrategyCost> costs = strategy_costs(scene, settings);
    strategy = cheapest(costs).name;
    reason = "of exact strategies the cheapest in a pilot, in look-ups for a photon:";
    for (const StrategyCost& each : costs) reason += fmt::format(" {} {:.3g}", each.name, each.cost);
  }
  settings.distance = {strategy};
  return {"integrator.distance.type", strategy, reason};
}

}  // namespace

Chosen choose_settings(const Scene& scene, const AutomaticSettings& automatic, const ChoosingTime& time,
                       RenderSettings& settings) {
  constexpr size_t kParts = 5;  // of the time, one for the strategy
  Chosen chosen;
  const auto strategy = [&] { chosen.choices.push_back(choose_strategy(scene, settings)); };
  if (automatic.has("integrator.distance.type") && !scene.media.empty() &&
      !time.clock.finish_by(time.end_of_next(kParts), strategy))
    chosen.not_chosen = "the time does not allow to choose a distance strategy";
  std::vector<Choice> more;
  if (asks_for_trials(scene, automatic, settings)) {
    more = choose_by_trials(scene, automatic, time, settings);
  } else if (std::string not_chosen = choose_and_scale_records(scene, automatic, time, settings, more);
             !not_chosen.empty()) {
    chosen.not_chosen = std::move(not_chosen);
  }
  for (Choice& choice : more) chosen.choices.push_back(std::move(choice));
  // The integrator first, as it decides which others there are.
  std::stable_partition(chosen.choices.begin(), chosen.choices.end(),
                        [](const Choice& choice) { return choice.key == "integrator.type"; });
  return chosen;
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
