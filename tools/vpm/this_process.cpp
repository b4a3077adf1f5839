// The clock on the wall, signals, and from exceptions to words.
#include "this_process.h"

#include <csignal>
#include <cstdint>
#include <ctime>
#include <new>

#include "vpm/base/cancel.h"
#include "vpm/base/error.h"
#include "vpm/render/render.h"

namespace vpm::tools {
namespace {

std::atomic<bool> stop_requested{false};
std::atomic<int64_t> stop_requested_at{0};  // ms; 0: not yet
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int64_t>::is_always_lock_free);

/// Of a clock that does not go back, ms, > 0; in signal handlers, too.
int64_t now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return int64_t{time.tv_sec} * 1000 + time.tv_nsec / 1'000'000 + 1;
}

/// Those who signal a process and then its group, as `timeout` and some batch systems do, want no more than those who
/// signal once: what comes within two seconds of the first signal is taken for the same.
void request_stop(int number) {
  constexpr int64_t kSameRequest = 2'000;  // ms
  const int64_t at = now();
  int64_t first = 0;
  if (stop_requested_at.compare_exchange_strong(first, at)) {
    stop_requested = true;
  } else if (at - first >= kSameRequest) {
    std::signal(number, SIG_DFL);
    std::raise(number);
  }
}

}  // namespace

std::shared_ptr<const Clock> clock_of_process() {
  static const auto clock = std::make_shared<const WallClock>();
  return clock;
}

const std::atomic<bool>& stop_on_signals() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP})
    if (std::signal(number, request_stop) == SIG_IGN)
      std::signal(number, SIG_IGN);  // as by nohup, to which the terminal's end is no end, and of a shell's background
  return stop_requested;
}

Failure failure_of(const std::exception_ptr& thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const InputError& error) {
    return {kBadInput, error.what()};
  } catch (const Cancelled&) {
    return {kInterrupted, "interrupted"};
  } catch (const NoPassFits& failure) {
    return {kNoPassFits, failure.what()};
  } catch (const std::bad_alloc&) {
    return {kFailed, "out of memory"};
  } catch (const std::exception& error) {
    return {kFailed, error.what()};
  }
}

}  // namespace vpm::tools
