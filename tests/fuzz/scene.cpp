// Any bytes as a scene file. The files that it may name lie beside it.
#include "vpm/input/scene_file.h"

#include <algorithm>
#include <string_view>

#include "fuzz/scratch.h"
#include "vpm/image/exr.h"
#include "vpm/input/grid/grid_writer.h"

namespace vpm {
namespace {

/// The scene's folder, with a file of each kind in it.
struct SceneFolder : ScratchFolder {
  SceneFolder() {
    Image sky(2, 1);
    sky.pixels = {Rgb(1.0f, 2.0f, 3.0f), Rgb(0.5f)};
    write_exr(path("sky.exr"), sky, {}, {});
    write_media_grid("gaussian", 4, path("grid.vdb"));
    std::ofstream(path("mesh.obj")) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    std::ofstream(path("mesh.ply")) << "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                                       "property float z\nelement face 1\nproperty list uchar int vertex_index\n"
                                       "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  }
};

/// May the scene name files of other folders? It may where it holds a slash, or an escape sequence for one.
bool leaves_folder(std::string_view text) {
  const bool slash = text.find('/') != std::string_view::npos;
  const bool escapes = text.find('\\') != std::string_view::npos;
  return slash || (escapes && (text.find("2f") != std::string_view::npos || text.find("2F") != std::string_view::npos));
}

}  // namespace
}  // namespace vpm

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const vpm::SceneFolder folder;
  if (vpm::leaves_folder({reinterpret_cast<const char*>(data), size})) return 0;
  const std::string path = folder.put("scene.toml", data, size);
  vpm::read_or_refuse([&] { vpm::load_scene(path); });
  return 0;
}
