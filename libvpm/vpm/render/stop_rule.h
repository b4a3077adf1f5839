// When a render ends.
#pragma once

namespace vpm {

/// Once `passes` are done; or, where `seconds` or `error` are asked for, once the first of these two is reached.
struct StopRule {
  int passes = 16;       // >= 1; ignored where seconds or error > 0
  int first = 0;         // >= 0; the number of the first pass: those before it are of other pieces of the render
  double seconds = 0.0;  // > 0: wall clock; no pass goes on that would end much later
  double error = 0.0;    // > 0: passes start until the estimated relative MSE is no more than that

  bool counts_passes() const { return seconds == 0.0 && error == 0.0; }
};

}  // namespace vpm
