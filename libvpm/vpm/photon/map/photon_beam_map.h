// The photon beams of a medium, searched along rays and around points: which of them does a ray pass closely, and
// where? Beams are cut into pieces, since a box around a long beam is mostly empty; the pieces lie in leaves of a
// hierarchy of boxes. Each beam is met once, wherever its pieces lie, as the place nearest to the ray or point is in
// one of them.
#pragma once

#include <cstdint>
#include <vector>

#include "vpm/base/cancel.h"
#include "vpm/base/counters.h"
#include "vpm/base/floats.h"
#include "vpm/photon/map/box_tree.h"
#include "vpm/photon/photon_beam.h"

namespace vpm {

/// Places on up to N beams.
template <size_t N>
struct PlacesOnBeams {
  static constexpr size_t kMost = N;

  size_t size = 0;
  uint32_t beam[N];           // its number in the list that the map was made of
  float s[N];                 // along the beam, m from its origin
  float x[N], y[N], z[N];     // of the place from the origin of a ray or bundle, or from a point, m
  float dx[N], dy[N], dz[N];  // the beam's direction, unit
  float r[N], g[N], b[N];     // its power at its origin, W
};

/// Those nearest to a ray or to a point that the beams pass more closely than a radius.
struct BeamPlaces : PlacesOnBeams<256> {
  float distance2[kMost];  // from the ray's line or the point, m^2
};

/// Those nearest to a ray, with the other end of the common perpendicular of the two lines.
struct BeamCrossings : BeamPlaces {
  float t[kMost];     // along the ray, m
  float sine[kMost];  // of the angle between the two, > 0
};

/// The middles of pieces of beams that rays of a bundle may pass closely.
struct BundledBeams : PlacesOnBeams<128> {
  float half[kMost];  // of the pieces' lengths, m
};

class PhotonBeamMap {
 public:
  PhotonBeamMap() = default;
  /// Of beams that are met within `radius`, m, > 0; powers are multiplied by `scale`: 1/emitted.
  PhotonBeamMap(const std::vector<PhotonBeam>& beams, float radius, float scale);

  /// Calls visit(const BeamCrossings&) for the beams that pass the ray within the radius, where the perpendicular meets
  /// the ray in the interval; some at a time, in a fixed order. Returns how many pieces of beams it looked at.
  template <class Visit>
  uint32_t visit_crossings(const Ray& ray, const Interval& interval, Visit&& visit) const;
  class Selection;
  /// Makes `near` those pieces that rays of a bundle may pass closely. Returns how many it looked at.
  uint32_t select(const RayBundle& bundle, Selection& near) const;
  /// Calls visit(const BeamPlaces&) for the beams that have a perpendicular to the point, no longer than the radius; in
  /// the same way.
  template <class Visit>
  uint32_t visit_near(const Vec3& point, Visit&& visit) const;

  size_t size() const { return size_; }
  const Box& bounds() const { return bounds_; }
  size_t memory_bytes() const;

 private:
  /// The pieces of a leaf; those that a leaf lacks have a length below 0 and are never met.
  struct alignas(64) Leaf {
    float x[kBlock], y[kBlock], z[kBlock];     // of their middles, m
    float dx[kBlock], dy[kBlock], dz[kBlock];  // direction, unit
    float half[kBlock];                        // of their lengths, m

    Floats3 middles() const { return Floats3::of(x, y, z); }
    Floats3 directions() const { return Floats3::of(dx, dy, dz); }
    void put(size_t i, const Vec3& middle, const Vec3& direction, float half_length);
  };
  /// The beams that the pieces of a leaf are of.
  struct alignas(64) Owners {
    float from[kBlock];                     // of the pieces' middles from the beam's origin, m
    float r[kBlock], g[kBlock], b[kBlock];  // the beam's power, W
    uint32_t beam[kBlock];                  // its number

    void put(size_t i, const Rgb& power, float from_origin, uint32_t number);
  };
  /// The axes across a ray and along it.
  struct Frame {
    explicit Frame(const Vec3& direction);

    Vec3 right, up, along;
  };
  /// Which pieces of a leaf does the ray pass closely?
  LaneMask test(const Leaf& leaf, const Ray& ray, const Frame& frame, const Interval& interval) const;
  /// The same for a point.
  LaneMask test(const Leaf& leaf, const Vec3& point) const;
  /// The same for the rays of a bundle, and some pieces that they pass by a little further away.
  static LaneMask test(const Leaf& leaf, const RayBundle& bundle, float radius);
  /// `search` hands the number of each leaf that it visits, and which pieces of it are near, to its argument; `use`
  /// takes these pieces, up to kMost at a time. Returns how many pieces were looked at.
  template <size_t kMost, class Search, class Use>
  static uint32_t collect(Search&& search, Use&& use);
  /// The middles of pieces as places.
  template <size_t N>
  static void read(const std::vector<Leaf>& leaves, const std::vector<Owners>& owners, const uint32_t* pieces,
                   size_t count, const Vec3& from, PlacesOnBeams<N>& found);
  void cross(const uint32_t* pieces, size_t count, const Ray& ray, const Frame& frame, BeamCrossings& found) const;
  void stand_beside(const uint32_t* pieces, size_t count, const Vec3& point, BeamPlaces& found) const;

