// Building the boxes, from the leaves up.
#include "vpm/photon/segment_map.h"

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
  make_boxes();
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

void SegmentMap::make_boxes() {
  while ((size_t{1} << (kLevels * depth_)) < leaves_) ++depth_;
  for (int d = 0; d <= depth_; ++d)
    begin_[d + 1] = begin_[d] + std::max<size_t>(1, leaves_ >> (kLevels * (depth_ - d)));
  for (int a = 0; a < 3; ++a) {
    lo_[a].assign(begin_[depth_ + 1] + kBlock, kInfinity);  // whole blocks are read
    hi_[a].assign(begin_[depth_ + 1] + kBlock, -kInfinity);
  }
  parallel_for_chunks(leaves_, kLeafChunk, [&](size_t begin, size_t end, size_t) {
    for (size_t leaf = begin; leaf < end; ++leaf) {
      // A hair more than the radius, so that rounding loses no photon that the last test would take.
      const float reach = 1.0001f * radius_[leaf];
      const Box box = box_of(leaf_begin(size(), leaves_, leaf), leaf_begin(size(), leaves_, leaf + 1));
      include(begin_[depth_] + leaf, box.lo - reach, box.hi + reach);
    }
  });
  for (int d = depth_; d-- > 0;)
    for (size_t box = 0; box < begin_[d + 1] - begin_[d]; ++box) {
      const auto [first, count] = children(d, static_cast<uint32_t>(box));
      for (size_t i = begin_[d + 1] + first; i < begin_[d + 1] + first + count; ++i)
        include(begin_[d] + box, {lo_[0][i], lo_[1][i], lo_[2][i]}, {hi_[0][i], hi_[1][i], hi_[2][i]});
    }
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

void SegmentMap::include(size_t place, const Vec3& lo, const Vec3& hi) {
  for (int a = 0; a < 3; ++a) {
    lo_[a][place] = std::min(lo_[a][place], lo[a]);
    hi_[a][place] = std::max(hi_[a][place], hi[a]);
  }
}

SegmentMap::Beam SegmentMap::make_beam(const Ray& ray, const Interval& interval) const {
  // Boxes are met a hair wider than they are, as planes are rounded; and no component of the direction is so small that
  // 0 times its inverse has no value.
  const Vec3 reach = glm::max(glm::max(glm::abs(bounds_.lo), glm::abs(bounds_.hi)), glm::abs(ray.origin));
  const float wider = 1e-6f * max_channel(reach);
  Beam beam{interval, {}, {}, {}, {}, {}};
  for (int a = 0; a < 3; ++a) {
    const float d = ray.direction[a], sign = std::copysign(1.0f, d);
    beam.inverse[a] = 1.0f / (std::abs(d) < 1e-12f ? sign * 1e-12f : d);
    beam.enter[a] = (-sign * wider - ray.origin[a]) * beam.inverse[a];
    beam.leave[a] = (sign * wider - ray.origin[a]) * beam.inverse[a];
    beam.near[a] = (d < 0.0f ? hi_ : lo_)[a].data();
    beam.far[a] = (d < 0.0f ? lo_ : hi_)[a].data();
  }
  return beam;
}

size_t SegmentMap::memory_bytes() const {
  return sizeof(*this) + (6 * lo_[0].capacity() + radius_.capacity()) * sizeof(float) + photons_.memory_bytes();
}

}  // namespace vpm
