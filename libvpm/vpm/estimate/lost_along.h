// How much of a kernel lies outside along a line from its middle.
#pragma once

namespace vpm {

/// Looks along a line from the point: how much of the kernel's weight there lies where not inside(t), t in m. `within`
/// is the kernel's integral up to t over its radius. The point itself counts as inside. What changes and changes back
/// between two looks is missed; what changes is found to a hundredth of `reach`.
template <class Within, class Inside>
double lost_along(float reach, Within&& within, Inside&& inside) {
  constexpr int kLooks = 3, kBisections = 5;
  double lost = 0.0;
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
