// The words of the enumerations that gathers hold.
#pragma once

#include "vpm/base/settings/setting.h"
#include "vpm/estimate/gather.h"

namespace vpm {

template <>
struct WordsOf<GatherMode> {
  static constexpr std::array<std::string_view, 2> words{"radius", "nearest"};
};
template <>
struct WordsOf<KernelKind> {
  static constexpr auto words = [] {
    std::array<std::string_view, kKernels.size()> names;
    for (size_t i = 0; i < names.size(); ++i) names[i] = kKernels[i].name;
    return names;
  }();
};
template <>
struct WordsOf<BoundaryRule> {
  static constexpr std::array<std::string_view, 3> words{"none", "corrected", "ends"};
};
}  // namespace vpm
