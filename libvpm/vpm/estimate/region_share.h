// The fraction of a kernel that lies in a region.
#pragma once

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

}  // namespace vpm
