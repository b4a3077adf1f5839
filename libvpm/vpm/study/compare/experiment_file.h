// A comparison's TOML file becomes an Experiment. The format is described in scenes/experiments/README.md.
#pragma once

#include <string>

#include "vpm/study/compare/plan.h"

namespace vpm {

/// Reads an experiment. `overrides` are `key.path=value` options that change keys of the file first, as those of
/// load_scene(). Paths in the file are relative to its folder. The scenes it names are not read. Throws InputError for
/// anything that is not right, telling file:line:column, or the option.
ComparisonPlan load_comparison_plan(const std::string& path, const std::vector<std::string>& overrides = {});

}  // namespace vpm
