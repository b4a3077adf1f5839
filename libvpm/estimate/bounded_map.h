// Gathering at borders: photons count within a region of which the point knows how much of the kernel lies in it.
//
// Near edges and walls photons come to a part of the disc or ball alone [Silverman1986, sec. 2.10]. A region says which
// part, by a rule that holds for photons as for places; the sum over its photons is divided by the kernel's integral
// over its places. Of even light that is the truth wherever the borders run: that the numerator and the denominator are
// of the same region is all that matters.
#pragma once

#include <algorithm>

#include "estimate/kernel_sum.h"
#include "estimate/region_share.h"

namespace vpm {

/// A photon map, for the estimates of this folder, that is gathered from within a region. Region: share(radius) gives
/// its RegionShare of a kernel of that radius (m), holds(offset from the point) whether it has that place in it.
template <class Region>
struct BoundedMap {
  const PhotonMap& map;
  const Region& region;
  RegionCounters& counters;
};
template <class Region>
BoundedMap(const PhotonMap&, const Region&, RegionCounters&) -> BoundedMap<Region>;

template <class Region>
const GatherSettings& settings_of(const BoundedMap<Region>& bounded) {
  return bounded.map.settings;
}

/// The sum over the region's photons, over its share. Of the k nearest the region's own are meant: without the k-th
/// they are k - 1 photons uniform in what the region has of the ball that reaches it, so that the estimate is unbiased
/// there, too.
template <int Dimension, class Region, class Accept, class Value>
Rgb kernel_sum(const BoundedMap<Region>& bounded, const Vec3& point, Accept&& accept, Value&& value) {
  const auto& [map, region, counters] = bounded;
  if (map.size() == 0) return Rgb(0.0f);
  RegionShare share = region.share(kernel_radius(map, point, accept));
  if (share.inside == 1.0) return kernel_sum<Dimension>(map, point, accept, value);
  Rgb sum;
  if (share.others) {
    const auto within = [&region = region, &accept](const Vec3& travel, const Vec3& offset) {
      return accept(travel, offset) && region.holds(offset);
    };
    if (map.settings.mode == GatherMode::nearest) share = region.share(kernel_radius(map, point, within));
    sum = kernel_sum<Dimension>(map, point, within, value);
  } else {
    sum = kernel_sum<Dimension>(map, point, accept, value);
  }
  ++counters.corrected;
  if (share.inside < kLeastShare) ++counters.least;
  return sum / static_cast<float>(std::max(share.inside, kLeastShare));
}

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
