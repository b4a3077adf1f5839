// Unpacking photons.
#include "vpm/photon/map/photon_batch.h"

#include <array>

namespace vpm {

PhotonBatch::PhotonBatch(const PhotonTable& table, const uint32_t* photons, const float* distances2, size_t count)
    : number_(static_cast<uint32_t>(count)) {
  assert(count >= 1 && count <= kMost);
  uint32_t travel[kMost], low[kMost], high[kMost];
  for (size_t i = 0; i < count; ++i) {
    const auto [t, l, h] = std::bit_cast<std::array<uint32_t, 3>>(table.payload(photons[i]));
    travel[i] = t;
    low[i] = l;
    high[i] = h;
  }
  std::copy_n(distances2, count, distance2_);
  for (size_t i = count; i < size(); ++i) {
    distance2_[i] = 0.0f;
    travel[i] = travel[0];
    low[i] = high[i] = 0;
  }
  for (size_t i = 0; i < size(); ++i) {
    const Vec3 w = std::bit_cast<PackedDirection>(travel[i]).unpack();
    x_[i] = w.x;
    y_[i] = w.y;
    z_[i] = w.z;
  }
  for (size_t i = 0; i < size(); ++i) {
    const Rgb p = std::bit_cast<PackedPower>(std::array{low[i], high[i]}).unpack();
    r_[i] = p.r;
    g_[i] = p.g;
    b_[i] = p.b;
  }
}

}  // namespace vpm
