// Numbers by name, and their descriptions.
#include "vpm/base/settings/parameter.h"

#include <algorithm>
#include <cassert>
#include <stdexcept>

#include "vpm/base/settings/setting.h"

namespace vpm {
namespace {

const Parameter* find(std::span<const Parameter> list, std::string_view name) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const Parameter& each) { return each.name == name; });
  return found == list.end() ? nullptr : &*found;
}

float value_in(const Parameters& given, const Parameter& parameter) {
  const auto found = given.find(parameter.name);
  return found == given.end() ? parameter.default_value : found->second;
}

}  // namespace

Parameters among(std::span<const Parameter> list, Parameters given) {
  std::erase_if(given, [&](const auto& number) { return !find(list, number.first); });
  return given;
}

float number_of(std::span<const Parameter> list, const Parameters& given, std::string_view name) {
  const Parameter* const parameter = find(list, name);
  assert(parameter);
  return value_in(given, *parameter);
}

std::vector<float> numbers_of(std::span<const Parameter> list, const Parameters& given) {
  for (const auto& [name, value] : given)
    if (!find(list, name)) throw std::invalid_argument("there is no parameter '" + name + "'");
  std::vector<float> numbers;
  for (const Parameter& parameter : list) numbers.push_back(value_in(given, parameter));
  return numbers;
}

void describe(std::span<const Parameter> list, Parameters& given, Description& description) {
  for (const Parameter& parameter : list)
    description.add(parameter.name, {{.unit = parameter.unit},
                                     "",
                                     std::string(parameter.meaning),
                                     Numbers{parameter.range},
                                     parameter.default_value,
                                     [&given, parameter] { return SettingValue(value_in(given, parameter)); },
                                     [&given, parameter](const SettingValue& value) {
                                       set_member(given[std::string(parameter.name)], value);
                                     }});
}

}  // namespace vpm
