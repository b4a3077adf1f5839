// What the numbers of a light must be.
#pragma once

#include <string>

#include "vpm/light/light.h"

namespace vpm {

/// The first number of a light that is out of its range, and that range, as a clause: "its radius must be positive and
/// finite"; "" where there is none. A light that is black is wrong. The shape of an area light is not looked at.
std::string problem_of(const Light& light);

}  // namespace vpm
