// This process: how long it has run, whether it has been asked to end, and what it says and how it ends where a command
// fails.
#pragma once

#include <atomic>
#include <exception>
#include <memory>
#include <string>

#include "vpm/base/clock.h"

namespace vpm::tools {

/// From the first call on, which main() makes: a render's time counts from there.
std::shared_ptr<const Clock> clock_of_process();

/// From now on a first SIGINT, SIGTERM or SIGHUP sets what is returned, so that what is finished can be written; one
/// that comes a few seconds later kills.
const std::atomic<bool>& stop_on_signals();

inline constexpr int kFailed = 1;  // not the input's fault: no memory, a library gave up
inline constexpr int kBadInput = 2;
inline constexpr int kNoPassFits = 3;     // the time asked for is over, and no pass is finished
inline constexpr int kInterrupted = 130;  // as shells report a process ended by SIGINT

struct Failure {
  int status;
  std::string message;
};
Failure failure_of(const std::exception_ptr& thrown);

}  // namespace vpm::tools
