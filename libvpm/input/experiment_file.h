// A comparison's TOML file becomes an Experiment. The format is described in scenes/experiments/README.md.
#pragma once

#include <string>

#include "study/compare/experiment.h"

namespace vpm {

/// Reads an experiment. Paths in the file are relative to its folder. The scenes it names are not read. Throws
/// InputError for anything that is not right, telling file:line:column.
Experiment load_experiment(const std::string& path);

}  // namespace vpm
