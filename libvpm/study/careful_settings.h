// Settings under which the bias of a distance strategy, where it has one, is far below the noise of any study.
#pragma once

#include <string>
#include <string_view>

#include "medium/distance/strategy.h"

namespace vpm {

inline DistanceSettings careful_settings(std::string_view strategy) {
  return {.strategy = std::string(strategy), .step = 0.1f, .optical_step = 0.02f, .majorant = 1.0f};
}

}  // namespace vpm
