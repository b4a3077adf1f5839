// vpm render: scene file in, picture and report out. Of several processes all load the scene by themselves, but for
// grids, and make what rank 0 has chosen of it.
#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "commands.h"
#include "pass_run.h"
#include "picture_run.h"
#include "this_process.h"
#include "vpm/base/error.h"
#include "vpm/base/parallel.h"
#include "vpm/input/scene_file.h"
#include "vpm/job/render_job.h"
#include "vpm/ranks/machine_grids.h"
#include "vpm/ranks/messages.h"
#include "vpm/ranks/ranks.h"
#include "vpm/ranks/together.h"

namespace vpm::tools {
namespace {

/// Rank 0 alone hears signals, and ends the others.
void leave_signals_to_leader() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) std::signal(number, SIG_IGN);
}

/// The grids of a rank that is not the first of its machine. It waits for the first once it needs one.
class GridsOfFirst {
 public:
  explicit GridsOfFirst(Ranks& machine) : machine_(machine) {}

  /// As GridLoader does. How many values were clamped is not known here: the first rank reports it.
  LoadedGrid load(const GridName& name, const GridRequest& request) {
    wait();
    if (!grids_) return load_grid(request);
    const auto found = grids_->find(name);
    if (found == grids_->end())
      throw InputError(fmt::format("the first rank of this machine reads another scene: without a {} of '{}'",
                                   name.role, name.medium));
    return LoadedGrid{found->second};
  }
  /// Takes what the first sends, also where nothing was loaded.
  void wait() {
    if (heard_) return;
    heard_ = true;
    try {
      grids_ = shared_grids(machine_);
    } catch (const std::system_error& not_there) {
      not_there_ = not_there.what();
    }
  }
  /// Why what the first shares cannot be had; "" where it can, or where it shares nothing, which it sends.
  const std::string& not_there() const { return not_there_; }

 private:
  Ranks& machine_;
  bool heard_ = false;
  std::optional<GridsOfScene> grids_;
  std::string not_there_;
};

struct JobOfRank {
  RenderJob job;
  std::string not_shared{};  // why this rank does not share grids that it should; "" where it does, or has none
};

/// The job of a scene file with these options, by each rank. Of the ranks of one machine the first reads the grids, and
/// the others look them up in the memory where it has put them.
JobOfRank load_as_rank(Ranks& ranks, const RenderOptions& options) {
  Ranks* const machine = ranks.machine();
  if (!machine) return {load_for_render(options)};
  if (machine->leads()) {
    RenderJob job = load_for_render(options);
    const std::error_code refused = share_grids(*machine, job.scene);
    return {std::move(job), refused ? refused.message() : ""};
  }
  GridsOfFirst grids(*machine);
  RenderJob job = load_for_render(
      options, [&](const GridName& name, const GridRequest& request) { return grids.load(name, request); });
  grids.wait();
  return {std::move(job), grids.not_there()};
}

/// Prints that note, if there is anything to say.
void say_not_shared(const Ranks& ranks, const RenderOptions& options, const std::string& why) {
  if (why.empty() || options.quiet) return;
  fmt::print(stderr, "note: rank {} shares no grids with others of its machine, and holds its own: {}\n", ranks.rank(),
             why);
}

/// Calls run(), which is the whole work of a rank. What it throws is printed once, and ends all ranks with the exit
/// status of main(); of one process main() prints it.
int run_as_rank(Ranks& ranks, const std::function<int()>& run) {
  if (ranks.size() == 1) return run();
  try {
    return run();
  } catch (...) {
    const Failure failure = failure_of(std::current_exception());
    const std::string who = ranks.leads() ? "" : fmt::format("rank {}: ", ranks.rank());
    fmt::print(stderr, "vpm: {}{}\n", who, failure.message);
    ranks.abort(failure.status);
    return failure.status;
  }
}

/// Loads the scene, waits for orders of rank 0, and makes passes for it. Throws InputError where this rank's scene or
/// program is another.
int make_passes_for_leader(Ranks& ranks, const RenderOptions& options) {
  leave_signals_to_leader();
  // What is wrong with the scene, rank 0 prints: this rank only where rank 0 has found nothing.
  JobOfRank loaded;
  std::exception_ptr wrong;
  try {
    loaded = load_as_rank(ranks, options);
  } catch (...) {
    wrong = std::current_exception();
  }
  const Identity led = receive_render(ranks);
  if (wrong) std::rethrow_exception(wrong);
  say_not_shared(ranks, options, loaded.not_shared);  // only now: where rank 0 has ended, its memory is gone, too
  adopt_render(loaded.job, led);
  make_render(ranks, loaded.job.scene, loaded.job.settings);
  return 0;
}

}  // namespace

int render_command(const RenderOptions& options) {
  const std::unique_ptr<Ranks> ranks = join_ranks();
  set_threads(options.threads);
  return run_as_rank(*ranks, [&] {
    if (!ranks->leads()) return make_passes_for_leader(*ranks, options);
    const Outputs outputs = output_paths(options.output, std::filesystem::path(options.scene).stem().string());
    JobOfRank loaded = load_as_rank(*ranks, options);
    say_not_shared(*ranks, options, loaded.not_shared);
    return render_picture(options, outputs, std::move(loaded.job), *ranks).status;
  });
}

}  // namespace vpm::tools
