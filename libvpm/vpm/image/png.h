// PNG files of 8 bits a channel: the preview that people look at, and pictures as textures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "vpm/image/image.h"

namespace vpm {

/// Writes radiance * 2^exposure, clipped to [0, 1] and with the sRGB transfer curve [IEC1999], to 8 bits. Pixels
/// with a non-finite channel are drawn magenta; returns their number. Equal pictures give equal bytes. The file appears
/// whole or not at all; throws InputError where it cannot be written.
size_t write_png(const std::filesystem::path& path, const Image& radiance, float exposure);

/// The bytes of a PNG file of these, three for each pixel, by the sRGB curve, row by row from the top.
std::vector<uint8_t> png_of(int width, int height, const std::vector<uint8_t>& rgb);

/// What the bytes of a PNG file stand for: the sRGB curve [IEC1999] of linear values, or these themselves, over 255.
enum class PngValues { srgb, linear };

/// Reads a PNG file, grey or of colours, into linear values in [0, 1]. Where the file names a transfer curve other than
/// sRGB's, libpng converts its bytes to that first. Throws InputError where the file is missing, damaged, over 1 GiB in
/// memory, of 16 bits a channel, or transparent anywhere.
Image read_png(const std::filesystem::path& path, PngValues values);

/// The exposure, in stops, that takes the 99th percentile of the luminance of the lit (finite, > 0) pixels to 0.8; 0
/// for a black picture.
float auto_exposure(const Image& radiance);

}  // namespace vpm
