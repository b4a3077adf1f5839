// How far a stage of work is: the text and the terminal.
#include "vpm/base/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace vpm {
namespace {

constexpr double kPeriod = 0.1;  // s between two prints
constexpr int kBar = 20;         // characters of a full bar

/// "12 s", "3 min 20 s", "2 h 5 min".
std::string duration_text(double seconds) {
  const auto s = static_cast<uint64_t>(std::llround(std::min(std::max(seconds, 0.0), 3.6e9)));  // up to a million hours
  if (s < 60) return std::to_string(s) + " s";
  if (s < 3600) return std::to_string(s / 60) + " min " + std::to_string(s % 60) + " s";
  return std::to_string(s / 3600) + " h " + std::to_string(s / 60 % 60) + " min";
}

double fraction_done(uint64_t done, uint64_t total) {
  return done >= total ? 1.0 : static_cast<double>(done) / static_cast<double>(total);
}

/// "photons  [#########-----------]  47 %"; of an unknown total "photons  123456".
std::string bar_text(const std::string& stage, uint64_t done, uint64_t total) {
  if (total == 0) return stage + "  " + std::to_string(done);
  const double fraction = fraction_done(done, total);
  const int filled = static_cast<int>(kBar * fraction);
  const std::string percent = std::to_string(static_cast<int>(100 * fraction));
  return stage + "  [" + std::string(filled, '#') + std::string(kBar - filled, '-') + "] " +
         std::string(3 - percent.size(), ' ') + percent + " %";
}

}  // namespace

bool progress_enabled(ProgressMode mode) {
  return mode == ProgressMode::always || (mode == ProgressMode::automatic && isatty(STDERR_FILENO) == 1);
}

std::string progress_line(const std::string& stage, uint64_t done, uint64_t total, double seconds, uint64_t least) {
  const std::string bar = bar_text(stage, done, total);
  if (done < least || total == 0) return bar;
  const double fraction = fraction_done(done, total);
  return bar + "  " + duration_text(seconds * (1.0 - fraction) / fraction) + " left";
}

Progress::Progress(std::string stage, uint64_t total, bool enabled, uint64_t least)
    : stage_(std::move(stage)), total_(total), enabled_(enabled), least_(least) {
  if (enabled_) show(progress_line(stage_, 0, total_, 0.0, least_), "");
}

void Progress::show_if_due() {
  const double now = stopwatch_.seconds();
  if (now < next_.load(std::memory_order_relaxed)) return;
  if (printing_.test_and_set(std::memory_order_acquire)) return;  // another thread is at it
  if (now >= next_.load(std::memory_order_relaxed)) {
    next_.store(now + kPeriod, std::memory_order_relaxed);
    show(progress_line(stage_, done(), total_, now, least_), "");
  }
  printing_.clear(std::memory_order_release);
}

void Progress::finish() {
  if (!enabled_ || finished_) return;
  finished_ = true;
  show(bar_text(stage_, done(), total_) + "  in " + duration_text(stopwatch_.seconds()), "\n");
}

void Progress::show(const std::string& line, const char* end) {
  const std::string whole = note_.empty() ? line : line + "  " + note_;
  const std::string blanks(shown_ > whole.size() ? shown_ - whole.size() : 0, ' ');  // wipe the rest of a longer line
  shown_ = whole.size();
  std::fputs(("\r" + whole + blanks + end).c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace vpm
