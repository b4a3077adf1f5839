// Ranks of one render: all load the scene by themselves, and make what rank 0 has chosen of it.
#include "rank_run.h"

#include <fmt/format.h>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>

#include "exit_status.h"
#include "pass_run.h"
#include "picture_run.h"
#include "vpm/ranks/same_render.h"
#include "vpm/ranks/together.h"

namespace vpm::tools {
namespace {

/// Rank 0 alone hears signals, and ends the others.
void leave_signals_to_leader() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) std::signal(number, SIG_IGN);
}

}  // namespace

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
    job = load_for_render(options);
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
