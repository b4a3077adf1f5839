// Building the kd-tree.
#include "vpm/photon/nearest_map.h"

namespace vpm {

NearestMap::NearestMap(const std::vector<Photon>& photons, float scale) {
  LeafOrder tree = sort_into_leaves(photons, kLeaf);
  leaves_ = tree.leaves;
  splits_ = std::move(tree.splits);
  photons_ = PhotonTable(photons, tree.order, scale);
  bounds_ = bounds_of(photons);
}

size_t NearestMap::memory_bytes() const {
  const size_t nodes = nodes_ ? nodes_->memory_bytes() : 0;
  return sizeof(*this) + splits_.capacity() * sizeof(Split) + photons_.memory_bytes() + nodes;
}

}  // namespace vpm
