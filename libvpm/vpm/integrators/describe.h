// The settings of a render, as its components describe them.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vpm/base/settings/setting.h"
#include "vpm/integrators/settings.h"

namespace vpm {

/// The largest value of render.passes: more than will be rendered.
inline constexpr int kMostPasses = 1'000'000'000;

/// Those of [render], and those that the integrator and the components that it uses have, in the order in which they
/// are read: another value of one may change which others follow it. They are settings of the object that is given,
/// which must outlive them.
std::vector<Setting> describe(RenderSettings& settings);
/// The setting of that key; nothing where these components have none.
std::optional<Setting> find_setting(RenderSettings& settings, std::string_view key);

/// Settings of these values by key, as options write them. What is no value of a setting is passed over.
RenderSettings settings_with(const std::map<std::string, std::string>& values);

/// A setting and its value.
struct Field {
  std::string key;
  SettingValue value;
};
/// The settings that decide what passes estimate.
std::vector<Field> estimate_fields(RenderSettings settings);
/// These as one line, "key=value key=value", of which field_of() finds each.
std::string settings_line(const RenderSettings& settings);
/// The value of a key in words "key=value"; nothing where it is missing.
std::optional<std::string> field_of(std::string_view line, std::string_view key);

/// The integrator that such a line names, as it is called today; nothing where it names none.
std::optional<std::string> integrator_of(std::string_view line);

}  // namespace vpm
