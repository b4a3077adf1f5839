// Ranks of one render: all load the scene by themselves, and make what rank 0 has chosen of it.
#include "rank_run.h"

#include <fmt/format.h>
#include <csignal>
#include <cstdio>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>

#include "exit_status.h"
#include "pass_run.h"
#include "picture_run.h"
#include "vpm/base/error.h"
#include "vpm/ranks/together.h"

namespace vpm::tools {
namespace {

/// Rank 0 alone hears signals, and ends the others.
void leave_signals_to_leader() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) std::signal(number, SIG_IGN);
}

constexpr std::string_view kToRender = "render";

/// What rank 0 tells by tell_render(), once it does.
Identity told_render(Ranks& ranks) {
  const Message message = wait_for_message(ranks);
  std::string_view text = message.bytes;
  const std::optional<Identity> told = take_lines(text, kToRender);
  if (!told) throw std::runtime_error("rank 0 is another program");
  return *told;
}

void check_same(const Identity& led, const Identity& own) {
  if (own == led) return;
  throw InputError("this rank would render something else: its files, its program or its options differ" +
                   differences(led, own, "of rank 0", "here"));
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

void tell_render(Ranks& ranks, const Identity& identity) {
  const std::string text = lines_of(kToRender, identity);
  for (int rank = 1; rank < ranks.size(); ++rank) ranks.send(rank, text);
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
  if (job.automatic.any()) choose_again(job, choices_of(led));
  check_same(led, identity_of(job));
  make_render(ranks, job.scene, job.settings);
  return 0;
}

}  // namespace vpm::tools
