// Numbers that say how far one picture is from another.
#pragma once

#include "image/image.h"

namespace vpm {

/// Luminance of linear sRGB [ITU2015, item 3.2], in the unit of its argument.
inline float luminance(const Rgb& c) { return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b; }

/// The mean of each channel over the pixels.
Rgbd channel_means(const Image& image);

// Both errors below are means over pixels and channels, no luminance involved. They throw InputError where the sizes
// differ, and a non-finite pixel in either picture makes them non-finite.

/// Mean of (I - R)^2.
double mse(const Image& image, const Image& reference);

/// Mean of (I - R)^2 / (R^2 + 0.01 mean(R)^2), mean(R) over the pixels of the same channel: the second term, a tenth of
/// the mean squared, keeps dark pixels from deciding. 0 where I = R, also in a channel that is all black.
double relative_mse(const Image& image, const Image& reference);

}  // namespace vpm
