// Leaves, and boxes around them.
#include "vpm/integrators/combined/merge_map.h"

#include "vpm/photon/map/leaf_order.h"

namespace vpm {

MergeMap::MergeMap(const std::vector<MergePhoton>& photons, float reach) : size_(photons.size()) {
  if (photons.empty()) return;
  std::vector<Vec3> positions;
  positions.reserve(size_);
  for (const MergePhoton& photon : photons) positions.push_back(photon.point);
  const LeafOrder tree = sort_into_leaves(positions, kBlock);
  leaves_.resize(tree.leaves);
  for (const Vec3& position : positions) bounds_.add(position);
  boxes_ = BoxTree(tree.leaves, [&](size_t number) {
    const size_t begin = leaf_begin(size_, tree.leaves, number), end = leaf_begin(size_, tree.leaves, number + 1);
    Box box;
    for (size_t i = 0; i < kBlock; ++i) {
      const bool there = begin + i < end;
      leaves_[number].set(i, there ? photons[tree.order[begin + i]] : MergePhoton{.point = Vec3(kInfinity)});
      if (there) box.add(positions[tree.order[begin + i]]);
    }
    const float margin = 1.0001f * reach;  // for rounding
    return Box{box.lo - margin, box.hi + margin};
  });
}

}  // namespace vpm
