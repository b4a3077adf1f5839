// This process: how long it has run, and whether it has been told to end.
#pragma once

#include <atomic>
#include <memory>

#include "vpm/base/clock.h"

namespace vpm::tools {

/// From the first call on, which main() makes: a render's time counts from there.
std::shared_ptr<const Clock> clock_of_process();

/// From now on a first SIGINT, SIGTERM or SIGHUP sets what is returned, so that what is finished can be written; one
/// that comes a few seconds later kills.
const std::atomic<bool>& stop_on_signals();

}  // namespace vpm::tools
