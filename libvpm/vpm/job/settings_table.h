// The page of all settings, from their declarations.
#pragma once

#include <string>

namespace vpm {

/// A table in Markdown: a row for each setting, and one for settings of several sections that differ in nothing else.
std::string settings_table();

}  // namespace vpm
