// Building the boxes, from the leaves up.
#include "photon/segment_map.h"

#include "base/parallel.h"

namespace vpm {
namespace {

constexpr size_t kChunk = 1 << 10;  // leaves one thread takes at once

}  // namespace

SegmentMap::SegmentMap(const std::vector<Photon>& photons, float scale) {
  const LeafOrder tree = sort_into_leaves(photons, kLeaf);
  leaves_ = tree.leaves;
  photons_ = PhotonTable(photons, tree.order, scale);
  bounds_ = bounds_of(photons);
  for (int a = 0; a < 3; ++a) {
    lo_[a].assign(2 * leaves_ + kWide, kInfinity);  // the last boxes are met in groups, too
    hi_[a].assign(2 * leaves_ + kWide, -kInfinity);
  }
  parallel_for_chunks(leaves_, kChunk, [&](size_t begin, size_t end, size_t) {
    for (size_t leaf = begin; leaf < end; ++leaf)
      for (size_t i = leaf_begin(size(), leaves_, leaf); i < leaf_begin(size(), leaves_, leaf + 1); ++i)
        for (int a = 0; a < 3; ++a) {
          const float x = photons[tree.order[i]].position[a];
          lo_[a][leaves_ + leaf] = std::min(lo_[a][leaves_ + leaf], x);
          hi_[a][leaves_ + leaf] = std::max(hi_[a][leaves_ + leaf], x);
        }
  });
  for (size_t node = leaves_; node-- > 1;)
    for (int a = 0; a < 3; ++a) {
      lo_[a][node] = std::min(lo_[a][2 * node], lo_[a][2 * node + 1]);
      hi_[a][node] = std::max(hi_[a][2 * node], hi_[a][2 * node + 1]);
    }
}

size_t SegmentMap::memory_bytes() const {
  return sizeof(*this) + 6 * lo_[0].capacity() * sizeof(float) + photons_.memory_bytes();
}

}  // namespace vpm
