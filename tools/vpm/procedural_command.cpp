// vpm media and vpm mesh: our own density grids and triangle meshes.
#include <fmt/format.h>

#include "commands.h"
#include "vpm/input/grid/grid_writer.h"
#include "vpm/input/mesh/mesh_writer.h"
#include "vpm/medium/grid/procedural.h"
#include "vpm/surface/procedural_mesh.h"

namespace vpm::tools {

int media_command(const MediaOptions& options) {
  if (options.name.empty()) {
    for (const auto& [name, summary, size, value, grid] : procedural_fields())
      if (grid == "density")
        fmt::print("{:<10} {:<18} {}\n", name, fmt::format("{:g} x {:g} x {:g} m", size.x, size.y, size.z), summary);
    return 0;
  }
  const std::string output = options.output.empty() ? options.name + ".vdb" : options.output;
  write_media_grid(options.name, options.resolution, output);
  fmt::print("{}\n", output);
  return 0;
}

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
