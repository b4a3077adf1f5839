// Any bytes as a .hdr file of Radiance.
#include "vpm/image/hdr.h"

#include <cstdio>
#include <string>

#include "fuzz/scratch.h"

namespace vpm {
namespace {

/// Does a line announce many pixels? Such pictures are right and slow.
bool is_slow(const std::string& bytes) {
  constexpr double kMany = 1 << 16;
  for (size_t at = bytes.find('\n'); at != std::string::npos; at = bytes.find('\n', at + 1)) {
    double lines = 0.0, along = 0.0;
    if (std::sscanf(bytes.c_str() + at, " %*1[+-]%*1[XY] %lf %*1[+-]%*1[XY] %lf", &lines, &along) == 2 &&
        lines * along > kMany)
      return true;
  }
  return false;
}

}  // namespace
}  // namespace vpm

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const vpm::ScratchFolder folder;
  if (vpm::is_slow({reinterpret_cast<const char*>(data), size})) return 0;
  const std::string path = folder.put("picture.hdr", data, size);
  vpm::read_or_refuse([&] { vpm::read_hdr(path); });
  return 0;
}
