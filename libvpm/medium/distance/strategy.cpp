// The list of distance strategies.
#include "medium/distance/strategy.h"

#include <array>

#include "medium/distance/strategies.h"

namespace vpm {

std::span<const StrategyInfo> distance_strategies() {
  static constexpr std::array<StrategyInfo, 5> kStrategies{{
      {.name = "regular", .summary = "exact in any medium: cells walked, the quartic column inverted"},
      {.name = "homogeneous", .summary = "exact in a medium of constant density", .heterogeneous = false},
      {.name = "local-extinction",
       .summary = "exponential at the rate where the segment starts; weights without bound",
       .bounded_weight = false},
      {.name = "mean-extinction",
       .summary = "exponential at the medium's mean rate; weights without bound",
       .bounded_weight = false},
      {.name = "ray-march",
       .summary = "marched until the transmittance reaches the random number; bias falls as step^2",
       .unbiased = false},
  }};
  return kStrategies;
}

std::unique_ptr<DistanceStrategy> make_distance_strategy(const DistanceSettings& settings) {
  if (settings.strategy == "regular") return std::make_unique<Regular>();
  if (settings.strategy == "homogeneous") return std::make_unique<Homogeneous>();
  if (settings.strategy == "local-extinction") return std::make_unique<LocalExtinction>(settings.extinction_floor);
  if (settings.strategy == "mean-extinction") return std::make_unique<MeanExtinction>();
  if (settings.strategy == "ray-march") return std::make_unique<RayMarch>(settings.step);
  return nullptr;
}

}  // namespace vpm
