// Any bytes as a PNG file.
#include "image/png.h"

#include "fuzz/scratch.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const vpm::ScratchFolder folder;
  const std::string path = folder.put("image.png", data, size);
  vpm::read_or_refuse([&] { vpm::read_png(path, vpm::PngValues::srgb); });
  return 0;
}
