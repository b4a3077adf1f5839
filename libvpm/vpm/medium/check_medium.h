// What the numbers of a medium must be.
#pragma once

#include <string>

#include "vpm/medium/medium.h"

namespace vpm {

/// The first number of a medium that is out of its range, and that range, as a clause: "its g must lie between -1 and
/// 1"; "" where there is none. Of its grid nothing is asked.
std::string problem_of(const Medium& medium);

}  // namespace vpm
