// Gathering at borders: photons count within a region of which the point knows how much of the kernel lies in it.
//
// Near edges and walls photons come to a part of the disc or ball alone [Silverman1986, sec. 2.10]. A region says which
// part, by a rule that holds for photons as for places; the sum over its photons is divided by the kernel's integral
// over its places. Of even light that is the truth wherever the borders run: that the numerator and the denominator are
// of the same region is all that matters.
#pragma once

#include <algorithm>

#include "vpm/base/count.h"
#include "vpm/estimate/kernel_sum.h"
#include "vpm/estimate/region_share.h"

namespace vpm {

/// A photon map, for the estimates of this folder, that is gathered from within a region. Region: share(radius) gives
/// its RegionShare of a kernel of that radius (m), holds(offset from the point) whether it has that place in it.
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

/// A sum over what a region has of a kernel, over its share.
inline Rgb over_share(const Rgb& sum, const RegionShare& share, GatherCounters& counters) {
  count(counters.corrected);
  if (share.inside < kLeastShare) ++counters.least_shares;
  return sum / static_cast<float>(std::max(share.inside, kLeastShare));
}

/// Of a fixed radius. `within` takes those of the photons that `accept` takes which the region holds.
template <int Dimension, class Region, class Accept, class Within, class Value>
Rgb bounded_sum(const Region& region, const Gathering<RadiusMap>& map, const Vec3& point, Accept&& accept,
                Within&& within, Value&& value) {
  const RegionShare share = region.share(map.settings.radius);
  if (share.inside == 1.0) return kernel_sum<Dimension>(map, point, accept, value);
  const Rgb sum = share.others ? kernel_sum<Dimension>(map, point, within, value)
                               : kernel_sum<Dimension>(map, point, accept, value);
  return over_share(sum, share, map.work.counters);
}

/// Of the k nearest: the region's own are meant. Without the k-th they are k - 1 photons uniform in what the region has
/// of the ball that reaches it, so that the estimate is unbiased there, too.
template <int Dimension, class Region, class Accept, class Within, class Value>
Rgb bounded_sum(const Region& region, const Gathering<NearestMap>& map, const Vec3& point, Accept&& accept,
                Within&& within, Value&& value) {
  const Neighbours& all = nearest(map, point, accept);
  const RegionShare share = region.share(std::sqrt(all.limit()));
  if (share.inside == 1.0) return neighbour_sum<Dimension>(map, all, value);
  if (!share.others) return over_share(neighbour_sum<Dimension>(map, all, value), share, map.work.counters);
  const Neighbours& own = nearest(map, point, within);
  const RegionShare of_own = region.share(std::sqrt(own.limit()));
  return over_share(neighbour_sum<Dimension>(map, own, value), of_own, map.work.counters);
}

/// The sum over the region's photons, over its share.
template <int Dimension, class Region, class Accept, class Value>
Rgb kernel_sum(const BoundedMap<Region>& bounded, const Vec3& point, Accept&& accept, Value&& value) {
  if (bounded.map.size() == 0) return Rgb(0.0f);
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
