// vpm render: scene file in, picture and report out.
#include <filesystem>
#include <utility>

#include "commands.h"
#include "picture_run.h"
#include "rank_run.h"
#include "vpm/base/parallel.h"

namespace vpm::tools {

int render_command(const RenderOptions& options) {
  const std::unique_ptr<Ranks> ranks = join_ranks();
  set_threads(options.threads);
  return run_as_rank(*ranks, [&] {
    if (!ranks->leads()) return make_passes_for_leader(*ranks, options);
    const Outputs outputs = output_paths(options.output, std::filesystem::path(options.scene).stem().string());
    JobOfRank loaded = load_as_rank(*ranks, options);
    say_not_shared(*ranks, options, loaded.not_shared);
    return render_picture(options, outputs, std::move(loaded.job), *ranks);
  });
}

}  // namespace vpm::tools
