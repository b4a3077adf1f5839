// The list of distance strategies.
#include "vpm/medium/distance/strategy.h"

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

#include "vpm/base/settings/setting.h"

namespace vpm {

extern const StrategyInfo kRegular, kHomogeneous, kLocalExtinction, kMeanExtinction, kRayMarch, kRayMarchAdaptive,
    kDelta, kDeltaLocal, kProgressiveNull, kWeighted, kDecomposition;

std::span<const StrategyInfo> distance_strategies() {
  static const std::vector<StrategyInfo> all{kRegular,         kHomogeneous,      kLocalExtinction, kMeanExtinction,
                                             kRayMarch,        kRayMarchAdaptive, kDelta,           kDeltaLocal,
                                             kProgressiveNull, kWeighted,         kDecomposition};
  return all;
}

const StrategyInfo* find_strategy(std::string_view name) {
  const auto all = distance_strategies();
  const auto found = std::find_if(all.begin(), all.end(), [&](const StrategyInfo& info) { return info.name == name; });
  return found == all.end() ? nullptr : &*found;
}

const StrategyInfo& strategy_info(std::string_view name) {
  const StrategyInfo* const info = find_strategy(name);
  assert(info);
  return *info;
}

std::vector<std::string> strategies_that(bool StrategyInfo::*is) {
  std::vector<std::string> names;
  for (const StrategyInfo& info : distance_strategies())
    if (info.*is) names.emplace_back(info.name);
  return names;
}

std::unique_ptr<DistanceStrategy> make_distance_strategy(const DistanceSettings& settings, const FlightUse& use) {
  const StrategyInfo* const info = find_strategy(settings.strategy);
  return info ? info->make(numbers_of(info->parameters, settings.parameters), use) : nullptr;
}

void describe(DistanceSettings& settings, std::vector<std::string> types, const std::string& default_type,
              Description& description) {
  Members(settings, description, {default_type})
      .add("type", &DistanceSettings::strategy, Words{std::move(types)},
           "how photons and paths fly; [papers/distance-strategies.md](../papers/distance-strategies.md) says what "
           "each strategy is and how it fails. `\"homogeneous\"` is refused in grids");
  if (const StrategyInfo* const info = find_strategy(settings.strategy))
    describe(info->parameters, settings.parameters, description);
}

}  // namespace vpm
