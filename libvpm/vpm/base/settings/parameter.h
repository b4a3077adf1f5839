// Numbers of components that are chosen by name: each component lists its own.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vpm/base/settings/range.h"

namespace vpm {

class Description;

/// A number that a component has.
struct Parameter {
  std::string_view name;
  float default_value;
  Range range;
  std::string_view unit;
  std::string_view meaning;  // one line of Markdown
};

/// Numbers by name. Those that are not given have their defaults.
using Parameters = std::map<std::string, float, std::less<>>;

/// Those of a list, in its order.
using ParameterValues = std::span<const float>;

/// The range of a march's step in voxels: shorter ones would never come to an end.
inline constexpr Range kVoxels{1e-3, kNoLimit, false, true};

/// Those of the given numbers that the list has.
Parameters among(std::span<const Parameter> list, Parameters given);
/// One number of the list.
float number_of(std::span<const Parameter> list, const Parameters& given, std::string_view name);
/// The numbers in the order of the list. Throws std::invalid_argument where one is given that the list does not have.
std::vector<float> numbers_of(std::span<const Parameter> list, const Parameters& given);

void describe(std::span<const Parameter> list, Parameters& given, Description& description);

}  // namespace vpm
