// A flag that an alarm sets, and a thread that waits for its time.
#include "vpm/base/clock.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <limits>
#include <mutex>
#include <thread>
#include <utility>

#include "vpm/base/cancel.h"

namespace vpm {

bool Clock::finish_by(double end, const std::function<void()>& work, const std::function<double()>& later) const {
  if (std::isinf(end)) {
    work();
    return true;
  }
  std::atomic<bool> late{false};
  const auto ring = [&] {
    const double new_end = later ? later() : 0.0;
    if (new_end > seconds()) return new_end;
    late = true;
    return std::numeric_limits<double>::infinity();
  };
  const std::unique_ptr<Alarm> alarm_at_end = alarm(end, ring);
  try {
    const CancelScope scope(late);
    work();
  } catch (const Cancelled&) {
    if (is_cancelled()) throw;
    return false;
  }
  return true;
}

double WallClock::seconds() const { return stopwatch_.seconds(); }

std::unique_ptr<Clock::Alarm> WallClock::alarm(double at, std::function<double()> ring) const {
  class Waiting final : public Alarm {
   public:
    Waiting(const WallClock& clock, double at, std::function<double()> ring)
        : thread_([this, &clock, at, ring = std::move(ring)](const std::stop_token& over) {
            for (double next = at; wait(clock, next, over);) next = ring();
          }) {}

   private:
    /// Has that time come before the alarm was over?
    bool wait(const WallClock& clock, double until, const std::stop_token& over) {
      constexpr double kLongest = 1e6;  // s at a time, as clocks of the system do not take any number
      std::unique_lock lock(mutex_);
      for (double left = until - clock.seconds(); left > 0.0; left = until - clock.seconds()) {
        changed_.wait_for(lock, over, std::chrono::duration<double>(std::min(left, kLongest)), [] { return false; });
        if (over.stop_requested()) return false;
      }
      return true;
    }

    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::jthread thread_;  // last: it uses the rest
  };
  return std::make_unique<Waiting>(*this, at, std::move(ring));
}

}  // namespace vpm
