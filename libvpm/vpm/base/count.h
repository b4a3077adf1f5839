// Counting in hot loops, all in one place so that its cost can be measured.
#pragma once

namespace vpm {

/// Does this program count?
#ifdef VPM_NO_COUNTERS
inline constexpr bool kCounts = false;
#else
inline constexpr bool kCounts = true;
#endif

/// Adds to a counter that no pass is decided by and that no warning rests on; only the pilot of automatic settings
/// goes by some. A program built with VPM_COUNTERS=OFF counts nothing here, to be timed against one that does.
template <class Counter, class Number = int>
inline void count([[maybe_unused]] Counter& counter, [[maybe_unused]] Number number = 1) {
  if constexpr (kCounts) counter += static_cast<Counter>(number);
}

}  // namespace vpm
