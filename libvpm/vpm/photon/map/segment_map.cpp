// Sorting the photons, and their radii.
#include "vpm/photon/map/segment_map.h"

#include <bit>
#include <cmath>

#include "vpm/base/parallel.h"

namespace vpm {
namespace {

constexpr size_t kLeafChunk = 1 << 10;  // leaves one thread takes at once

}  // namespace

SegmentMap::SegmentMap(const std::vector<Photon>& photons, const BeamRadii& radii, float scale) {
  const LeafOrder tree = sort_into_leaves(photons, kLeaf);
  leaves_ = tree.leaves;
  photons_ = PhotonTable(photons, tree.order, scale);
  bounds_ = bounds_of(photons);
  choose_radii(radii);
  boxes_ = BoxTree(leaves_, [&](size_t leaf) {
    // A hair more than the radius, so that rounding loses no photon that the last test would take.
    const float reach = 1.0001f * radius_[leaf];
    const Box box = box_of(leaf_begin(size(), leaves_, leaf), leaf_begin(size(), leaves_, leaf + 1));
    return Box{box.lo - reach, box.hi + reach};
  });
}

// Leaves that lie side by side in the tree, together of about as many photons as are asked for, fill a box: its volume
// over their number is what a photon has to itself. Boxes without volume would have photons of no radius.
void SegmentMap::choose_radii(const BeamRadii& radii) {
  radius_.assign(leaves_, radii.largest);
  if (radii.count == 0 || size() == 0) return;
  const size_t group = std::clamp<size_t>(std::bit_floor(radii.count * leaves_ / size() + 1), 1, leaves_);
  parallel_for_chunks(leaves_ / group, kLeafChunk, [&](size_t begin, size_t end, size_t) {
    for (size_t g = begin; g < end; ++g) {
      const size_t first = leaf_begin(size(), leaves_, g * group), last = leaf_begin(size(), leaves_, (g + 1) * group);
      const auto n = static_cast<double>(last - first);
      // Of n even points the box around them lacks 2/(n + 1) of each side.
      const Vec3d extent = Vec3d(box_of(first, last).extent()) * (n + 1.0) / std::max(1.0, n - 1.0);
      const double volume = extent.x * extent.y * extent.z * radii.count / n;
      const auto radius = static_cast<float>(std::cbrt(0.75 / kPiD * volume)) * radii.scale;
      std::fill_n(&radius_[g * group], group,
                  std::clamp(radius, BeamRadii::kLeastShare * radii.largest, radii.largest));
    }
  });
}

Box SegmentMap::box_of(size_t begin, size_t end) const {
  Box box;
  for (size_t i = begin; i < end; ++i) box.add(photons_.position(i));
  return box;
}

float SegmentMap::radius(size_t i) const {
  const size_t leaf = ((i + 1) * leaves_ - 1) / size();  // the last that begins at or before i
  return radius_[leaf];
}

size_t SegmentMap::memory_bytes() const {
  return sizeof(*this) + boxes_.memory_bytes() + radius_.capacity() * sizeof(float) + photons_.memory_bytes();
}

}  // namespace vpm
