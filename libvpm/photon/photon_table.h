// Photons in the order of a map, laid out for gathering: positions side by side for the loop that computes distances,
// the rest apart for the few that are near.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "photon/photon.h"

namespace vpm {

class PhotonTable {
 public:
  /// What a gather reads of a photon beside its position.
  struct Payload {
    PackedDirection travel;
    PackedPower power;
  };
  static_assert(sizeof(Payload) == 12);

  PhotonTable() = default;
  /// Room for `size` photons, to be set.
  explicit PhotonTable(size_t size) : x_(size + kBlock), y_(size + kBlock), z_(size + kBlock), payload_(size) {}

  /// Makes `photon` the i-th, with its power multiplied by `scale`.
  void set(size_t i, const Photon& photon, float scale) {
    x_[i] = photon.position.x;
    y_[i] = photon.position.y;
    z_[i] = photon.position.z;
    payload_[i] = {photon.travel, PackedPower(photon.power * scale)};
  }

  /// Calls visit(i, offset from `point`, squared distance) for the photons of [begin, end) nearer to `point` than the
  /// root of `limit2`, m^2, in their order.
  template <class Visit>
  void for_each_near(size_t begin, size_t end, const Vec3& point, float limit2, Visit&& visit) const;

  const Payload& payload(size_t i) const { return payload_[i]; }
  size_t size() const { return payload_.size(); }
  size_t memory_bytes() const { return 3 * x_.capacity() * sizeof(float) + payload_.capacity() * sizeof(Payload); }

 private:
  static constexpr uint32_t kBlock = 16;  // distances computed at once; blocks may reach beyond the last photon

  std::vector<float> x_, y_, z_;
  std::vector<Payload> payload_;
};

template <class Visit>
void PhotonTable::for_each_near(size_t begin, size_t end, const Vec3& point, float limit2, Visit&& visit) const {
  for (size_t block = begin; block < end; block += kBlock) {
    const float *x = &x_[block], *y = &y_[block], *z = &z_[block];
    float dx[kBlock], dy[kBlock], dz[kBlock], d2[kBlock];
    for (uint32_t i = 0; i < kBlock; ++i) {
      dx[i] = x[i] - point.x;
      dy[i] = y[i] - point.y;
      dz[i] = z[i] - point.z;
      d2[i] = dx[i] * dx[i] + dy[i] * dy[i] + dz[i] * dz[i];
    }
    // Which are near is as good as random: they are listed without a branch for each.
    uint8_t near[kBlock];
    const auto n = static_cast<uint32_t>(std::min<size_t>(kBlock, end - block));
    uint32_t found = 0;
    for (uint32_t i = 0; i < n; ++i) {
      near[found] = static_cast<uint8_t>(i);
      found += d2[i] < limit2 ? 1 : 0;
    }
    for (uint32_t f = 0; f < found; ++f) {
      const uint32_t i = near[f];
      visit(block + i, Vec3(dx[i], dy[i], dz[i]), d2[i]);
    }
  }
}

}  // namespace vpm
