// Ranks of one render: all load the scene by themselves, but for grids, and make what rank 0 has chosen of it.
#include "rank_run.h"

#include <fmt/format.h>
#include <csignal>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <system_error>

#include "exit_status.h"
#include "pass_run.h"
#include "picture_run.h"
#include "vpm/base/error.h"
#include "vpm/input/scene_file.h"
#include "vpm/ranks/machine_grids.h"
#include "vpm/ranks/same_render.h"
#include "vpm/ranks/together.h"

namespace vpm::tools {
namespace {

/// Rank 0 alone hears signals, and ends the others.
void leave_signals_to_leader() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) std::signal(number, SIG_IGN);
}

/// What loads grids for a rank that does not lead its machine: it finds those that are shared. What was clamped, and a
/// picture's report tells, is known to who reads files.
GridLoader loader_of_shared(const GridsOfMedia& grids) {
  return [&grids](const std::string& medium, const GridRequest&) {
    const auto found = grids.find(medium);
    if (found == grids.end()) throw InputError("the rank that reads the grids of this machine has no such medium");
    return LoadedGrid{found->second};
  };
}

/// It can go on without.
void say_not_shared(const Ranks& ranks, const RenderOptions& options, const std::system_error& why) {
  if (options.quiet) return;
  fmt::print(stderr, "note: rank {} shares no grids with others of its machine, and holds its own: {}\n", ranks.rank(),
             why.what());
}

/// Those that the first rank of this machine shares; nothing where there are none to be had.
std::optional<GridsOfMedia> find_grids(const Ranks& ranks, Machine& machine, const RenderOptions& options) {
  try {
    return shared_grids(machine);
  } catch (const std::system_error& why) {
    say_not_shared(ranks, options, why);
    return std::nullopt;
  }
}

}  // namespace

RenderJob load_as_rank(Ranks& ranks, const RenderOptions& options) {
  Machine* const machine = ranks.machine();
  if (machine && !machine->leads()) {
    const std::optional<GridsOfMedia> grids = find_grids(ranks, *machine, options);
    return load_for_render(options, grids ? loader_of_shared(*grids) : GridLoader());
  }
  RenderJob job = load_for_render(options);
  try {
    if (machine) share_grids(*machine, job.scene);
  } catch (const std::system_error& why) {
    say_not_shared(ranks, options, why);
  }
  return job;
}

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

int make_passes_for_leader(Ranks& ranks, const RenderOptions& options) {
  leave_signals_to_leader();
  // What is wrong with the scene, rank 0 tells: this rank only where rank 0 has found nothing.
  RenderJob job;
  std::exception_ptr wrong;
  try {
    job = load_as_rank(ranks, options);
  } catch (...) {
    wrong = std::current_exception();
  }
  const Identity led = told_render(ranks);
  if (wrong) std::rethrow_exception(wrong);
  render_as_told(job, led);
  make_render(ranks, job.scene, job.settings);
  return 0;
}

}  // namespace vpm::tools
