// Sorting positions into leaves.
#include "vpm/estimate/combined/vertex_map.h"

#include "vpm/photon/leaf_order.h"

namespace vpm {

VertexMap::VertexMap(const std::vector<Vec3>& positions, float radius) : size_(positions.size()), radius_(radius) {
  if (positions.empty()) return;
  const LeafOrder tree = sort_into_leaves(positions, kBlock);
  leaves_.resize(tree.leaves);
  boxes_ = BoxTree(tree.leaves, [&](size_t number) {
    const size_t begin = leaf_begin(size_, tree.leaves, number), end = leaf_begin(size_, tree.leaves, number + 1);
    Leaf& leaf = leaves_[number];
    Box box;
    for (size_t i = 0; i < kBlock; ++i) {
      const bool there = begin + i < end;
      const Vec3 p = there ? positions[tree.order[begin + i]] : Vec3(kInfinity);
      leaf.x[i] = p.x;
      leaf.y[i] = p.y;
      leaf.z[i] = p.z;
      leaf.number[i] = there ? tree.order[begin + i] : 0;
      if (there) box.add(p);
    }
    const float reach = 1.0001f * radius;  // for rounding
    return Box{box.lo - reach, box.hi + reach};
  });
}

}  // namespace vpm
