// Settings for people: what each may hold, and the table of all.
#pragma once

#include <string>

#include "vpm/integrators/describe.h"

namespace vpm {

/// What a setting may hold, and its default, in Markdown.
std::string values_of(const Setting& setting);
std::string default_of(const Setting& setting);

/// A table in Markdown: a row for each setting, and one for settings of several tables that differ in nothing else.
std::string settings_table();

}  // namespace vpm
