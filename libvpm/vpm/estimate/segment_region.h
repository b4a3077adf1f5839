// Where photons count for a segment of an eye ray that begins or ends at a border of its medium.
//
// A kernel beside the ray sticks out of the medium near the segment's ends, where photons are missing; others lie
// beside the ray's continuation past the ends, in the medium still. Those of one side make up for the other's: the
// estimate is then the mean over rays parallel to this one, which all cross the same border (papers/boundaries.md).
#pragma once

#include <algorithm>

#include "vpm/estimate/eye_segment.h"
#include "vpm/estimate/gather.h"
#include "vpm/photon/kernel.h"
#include "vpm/photon/map/segment_map.h"

namespace vpm {

/// The integral of what the eye sees of an even medium, 1/sigma_t at most: from the start of a segment to distances
/// along it, m, per channel. Past the ends it goes on as if mirrored there.
class SeenAlong {
 public:
  /// `integrals`: of a medium with a grid, and outlives this; null in homogeneous ones.
  SeenAlong(const Rgb& sigma_t, const Interval& interval, const DensityIntegralsAlong* integrals);
  Rgbd to(double t) const;
  const Rgbd& whole() const { return whole_; }

 private:
  Rgbd within(double t) const;

  Rgbd sigma_t_;  // 1/m
  double t0_, t1_;
  const DensityIntegralsAlong* integrals_;
  Rgbd whole_;
};

/// The place of a segment from t0 to t1 that stands for the distance t: itself, or where it is mirrored at an end.
struct Mirrored {
  float t0, t1;  // m

  float operator()(float t) const {
    const float past_start = std::max(t, 2.0f * t0 - t);
    return std::max(t0, std::min(past_start, 2.0f * t1 - past_start));
  }
};

/// What photons are spread over: discs across the ray; balls whose projections are such discs, as each photon has its
/// own transmittance; balls about points of the ray, with the transmittance of the point; or, of photon beams, lines
/// across the ray, or discs across the beams, which have all directions, with the transmittances of their own middles.
enum class Spread { discs, balls_as_discs, balls, lines, turned_discs };

/// The region of a segment: the places of its medium in the tube around the ray, on the near side of the planes that
/// touch the borders at both its ends and of flat walls beside it.
class SegmentRegion {
 public:
  /// The segment is in a medium. Under BoundaryRule::none the region is the whole tube between the segment's ends.
  SegmentRegion(const EyeSegment& segment, const GatherSettings& gather, Spread spread);

  /// Where, along the ray, photons of the region project to or (`balls`) balls that reach into it have their centers,
  /// m.
  const Interval& reach() const { return reach_; }
  /// The half spaces in which photons count, from the ray's origin.
  const HalfSpaces& within() const { return within_; }
  /// How far light of a place in the region passes to the eye: as it would along the line through the place, parallel
  /// to the ray, from the plane that the segment begins at. So a slab is seen alike along all those lines. Those of the
  /// projections where there is no such plane, or one so slanted that it leaves the tube beyond the mirrored segment.
  PlaneDistances distances() const;
  /// The place of the segment that stands for a distance.
  Mirrored mirrored() const { return {segment_.interval.t0, segment_.interval.t1}; }
  /// Is the share 1?
  bool whole() const { return whole_; }
  /// The light that kernels of a radius up to that of the region find, over that of the segment, where light is even.
  /// Its correction is -(r/2) d/dr of it, as that of light is: of the share as it is found, whose own error changes
  /// with the radius, too. Some shares, drawn at random, stand for the corrections of all. The draws are aside of those
  /// of `rng`, and take nothing from it: only segments that have found light ask for their shares, and what else a path
  /// draws must not depend on that.
  KernelEstimate share(float radius, const SeenAlong& seen, const Rng& rng) const;

 private:
  /// What a place lies in.
  struct Inside {
    MediumId medium;
    int solid = -1;  // the number of the opaque shape about it, if there is one
  };

  float reach_past(const Vec3& normal) const;
  bool is_plain();
  void add_wall(const Hit& wall, const Vec3& direction);
  bool stands_beside(const Vec3& normal, const Vec3& position) const;
  std::optional<Hit> first_met(const Ray& line, const Interval& part) const;
  Interval part_of(const Ray& line, float slack) const;
  Rgbd seen_of_line(const Vec3& aside, float ahead, float radius, const SeenAlong& seen) const;
  Rgb share_by_lines(float radius, const SeenAlong& seen, float turn) const;
  template <class Visit>
  bool walk(Ray ray, float length, Inside& in, Visit&& visit) const;

  const EyeSegment& segment_;
  KernelKind kernel_;
  Spread spread_;
  float radius_;       // m
  Interval reach_;     // m
  float anchor_;       // m: of the place on the ray from which lines are found
  float thickness_;    // of what photons are spread over, along the ray, relative to that of a ball
  HalfSpaces within_;  // from the ray's origin
  bool near_ = false;  // does a shape come within the radius of the anchor?
  bool whole_ = true;
  bool by_plane_ = false;  // are distances() those from the plane at the start?
};

/// Divides the light of a segment by its share. The correction is that of the quotient.
KernelEstimate over_share(const KernelEstimate& light, const KernelEstimate& share, GatherCounters& counters);

}  // namespace vpm
