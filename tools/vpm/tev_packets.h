// The packets that the viewer tev takes over TCP [Mueller2025, Ipc.h, Ipc.cpp]: a length in bytes, which counts itself,
// an operation, and its fields. Numbers are little-endian, texts end with a 0.
#pragma once

#include <string>

#include "vpm/image/image.h"

namespace vpm::tools {

/// Makes a black image with the channels R, G and B, shown at once; it replaces one of that name.
std::string tev_create_image(const std::string& name, int width, int height);

/// Gives `rows` > 0 rows of the picture, from row `first` on, to the image of that name, which is as wide. A packet
/// must be smaller than 4 GiB.
std::string tev_update_rows(const std::string& name, const Image& picture, int first, int rows);

}  // namespace vpm::tools
