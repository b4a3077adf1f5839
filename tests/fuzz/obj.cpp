// Any bytes as a .obj file.
#include "fuzz/scratch.h"
#include "vpm/input/mesh/mesh_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const vpm::ScratchFolder folder;
  const std::string path = folder.put("mesh.obj", data, size);
  vpm::read_or_refuse([&] { vpm::load_mesh(path); });
  return 0;
}
