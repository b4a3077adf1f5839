// Every setting that there is, whatever is chosen.
#pragma once

#include <string>
#include <vector>

#include "vpm/base/settings/setting.h"

namespace vpm {

/// A setting that some components have, and what must be chosen for it.
struct SettingOfSome {
  Setting setting;
  std::vector<std::string> integrators;  // that have it; empty: all
  std::vector<std::string> with;         // the other choices: "`type` = `"nearest"`"
};
/// Every setting that there is, table by table. Several have one key where components mean different things by it.
const std::vector<SettingOfSome>& every_setting();

}  // namespace vpm
