// How much of a kernel lies in a region, and how much outside, along a line from the kernel's center.
#pragma once

#include "vpm/photon/kernel.h"

namespace vpm {

/// The part of a kernel that a region covers.
struct RegionShare {
  double inside = 1.0;      // the kernel's integral over the region; exactly 1 where no part of the kernel lies outside
  bool others = false;      // may photons within the kernel's reach lie outside the region?
  double correction = 0.0;  // the integral of the kernel's correction over the region
};

/// Where RegionShare::inside is below this, the sum is divided by this instead: an eighth of the share at the corner of
/// a cube. The estimate stays too dark there, and is counted.
inline constexpr double kLeastShare = 1.0 / 64.0;

/// The fraction of the weight of the kernel, and of its correction, along a line from the point that lies where
/// inside(t) is false, t in m. within(t) is the integral of both up to the distance t. The point itself counts as
/// inside. inside() is tested at three distances. Where two neighbouring tests differ, the place of the change is found
/// to a hundredth of `reach`. If inside() changes and changes back between two of them, that is missed.
template <class Within, class Inside>
KernelPair<double> lost_along(float reach, Within&& within, Inside&& inside) {
  constexpr int kLooks = 3, kBisections = 5;
  KernelPair<double> lost;
  float begin = 0.0f;
  bool is_inside = true;
  for (int look = 1; look <= kLooks; ++look) {
    const float end = reach * (static_cast<float>(look) / kLooks);
    float last = begin, next = end;  // before and after the change, if there is one
    const bool changes = inside(end) != is_inside;
    for (int i = 0; changes && i < kBisections; ++i) {
      const float middle = 0.5f * (last + next);
      (inside(middle) == is_inside ? last : next) = middle;
    }
    const float change = changes ? 0.5f * (last + next) : end;
    lost += is_inside ? within(end) - within(change) : within(change) - within(begin);
    is_inside = is_inside != changes;
    begin = end;
  }
  return lost;
}

}  // namespace vpm
