// How photons are gathered: by radius or by count, with which kernel, and what is done at borders.
#pragma once

#include <cstdint>

#include "vpm/base/counters.h"
#include "vpm/photon/kernel.h"
#include "vpm/photon/photon.h"

namespace vpm {

/// Which photons count: those within a radius, or the nearest few within it.
enum class GatherMode { radius, nearest };

/// What is done where a disc or a ball reaches beyond the places that photons can come to. `none`: nothing, so that
/// estimates are too dark there and light leaks through walls. `corrected`: each disc or ball by itself, by BoundedMap.
/// `ends`, for segments of eye rays in media: by SegmentRegion, or as `corrected`; see
/// GatherRule::corrects_each_ball().
enum class BoundaryRule { none, corrected, ends };

/// A gather radius as a render asks for it: a length, or the default, which choose() derives from where photons lie,
/// and first_radius() from the size of the medium or the scene where nobody has chosen.
class AskedRadius {
 public:
  /// The default.
  constexpr AskedRadius() = default;
  /// So many metres, > 0. 0 stands for the default.
  constexpr AskedRadius(float metres) : metres_(metres) {}
  constexpr bool is_given() const { return metres_ != 0.0f; }
  /// m; 0 where it is not given.
  constexpr float metres() const { return metres_; }
  bool operator==(const AskedRadius&) const = default;

 private:
  float metres_ = 0.0f;
};

/// How photons are gathered. The type of the radius says whether it is asked for or known.
template <class Radius>
struct GatherRule {
  GatherMode mode = GatherMode::radius;
  Radius radius{};      // of the kernel, or the largest allowed (nearest mode)
  uint32_t count = 50;  // nearest mode: k >= 2
  KernelKind kernel = KernelKind::epanechnikov;
  BoundaryRule boundary = BoundaryRule::none;
  uint32_t beam_count = 0;  // around rays; > 0: each photon has its own radius, that of a ball which holds about so
                            // many photons, between a hundredth of `radius` and `radius`; 0: all have `radius`

  /// Does a count of photons decide the radius of a gather, so that `radius` is only the largest allowed?
  bool goes_by_count() const { return mode == GatherMode::nearest || beam_count > 0; }
  /// Is each ball in a medium corrected by itself, and not the segment of the ray as a whole? With radii that go by
  /// count a missing photon makes the next ball larger, so that balls beyond a border cannot make up for those before
  /// it. Discs around a ray are never corrected one by one.
  bool corrects_each_ball() const {
    return mode == GatherMode::nearest ? boundary != BoundaryRule::none : boundary == BoundaryRule::corrected;
  }
};
/// As a render asks for it: the radius is that of the first pass.
using AskedGather = GatherRule<AskedRadius>;
/// As it is in one pass: the radius is in m, > 0.
using GatherSettings = GatherRule<float>;

/// The variance along an axis, m^2, of kernels in `dimension` dimensions; of lines across a ray, along each of the two
/// axes. 0 where kernels have no one variance: where a count decides their radii, and those of order 4.
inline float variance_of(const GatherSettings& gather, int dimension) {
  if (gather.goes_by_count()) return 0.0f;
  const float unit = kernel_variance(gather.kernel, dimension);
  return (dimension == 1 ? 0.5f * unit : unit) * gather.radius * gather.radius;
}

/// What gathering counts.
struct GatherCounters {
  uint64_t searches = 0;      // of maps: usually one per estimate; more at borders and where radii are asked for
  uint64_t visited = 0;       // photons whose distance the searches computed
  uint64_t used = 0;          // photons that count in estimates, with whatever weight
  uint64_t corrected = 0;     // estimates at borders that were divided by a RegionShare below 1
  uint64_t least_shares = 0;  // those divided by kLeastShare because the share was below it
  uint64_t by_count = 0;      // sums over the nearest photons
  uint64_t short_of = 0;      // those that found fewer than GatherRule::count within the largest radius

  static constexpr auto counters() {
    using G = GatherCounters;
    return std::tuple{Counter{"map_searches", &G::searches},
                      Counter{"photons_visited", &G::visited},
                      Counter{"photons_used", &G::used},
                      Counter{"boundary_corrections", &G::corrected},
                      Counter{"boundary_least_shares", &G::least_shares},
                      Counter{"sums_by_count", &G::by_count},
                      Counter{"sums_by_count_of_fewer_photons", &G::short_of}};
  }
  void merge(const GatherCounters& other) { merge_counters(*this, other); }
};
static_assert(lists_every_member<GatherCounters>());

}  // namespace vpm
