// When rays see the same.
#include "vpm/estimate/shared_gather.h"

#include <algorithm>
#include <cmath>

namespace vpm {
namespace {

constexpr float kPartOfPeak = 0.05f;
constexpr float kLengths = 0.05f;  // by which alike segments may differ, of their length
constexpr float kCosine = 0.95f;   // between the normals at their ends, at the least

template <class P>
bool is_smooth(const P& phase, float variance) {
  if constexpr (std::is_same_v<P, Tabulated>)
    return false;
  else if constexpr (requires { phase.first; })  // two, of which the one may be all of a narrow peak
    return is_smooth(phase.a, variance) && is_smooth(phase.b, variance);
  else
    return variance * kPi * std::max(phase.value(1.0f), phase.value(-1.0f)) <= kPartOfPeak * kPartOfPeak;
}

}  // namespace

bool is_smooth_over(const Phase& phase, float variance) {
  return std::visit([&](const auto& p) { return is_smooth(p, variance); }, phase);
}

bool is_alike(const SeenSegment& a, const SeenSegment& b) {
  if (a.medium != b.medium || a.shape != b.shape) return false;
  if (a.shape < 0) return true;
  return std::abs(a.length - b.length) <= kLengths * std::max(a.length, b.length) && glm::dot(a.end, b.end) >= kCosine;
}

}  // namespace vpm
