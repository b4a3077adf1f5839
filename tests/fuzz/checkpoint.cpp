// Any bytes between a checkpoint's first lines and its checksum, and as a whole checkpoint.
#include "vpm/job/checkpoint.h"

#include "fuzz/scratch.h"
#include "fuzz/whole_checkpoint.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const vpm::ScratchFolder folder;
  const std::string_view body(reinterpret_cast<const char*>(data), size);
  for (const std::string& bytes : {vpm::whole_checkpoint(body), std::string(body)}) {
    const std::string path =
        folder.put("render.checkpoint", reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
    vpm::read_or_refuse([&] { vpm::read_checkpoint(path, vpm::kFuzzIdentity); });
  }
  return 0;
}
