// Errors say the key first.
#include "vpm/base/settings/setting_error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

namespace vpm {

SettingError::SettingError(std::string key, std::string wrong, std::string right)
    : InputError(fmt::format("{}: {}{}{}", key, wrong, right.empty() ? "" : "\n  ", right)),
      key_(std::move(key)),
      wrong_(std::move(wrong)),
      right_(std::move(right)) {}

void refuse_if(bool contradiction, const char* key, const std::string& wrong, const std::string& right) {
  if (contradiction) throw SettingError(key, wrong, right);
}

std::string listed(const char* title, const std::vector<std::string>& names) {
  return fmt::format("{}: {}", title, fmt::join(names, ", "));
}

}  // namespace vpm
