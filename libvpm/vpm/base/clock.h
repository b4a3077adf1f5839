// The time of a run, and work that must end by then.
#pragma once

#include <chrono>
#include <functional>
#include <memory>

namespace vpm {

/// How long something takes, in wall-clock time.
class Stopwatch {
 public:
  /// Since it was made.
  double seconds() const { return std::chrono::duration<double>(Steady::now() - start_).count(); }

 private:
  using Steady = std::chrono::steady_clock;

  Steady::time_point start_ = Steady::now();
};

/// Measures how long a run has taken, and gives up what takes too long. Tests put one in its place that is given what
/// work costs.
class Clock {
 public:
  virtual ~Clock() = default;

  /// s since the run began.
  virtual double seconds() const = 0;

  /// Does `work`, and gives it up (base/cancel.h) once seconds() has reached `end`. Then `later` is asked first, on
  /// another thread, for a new end: an earlier one, or none, gives up. Was the work finished? Throws what it throws,
  /// and Cancelled where that is for another reason.
  bool finish_by(double end, const std::function<void()>& work, const std::function<double()>& later = {}) const;

 protected:
  /// Until it is destroyed, calls `ring` once seconds() has reached `at`, and again at each time that this returns.
  struct Alarm {
    virtual ~Alarm() = default;
  };
  virtual std::unique_ptr<Alarm> alarm(double at, std::function<double()> ring) const = 0;
};

/// The clock on the wall, from its construction on.
class WallClock final : public Clock {
 public:
  double seconds() const override;

 protected:
  std::unique_ptr<Alarm> alarm(double at, std::function<double()> ring) const override;

 private:
  const Stopwatch stopwatch_{};
};

}  // namespace vpm
