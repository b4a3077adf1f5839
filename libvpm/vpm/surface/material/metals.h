// Measured indices of refraction of metals, by name.
#pragma once

#include <array>

#include "vpm/base/vec.h"

namespace vpm {

/// The complex index eta + i k in vacuum.
struct Metal {
  const char* name;
  Rgb eta, k;
};

/// At 650, 550 and 450 nm for red, green and blue, interpolated linearly in the wavelength between the entries of the
/// tables of [Johnson1972] (gold, silver, copper), [Rakic1995] (aluminium) and [Johnson1974] (iron). Three wavelengths
/// stand in for the spectrum, so colours are near those of the metals, not theirs to the digit.
inline const std::array<Metal, 5> kMetals{{
    {"gold", {0.156f, 0.424f, 1.38f}, {3.602f, 2.472f, 1.915f}},
    {"silver", {0.0522f, 0.0596f, 0.04f}, {4.409f, 3.597f, 2.648f}},
    {"copper", {0.238f, 1.01f, 1.24f}, {3.626f, 2.582f, 2.393f}},
    {"aluminium", {1.56f, 1.02f, 0.633f}, {7.712f, 6.627f, 5.454f}},
    {"iron", {2.91f, 2.95f, 2.58f}, {3.089f, 2.932f, 2.767f}},
}};

}  // namespace vpm
