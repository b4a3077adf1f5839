// How far a stage of work is and how long it will take: one line on the terminal, nothing in a pipe.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <utility>

#include "vpm/base/clock.h"

namespace vpm {

/// When progress is shown: automatic = where stderr is a terminal.
enum class ProgressMode { automatic, always, never };

bool progress_enabled(ProgressMode mode);

/// "photons  [#########-----------]  47 %  12 s left": `done` of `total` units of work after `seconds` s. The time left
/// assumes that the rest goes as fast as the part done; it is missing below `least` units, too few to know how fast
/// that is. A total of 0 is unknown: "photons  123456".
std::string progress_line(const std::string& stage, uint64_t done, uint64_t total, double seconds, uint64_t least = 1);

/// Shows the progress of one stage from construction to finish() or destruction. Work is counted in any unit.
class Progress {
 public:
  /// `total` is 0 where it is unknown. The time left is shown from `least` > 0 units on.
  Progress(std::string stage, uint64_t total, bool enabled, uint64_t least = 1);
  ~Progress() { finish(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `n` more units are done. Any thread may call it at any time: no lock, and at most 10 prints a second.
  void advance(uint64_t n = 1) {
    done_.fetch_add(n, std::memory_order_relaxed);
    if (enabled_) show_if_due();
  }
  /// Shows a note after the line from now on. Not to be called while other threads advance.
  void note(std::string text) { note_ = std::move(text); }
  /// Ends the line with what was reached and the time it took. Call after the threads have joined.
  void finish();

  uint64_t done() const { return done_.load(std::memory_order_relaxed); }

 private:
  void show_if_due();
  void show(const std::string& line, const char* end);

  const std::string stage_;
  const uint64_t total_;
  const bool enabled_;
  const uint64_t least_;
  const Stopwatch stopwatch_;
  std::atomic<uint64_t> done_{0};
  std::atomic<double> next_{0.1};                 // s after the start: when the line is due again
  std::atomic_flag printing_ = ATOMIC_FLAG_INIT;  // guards shown_ and the terminal
  std::string note_;
  size_t shown_ = 0;  // characters of the line on the terminal
  bool finished_ = false;
};

}  // namespace vpm
