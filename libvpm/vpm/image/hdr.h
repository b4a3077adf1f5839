// Pictures of Radiance (.hdr, .pic): the format of most photographed skies.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vpm/image/image.h"

namespace vpm {

struct HdrPicture {
  Image image;                     // of Rec. 709 primaries
  std::vector<std::string> notes;  // what was done to it, for people
};

/// Reads a picture of shared exponents [Ward1991], flat or packed in either way, its pixels in any of the eight orders.
/// What the header says of EXPOSURE and COLORCORR is divided out, so that values are those before them; colours of
/// other PRIMARIES become those of Rec. 709; a GAMMA is noted alone. Throws InputError where the file is missing,
/// damaged, in X, Y, Z, or over 1 GiB in memory.
HdrPicture read_hdr(const std::filesystem::path& path);

}  // namespace vpm
