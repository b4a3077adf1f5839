// Any bytes as an OpenEXR file: its colours, then all of its channels.
#include "vpm/image/exr.h"

#include <cstring>
#include <string_view>

#include "fuzz/scratch.h"

namespace vpm {
namespace {

/// Does the header announce a window of many pixels, though not too many to be read? Such files are right and slow.
bool is_slow(std::string_view bytes) {
  constexpr std::string_view kBox("box2i\0\x10\0\0\0", 10);
  constexpr double kMany = 1 << 16, kTooMany = 1 << 27;
  for (size_t at = bytes.find(kBox); at != std::string_view::npos; at = bytes.find(kBox, at + 1)) {
    int32_t corners[4];
    if (bytes.size() < at + kBox.size() + sizeof corners) return false;
    std::memcpy(corners, bytes.data() + at + kBox.size(), sizeof corners);
    const double pixels = (double{1} + corners[2] - corners[0]) * (double{1} + corners[3] - corners[1]);
    if (pixels > kMany && pixels <= kTooMany) return true;
  }
  return false;
}

}  // namespace
}  // namespace vpm

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const vpm::ScratchFolder folder;
  if (vpm::is_slow({reinterpret_cast<const char*>(data), size})) return 0;
  const std::string path = folder.put("image.exr", data, size);
  vpm::read_or_refuse([&] { vpm::read_exr(path); });
  vpm::read_or_refuse([&] { vpm::read_exr_channels(path); });
  return 0;
}
