// Settings for people, from their declarations: what each may hold, and the page of all.
#pragma once

#include <string>

#include "vpm/job/setting.h"

namespace vpm {

/// What a setting may hold, and its default, in Markdown.
std::string values_of(const Setting& setting);
std::string usual_of(const Setting& setting);

/// A table in Markdown: a row for each setting, and one for settings of several sections that differ in nothing else.
std::string settings_table();

}  // namespace vpm
