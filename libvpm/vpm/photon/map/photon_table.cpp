// Filling the table.
#include "vpm/photon/map/photon_table.h"

#include "vpm/base/parallel.h"

namespace vpm {
namespace {

constexpr size_t kTableChunk = 1 << 14;  // photons one thread takes at once

}  // namespace

PhotonTable::PhotonTable(const std::vector<Photon>& photons, const std::vector<uint32_t>& order, float scale)
    : x_(order.size() + kBlock), y_(order.size() + kBlock), z_(order.size() + kBlock), payload_(order.size()) {
  parallel_for_chunks(order.size(), kTableChunk, [&](size_t begin, size_t end, size_t) {
    for (size_t i = begin; i < end; ++i) {
      const Photon& photon = photons[order[i]];
      x_[i] = photon.position.x;
      y_[i] = photon.position.y;
      z_[i] = photon.position.z;
      payload_[i] = {photon.travel, PackedPower(photon.power * scale)};
    }
  });
}

Box bounds_of(const std::vector<Photon>& photons) {
  std::vector<Box> parts(chunk_count(photons.size(), kTableChunk));
  parallel_for_chunks(photons.size(), kTableChunk, [&](size_t begin, size_t end, size_t chunk) {
    for (size_t i = begin; i < end; ++i) parts[chunk].add(photons[i].position);
  });
  Box bounds;
  for (const Box& part : parts) bounds.add(part);
  return bounds;
}

}  // namespace vpm
