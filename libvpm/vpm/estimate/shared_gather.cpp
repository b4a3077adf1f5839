// When rays see the same.
#include "vpm/estimate/shared_gather.h"

#include <algorithm>
#include <cmath>

namespace vpm {
namespace {

constexpr float kPartOfPeak = 0.05f;
constexpr float kLengths = 0.05f;  // by which alike segments may differ, of their length
constexpr float kCosine = 0.95f;   // between the normals at their ends, at the least

}  // namespace

bool is_smooth_over(const Phase& phase, float variance) {
  return std::visit(
      [&]<class P>(const P& p) {
        if constexpr (std::is_same_v<P, Tabulated>) return false;
        const float peak = std::max(p.value(1.0f), p.value(-1.0f));  // 1/sr
        return variance <= kPartOfPeak * kPartOfPeak / (kPi * peak);
      },
      phase);
}

bool is_alike(const SeenSegment& a, const SeenSegment& b) {
  if (a.medium != b.medium || a.shape != b.shape) return false;
  if (a.shape < 0) return true;
  return std::abs(a.length - b.length) <= kLengths * std::max(a.length, b.length) && glm::dot(a.end, b.end) >= kCosine;
}

}  // namespace vpm
