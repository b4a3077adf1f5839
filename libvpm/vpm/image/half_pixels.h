// A picture at half the size: its channels as half floats, 11 significant bits each.
#pragma once

#include <cstdint>
#include <vector>

#include "vpm/image/image.h"

namespace vpm {

struct HalfPixels {
  int exponent = 0;            // a value is its half times 2^exponent
  std::vector<uint16_t> bits;  // of the halves [IEEE2019, sec. 3.4, binary16]: three to a pixel, rows from the top
};

/// Rounds to the nearest half. The exponent takes the largest finite value near the top of what halves can be: from
/// there on down, over eight decades, the error is 2^-11 of a value at most. What is not finite stays what it is.
HalfPixels to_half(const Image& image);

}  // namespace vpm
