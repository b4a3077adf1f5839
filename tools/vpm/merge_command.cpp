// vpm merge: pieces of a render become the picture of one run.
#include <fmt/format.h>
#include <filesystem>
#include <optional>

#include "commands.h"
#include "picture_run.h"
#include "vpm/base/cancel.h"
#include "vpm/base/error.h"
#include "vpm/base/parallel.h"
#include "vpm/input/scene_file.h"
#include "vpm/job/checkpoint.h"
#include "vpm/job/messages.h"
#include "vpm/job/pieces.h"

namespace vpm::tools {
namespace {

/// What pieces have become so far, and the first of them, which says what they are of.
struct Merged {
  std::string first;  // its path
  Checkpoint whole;
};

/// The job that a piece was rendered of, read again: with the choices that were made then.
RenderJob job_of(const Merged& merged, const std::string& scene) {
  const Origin& origin = merged.whole.origin;
  const std::string path = scene.empty() ? origin.scene : scene;
  if (path.empty()) throw InputError(fmt::format("cannot merge '{}': its scene was made in code", merged.first));
  if (!std::filesystem::exists(path))
    throw InputError(
        fmt::format("cannot merge '{}': its scene '{}' is not there; name it with --scene", merged.first, path));
  RenderJob job = load_scene(path, origin.overrides, origin.automatic ? LeftOut::automatic : LeftOut::defaults);
  job.settings.seed = origin.seed;
  if (job.automatic.any()) choose_again(job, choices_of(merged.whole.identity));
  if (const Identity now = identity_of(job); now != merged.whole.identity)
    throw InputError(fmt::format("cannot merge '{}': its scene or this program is another now{}", merged.first,
                                 differences(merged.whole.identity, now, "in the checkpoint", "now")));
  return job;
}

void add(Merged& merged, const std::string& path) {
  const Checkpoint piece = read_checkpoint(path);
  const auto refuse = [&](const std::string& why) {
    throw InputError(fmt::format("cannot merge '{}' with '{}': {}", path, merged.first, why));
  };
  if (piece.identity != merged.whole.identity)
    refuse("they are of two renders; all pieces must be of one scene, with the same options, by one program" +
           differences(merged.whole.identity, piece.identity, fmt::format("in '{}'", merged.first),
                       fmt::format("in '{}'", path)));
  const PassSet passes = merged.whole.result.film.sums().passes;
  try {
    add_piece(merged.whole.result, piece.result);
  } catch (const InputError& error) {
    refuse(fmt::format("{} (so far passes {} are merged)", error.what(), passes_text(passes)));
  }
}

Merged merge(const std::vector<std::string>& paths) {
  Merged merged{paths.front(), read_checkpoint(paths.front())};
  for (size_t i = 1; i < paths.size(); ++i) add(merged, paths[i]);
  if (const PassSet missing = missing_passes(merged.whole.result.film.sums().passes); missing.count() > 0)
    throw InputError(
        fmt::format("cannot merge: passes {} are missing, and those of one run have no gap", passes_text(missing)));
  return merged;
}

}  // namespace

int merge_command(const MergeOptions& options) {
  set_threads(options.threads);
  const Outputs outputs = output_paths(options.output, "merged");
  Merged merged = merge(options.pieces);
  RenderResult& result = merged.whole.result;
  const RenderJob job = job_of(merged, options.scene);
  const Film& film = result.film;
  check_outputs(outputs, static_cast<uint64_t>(film.width()) * film.height(), options.checkpoint, job);
  const std::unique_ptr<FileLock> lock =
      options.checkpoint ? lock_checkpoint(outputs.checkpoint, options.overwrite) : nullptr;
  result.errors = errors_of(result);
  print_warnings(warnings_of(job, result));
  const CancelledWith nothing(nullptr);  // all files are written, or none
  write_outputs(outputs, options.exposure, job, result);
  if (options.checkpoint) write_checkpoint(outputs.checkpoint, merged.whole.identity, merged.whole.origin, result);
  print_summary(outputs, job, result);
  return 0;
}

}  // namespace vpm::tools
