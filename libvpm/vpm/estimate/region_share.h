// How much of a kernel a region has.
#pragma once

namespace vpm {

/// What a region covers of a kernel.
struct RegionShare {
  double inside = 1.0;  // the kernel's integral over the region; 1 exactly where nothing of the kernel lies outside
  bool others = false;  // may photons lie outside, within the kernel's reach?
};

/// The least share that a sum is divided by: an eighth of what the corner of a cube has. Where less is inside, the
/// estimate stays too dark, and is counted.
inline constexpr double kLeastShare = 1.0 / 64.0;

}  // namespace vpm
