// What the numbers of a material must be.
#pragma once

#include <string>

#include "vpm/surface/material.h"

namespace vpm {

/// The first number of a material that is out of its range, and that range, as a clause: "its reflectance must lie in
/// [0, 1]"; "" where there is none.
std::string problem_of(const Material& material);

}  // namespace vpm