  size_t size_ = 0;
  float radius_ = 0.0f;  // m
  std::vector<Leaf> leaves_;
  std::vector<Owners> owners_;
  BoxTree boxes_;
  Box bounds_;
};

/// Some pieces of a map, for bundles that are parts of another. Keeps its memory when it is filled anew.
class PhotonBeamMap::Selection {
 public:
  /// Calls visit(const BundledBeams&) for the pieces near the rays of a bundle, in a fixed order. Returns how many it
  /// looked at.
  template <class Visit>
  uint32_t visit_near_bundle(const RayBundle& bundle, Visit&& visit) const;

 private:
  friend class PhotonBeamMap;
  void add(const Leaf& leaf, const Owners& owners, size_t i);

  float radius_ = 0.0f;  // m
  size_t size_ = 0;
  std::vector<Leaf> leaves_;
  std::vector<Owners> owners_;
};

inline LaneMask PhotonBeamMap::test(const Leaf& leaf, const Ray& ray, const Frame& frame,
                                    const Interval& interval) const {
  const Floats3 middle = leaf.middles() - ray.origin, direction = leaf.directions();
  const Floats a = dot(frame.right, middle), b = dot(frame.up, middle);
  const Floats da = dot(frame.right, direction), db = dot(frame.up, direction);
  const Floats sine2 = da * da + db * db, across = a * db - b * da;
  const Floats s_sine2 = Floats{} - (a * da + b * db);  // along the beam from the middle, times sine2
  const Floats t_sine2 = dot(frame.along, middle) * sine2 + s_sine2 * dot(frame.along, direction);
  const Floats end = lanes_of(leaf.half) * sine2;
  return (across * across < radius_ * radius_ * sine2) & (s_sine2 >= Floats{} - end) & (s_sine2 < end) &
         (t_sine2 >= interval.t0 * sine2) & (t_sine2 < interval.t1 * sine2);
}

inline LaneMask PhotonBeamMap::test(const Leaf& leaf, const Vec3& point) const {
  const Floats3 middle = leaf.middles() - point, direction = leaf.directions();
  const Floats s = Floats{} - dot(middle, direction), half = lanes_of(leaf.half);
  const Floats3 across = middle + s * direction;
  return (dot(across, across) < radius_ * radius_) & (s >= Floats{} - half) & (s < half);
}

inline LaneMask PhotonBeamMap::test(const Leaf& leaf, const RayBundle& bundle, float radius) {
  const HalfSpaces& region = bundle.region();
  const float reach = 1.0001f * radius;
  const Floats3 middle = leaf.middles() - bundle.apex(), direction = leaf.directions();
  // Each plane, moved by the radius, cuts off a part of a piece; what no plane cuts off lies among the rays.
  Floats end = lanes_of(leaf.half), begin = Floats{} - end;  // m from the middle
  for (int k = 0; k < region.count(); ++k) {
    const Floats depth = dot(region.normal(k), middle) - (region.offset(k) - reach);
    const Floats rise = dot(region.normal(k), direction), at = (Floats{} - depth) / rise;
    begin = vpm::select(rise > 0.0f, max(at, begin), begin);
    end = vpm::select(rise < 0.0f, min(at, end), end);
    end = vpm::select((rise == 0.0f) & (depth < 0.0f), -kInfinity, end);
  }
  return begin <= end;
}

template <size_t N>
void PhotonBeamMap::read(const std::vector<Leaf>& leaves, const std::vector<Owners>& owners, const uint32_t* pieces,
                         size_t count, const Vec3& from, PlacesOnBeams<N>& found) {
  for (size_t i = 0; i < count; ++i) {
    const Leaf& leaf = leaves[pieces[i] / kBlock];
    const Owners& of = owners[pieces[i] / kBlock];
    const uint32_t p = pieces[i] % kBlock;
    found.x[i] = leaf.x[p] - from.x;
    found.y[i] = leaf.y[p] - from.y;
    found.z[i] = leaf.z[p] - from.z;
    found.dx[i] = leaf.dx[p];
    found.dy[i] = leaf.dy[p];
    found.dz[i] = leaf.dz[p];
    found.s[i] = of.from[p];
    found.r[i] = of.r[p];
    found.g[i] = of.g[p];
    found.b[i] = of.b[p];
    found.beam[i] = of.beam[p];
  }
  found.size = count;
}

inline void PhotonBeamMap::cross(const uint32_t* pieces, size_t count, const Ray& ray, const Frame& frame,
                                 BeamCrossings& found) const {
  read(leaves_, owners_, pieces, count, ray.origin, found);
  const Vec3 right = frame.right, up = frame.up, along = frame.along;
  for (size_t i = 0; i < count; ++i) {
    const Vec3 middle(found.x[i], found.y[i], found.z[i]), d(found.dx[i], found.dy[i], found.dz[i]);
    const float a = glm::dot(middle, right), b = glm::dot(middle, up), da = glm::dot(d, right), db = glm::dot(d, up);
    const float sine2 = da * da + db * db, across = a * db - b * da, s = -(a * da + b * db) / sine2;
    const Vec3 place = middle + s * d;
    found.t[i] = glm::dot(place, along);
    found.s[i] += s;
    found.distance2[i] = across * across / sine2;
    found.sine[i] = std::sqrt(sine2);
    found.x[i] = place.x;
    found.y[i] = place.y;
    found.z[i] = place.z;
  }
}

inline void PhotonBeamMap::stand_beside(const uint32_t* pieces, size_t count, const Vec3& point,
                                        BeamPlaces& found) const {
  read(leaves_, owners_, pieces, count, point, found);
  for (size_t i = 0; i < count; ++i) {
    const Vec3 middle(found.x[i], found.y[i], found.z[i]), d(found.dx[i], found.dy[i], found.dz[i]);
    const float s = -glm::dot(middle, d);
    const Vec3 place = middle + s * d;
    found.s[i] += s;
    found.distance2[i] = glm::dot(place, place);
    found.x[i] = place.x;
    found.y[i] = place.y;
    found.z[i] = place.z;
  }
}

template <size_t kMost, class Search, class Use>
uint32_t PhotonBeamMap::collect(Search&& search, Use&& use) {
  uint32_t pieces[kMost + kBlock];
  size_t count_found = 0;
  uint32_t visited = 0;
  search([&](uint32_t leaf, const LaneMask& near) {
    count_found += store_numbers(leaf * kBlock, bits_of(near), pieces + count_found);
    if (count_found > kMost - kBlock) {
      cancellation_point();
      use(pieces, count_found);
      count_found = 0;
    }
    count(visited, kBlock);
  });
  if (count_found > 0) use(pieces, count_found);
  return visited;
}

template <class Visit>
uint32_t PhotonBeamMap::visit_crossings(const Ray& ray, const Interval& interval, Visit&& visit) const {
  if (size_ == 0) return 0;
  const Frame frame(ray.direction);
  BeamCrossings found;
  const auto search = [&](auto&& use_leaf) {
    boxes_.visit_leaves(ray, interval,
                        [&](uint32_t leaf) { use_leaf(leaf, test(leaves_[leaf], ray, frame, interval)); });
  };
  return collect<BeamPlaces::kMost>(search, [&](const uint32_t* pieces, size_t number) {
    cross(pieces, number, ray, frame, found);
    visit(std::as_const(found));
  });
}

template <class Visit>
uint32_t PhotonBeamMap::Selection::visit_near_bundle(const RayBundle& bundle, Visit&& visit) const {
  BundledBeams found;
  const auto search = [&](auto&& use_leaf) {
    for (uint32_t leaf = 0; leaf < chunk_count(size_, kBlock); ++leaf) {
      use_leaf(leaf, test(leaves_[leaf], bundle, radius_));
    }
  };
  return collect<BundledBeams::kMost>(search, [&](const uint32_t* pieces, size_t number) {
    read(leaves_, owners_, pieces, number, bundle.apex(), found);
    for (size_t i = 0; i < number; ++i) found.half[i] = leaves_[pieces[i] / kBlock].half[pieces[i] % kBlock];
    visit(std::as_const(found));
  });
}

template <class Visit>
uint32_t PhotonBeamMap::visit_near(const Vec3& point, Visit&& visit) const {
  if (size_ == 0) return 0;
  BeamPlaces found;
  const auto search = [&](auto&& use_leaf) {
    boxes_.visit_leaves(point, [&](uint32_t leaf) { use_leaf(leaf, test(leaves_[leaf], point)); });
  };
  return collect<BeamPlaces::kMost>(search, [&](const uint32_t* pieces, size_t number) {
    stand_beside(pieces, number, point, found);
    visit(std::as_const(found));
  });
}

}  // namespace vpm
