// Choices are read as other settings are.
#include "vpm/integrators/choice.h"

#include <fmt/format.h>
#include <optional>

#include "vpm/base/error.h"
#include "vpm/integrators/describe.h"

namespace vpm {

void set_chosen(RenderSettings& settings, const std::string& key, const std::string& value) {
  const std::optional<Setting> setting = find_setting(settings, key);
  if (!setting || !setting->automatic) throw InputError(fmt::format("{} is no setting that a render chooses", key));
  const std::optional<SettingValue> chosen = parse(*setting, value);
  if (!chosen || chosen == SettingValue(uint64_t{0}))
    throw InputError(fmt::format("'{}' is no value of {} that a render chooses", value, key));
  setting->set(*chosen);
}

}  // namespace vpm
