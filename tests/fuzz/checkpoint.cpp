// Any bytes between a checkpoint's first lines and its checksum, and as a whole checkpoint.
#include "input/checkpoint.h"

#include <string_view>

#include "base/fnv.h"
#include "fuzz/scratch.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const vpm::ScratchFolder folder;
  std::string whole("vpm checkpoint of a render\nfuzz\n");
  whole.append(reinterpret_cast<const char*>(data), size);
  vpm::Fnv1a hash;
  hash.add(std::string_view(whole));
  whole += hash.digits();
  for (const std::string_view bytes : {std::string_view(whole), {reinterpret_cast<const char*>(data), size}}) {
    const std::string path =
        folder.put("render.checkpoint", reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
    vpm::read_or_refuse([&] { vpm::read_checkpoint(path, "fuzz"); });
  }
  return 0;
}
