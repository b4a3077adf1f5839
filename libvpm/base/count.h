// Counting in hot loops, all in one place so that its cost can be measured.
#pragma once

namespace vpm {

/// Adds to a counter that nothing is decided by and that no warning rests on. A program built with VPM_COUNTERS=OFF
/// counts nothing here, to be timed against one that does.
template <class Counter, class Number = int>
inline void count([[maybe_unused]] Counter& counter, [[maybe_unused]] Number number = 1) {
#ifndef VPM_NO_COUNTERS
  counter += static_cast<Counter>(number);
#endif
}

}  // namespace vpm
