// Gathering at borders: only the photons of a region around the point count, and their sum is divided by the fraction
// of the kernel that lies in the region.
//
// Near edges and walls, photons come to only a part of the disc or ball [Silverman1986, sec. 2.10]. A region says which
// part, by one rule for photons and for places. The sum over the region's photons is divided by the kernel's integral
// over the region's places. Under uniform light the result is right wherever the borders run. All that matters is that
// the numerator and the denominator are of the same region.
#pragma once

#include <algorithm>

#include "vpm/base/counters.h"
#include "vpm/estimate/kernel_sum.h"
#include "vpm/estimate/region_share.h"

namespace vpm {

/// A photon map that is gathered from within a region, for the estimates of this folder. A Region has two functions:
/// share(radius) gives its RegionShare of a kernel of that radius (m); holds(offset) says whether the place at that
/// offset from the point lies in it.
template <class Region>
struct BoundedMap {
  const PhotonMap& map;
  const Region& region;
  GatherWork work;
};
template <class Region>
BoundedMap(const PhotonMap&, const Region&, GatherWork) -> BoundedMap<Region>;

template <class Region>
const GatherSettings& settings_of(const BoundedMap<Region>& bounded) {
  return bounded.map.settings;
}

/// Divides the sum over the part of a kernel that lies in a region by the share of the kernel there. The correction is
/// that of the quotient: what the sum's and the share's corrections make of it.
inline KernelEstimate over_share(const KernelEstimate& sum, const RegionShare& share, GatherCounters& counters) {
  count(counters.corrected);
  if (share.inside < kLeastShare) ++counters.least_shares;
  const auto divisor = static_cast<float>(std::max(share.inside, kLeastShare));
  const Rgb value = sum.value / divisor;
  return {value, (sum.correction - value * static_cast<float>(share.correction)) / divisor};
}

/// The sum within a fixed radius. `accept` selects photons; `within` selects those of them that the region holds.
template <int Dimension, class Region, class Accept, class Within, class Value>
KernelEstimate bounded_sum(const Region& region, const Gathering<RadiusMap>& map, const Vec3& point, Accept&& accept,
                           Within&& within, Value&& value) {
  const RegionShare share = region.share(map.settings.radius);
  if (share.inside == 1.0) return kernel_sum<Dimension>(map, point, accept, value);
  const KernelEstimate sum = share.others ? kernel_sum<Dimension>(map, point, within, value)
                                          : kernel_sum<Dimension>(map, point, accept, value);
  return over_share(sum, share, map.work.counters);
}

/// The sum over the k nearest photons of the region. Without the k-th, they are k - 1 photons spread uniformly over the
/// part of the region in the ball that reaches to the k-th. The estimate is therefore unbiased at borders, too.
template <int Dimension, class Region, class Accept, class Within, class Value>
KernelEstimate bounded_sum(const Region& region, const Gathering<NearestMap>& map, const Vec3& point, Accept&& accept,
                           Within&& within, Value&& value) {
  const Neighbours& all = nearest(map, point, accept);
  const RegionShare share = region.share(std::sqrt(all.limit()));
  if (share.inside == 1.0) return neighbour_sum<Dimension>(map, all, value);
  if (!share.others) return over_share(neighbour_sum<Dimension>(map, all, value), share, map.work.counters);
  const Neighbours& own = nearest(map, point, within);
  const RegionShare of_own = region.share(std::sqrt(own.limit()));
  return over_share(neighbour_sum<Dimension>(map, own, value), of_own, map.work.counters);
}

/// The sum over the region's photons, divided by the region's share of the kernel.
template <int Dimension, class Region, class Accept, class Value>
KernelEstimate kernel_sum(const BoundedMap<Region>& bounded, const Vec3& point, Accept&& accept, Value&& value) {
  if (bounded.map.size() == 0) return {};
  const auto within = [&](const PackedDirection& travel, const Vec3& offset) {
    return accept(travel, offset) && bounded.region.holds(offset);
  };
  const auto sum = [&](const auto& index) {
    const Gathering map{index, bounded.map.settings, bounded.work};
    return bounded_sum<Dimension>(bounded.region, map, point, accept, within, value);
  };
  return std::visit(sum, bounded.map.index);
}

}  // namespace vpm
