// vpm mesh: our own triangle meshes.
#include <fmt/format.h>

#include "commands.h"
#include "vpm/input/mesh_writer.h"
#include "vpm/surface/procedural_mesh.h"

namespace vpm::tools {

int mesh_command(const MeshOptions& options) {
  if (options.name.empty()) {
    for (const ProceduralMesh& mesh : procedural_meshes()) fmt::print("{:<10} {}\n", mesh.name, mesh.summary);
    return 0;
  }
  const std::string output = options.output.empty() ? options.name + ".ply" : options.output;
  write_procedural_mesh(options.name, options.resolution, output);
  fmt::print("{}\n", output);
  return 0;
}

}  // namespace vpm::tools
