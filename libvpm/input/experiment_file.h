// A comparison's TOML file becomes an Experiment. The format is described in scenes/experiments/README.md.
#pragma once

#include <string>

#include "study/compare/plan.h"

namespace vpm {

/// Reads an plan. Paths in the file are relative to its folder. The scenes it names are not read. Throws
/// InputError for anything that is not right, telling file:line:column.
ComparisonPlan load_comparison_plan(const std::string& path);

}  // namespace vpm
