// vpm validate --oracles: every case of a folder of reference numbers.
#pragma once

#include "commands.h"

namespace vpm::tools {

/// Runs all cases and prints their checks. 1 where a check fails, or where a case was not checked, except the known
/// limits of the framework.
int oracle_command(const ValidateOptions& options);

}  // namespace vpm::tools
