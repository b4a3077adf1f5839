// By ImfEnvmap.
#include "image/openexr_envmaps.h"

#include <ImfEnvmap.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>

#include <vector>

namespace vpm {

Vec2 place_in_latlong(const Vec3& direction) {
  const Imath::V2f angles = Imf::LatLongMap::latLong(Imath::V3f(direction.x, direction.y, direction.z));
  return {0.5f - angles.y / (2.0f * kPi), 0.5f - angles.x / kPi};  // of longitude and latitude
}

void write_envmap(const std::string& path, bool cube) {
  Imf::Header header(4, 24);
  Imf::addEnvmap(header, cube ? Imf::ENVMAP_CUBE : Imf::ENVMAP_LATLONG);
  Imf::RgbaOutputFile file(path.c_str(), header);
  const std::vector<Imf::Rgba> pixels(96, Imf::Rgba(1.0f, 1.0f, 1.0f));
  file.setFrameBuffer(pixels.data(), 1, 4);
  file.writePixels(24);
}

}  // namespace vpm
