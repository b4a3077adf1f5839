// Any bytes as an OpenEXR file: its colours, then all of its channels.
#include "image/exr.h"

#include "fuzz/scratch.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const vpm::ScratchFolder folder;
  const std::string path = folder.put("image.exr", data, size);
  vpm::read_or_refuse([&] { vpm::read_exr(path); });
  vpm::read_or_refuse([&] { vpm::read_exr_channels(path); });
  return 0;
}
