// One exponent for a picture, then Imath's rounding.
#include "vpm/image/half_pixels.h"

#include <Imath/half.h>

#include <algorithm>
#include <cmath>

namespace vpm {
namespace {

float largest_finite(const Image& image) {
  float largest = 0.0f;
  for (const Rgb& pixel : image.pixels)
    for (int c = 0; c < 3; ++c)
      if (std::isfinite(pixel[c])) largest = std::max(largest, std::abs(pixel[c]));
  return largest;
}

}  // namespace

HalfPixels to_half(const Image& image) {
  constexpr int kTop = 15;  // of halves: below 2^15, whatever the rounding, there is no overflow
  HalfPixels result;
  int over = 0;  // the largest value is below 2^over
  if (const float largest = largest_finite(image); largest > 0.0f) {
    std::frexp(largest, &over);
    result.exponent = over - kTop;
  }
  result.bits.reserve(3 * image.pixels.size());
  for (const Rgb& pixel : image.pixels)
    for (int c = 0; c < 3; ++c) result.bits.push_back(Imath::half(std::ldexp(pixel[c], -result.exponent)).bits());
  return result;
}

}  // namespace vpm
