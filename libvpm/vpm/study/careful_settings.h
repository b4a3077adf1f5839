// Settings under which the bias of a distance strategy, where it has one, is far below the noise of any study; of the
// one that needs no majorants that bound, under some that do not.
#pragma once

#include <string>
#include <string_view>

#include "vpm/medium/distance/strategy.h"

namespace vpm {

inline constexpr float kCarefulStep = 0.1f;  // voxels

inline DistanceSettings careful_settings(std::string_view strategy) {
  const StrategyInfo& info = strategy_info(strategy);
  const float majorant = info.positive ? 1.0f : 0.5f;
  return {std::string(strategy),
          among(info.parameters, {{"step", kCarefulStep}, {"optical_step", 0.02f}, {"majorant", majorant}})};
}

}  // namespace vpm
