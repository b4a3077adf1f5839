// What OpenEXR itself says of pictures of the sky, for tests of folders that do not include it.
#pragma once

#include <string>

#include "vpm/base/vec.h"

namespace vpm {

/// Where a direction lies in an equirectangular picture: from 0 to 1, from the left and from the top.
Vec2 place_in_latlong(const Vec3& direction);

/// Writes a white picture of 4 x 24 pixels with the attribute "envmap".
void write_envmap(const std::string& path, bool cube);

}  // namespace vpm
