// The preview that people look at: 8 bits a channel in a PNG file.
#pragma once

#include <cstddef>
#include <filesystem>

#include "image/image.h"

namespace vpm {

/// Writes radiance * 2^exposure, clipped to [0, 1] and with the sRGB transfer curve [IEC1999], to 8 bits. Pixels
/// with a non-finite channel are drawn magenta; returns their number. Equal pictures give equal bytes. The file appears
/// whole or not at all; throws InputError where it cannot be written.
size_t write_png(const std::filesystem::path& path, const Image& radiance, float exposure);

/// The exposure, in stops, that takes the 99th percentile of the luminance of the lit (finite, > 0) pixels to 0.8; 0
/// for a black picture.
float auto_exposure(const Image& radiance);

}  // namespace vpm
