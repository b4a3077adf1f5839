// vpm media: our own density grids.
#include <fmt/format.h>

#include "commands.h"
#include "vpm/input/grid_writer.h"
#include "vpm/medium/procedural.h"

namespace vpm::tools {

int media_command(const MediaOptions& options) {
  if (options.name.empty()) {
    for (const auto& [name, summary, size, value] : procedural_fields())
      fmt::print("{:<10} {:<18} {}\n", name, fmt::format("{:g} x {:g} x {:g} m", size.x, size.y, size.z), summary);
    return 0;
  }
  const std::string output = options.output.empty() ? options.name + ".vdb" : options.output;
  write_media_grid(options.name, options.resolution, output);
  fmt::print("{}\n", output);
  return 0;
}

}  // namespace vpm::tools
