// vpm render: scene file in, picture and report out.
#include <filesystem>

#include "commands.h"
#include "picture_run.h"
#include "vpm/base/parallel.h"
#include "vpm/input/scene_file.h"

namespace vpm::tools {

int render_command(const RenderOptions& options) {
  set_threads(options.threads);
  const Outputs outputs = output_paths(options.output, std::filesystem::path(options.scene).stem().string());
  const LeftOut left_out = options.automatic ? LeftOut::automatic : LeftOut::usual;
  return render_picture(options, outputs, load_scene(options.scene, overrides_of(options), left_out));
}

}  // namespace vpm::tools
