// vpm error --series.
#pragma once

#include "commands.h"

namespace vpm::tools {

/// Prints how far pictures are from the last of them, and how that falls with passes. Returns the exit status.
int compare_series(const ErrorOptions& options);

}  // namespace vpm::tools
