// Photons in the order of a map, laid out for gathering: positions side by side for the loop that computes distances,
// the rest apart for the few that are near.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "base/below.h"
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
  /// The photons in that order, with powers multiplied by `scale`.
  PhotonTable(const std::vector<Photon>& photons, const std::vector<uint32_t>& order, float scale);

  /// Calls visit(i, offset from `point`, squared distance) for the photons of [begin, end) nearer to `point` than the
  /// root of `limit2`, m^2, in their order.
  template <class Visit>
  void for_each_near(size_t begin, size_t end, const Vec3& point, float limit2, Visit&& visit) const;

  /// Calls visit(i, distance along the ray, m, squared distance from it) for the photons of [begin, end) that are
  /// nearer to the ray than the root of `limit2`, m^2, at distances along it of [t0, t1), in their order.
  template <class Visit>
  void for_each_beside(size_t begin, size_t end, const Ray& ray, const Interval& interval, float limit2,
                       Visit&& visit) const;

  const Payload& payload(size_t i) const { return payload_[i]; }
  size_t size() const { return payload_.size(); }
  size_t memory_bytes() const { return 3 * x_.capacity() * sizeof(float) + payload_.capacity() * sizeof(Payload); }

 private:
  static constexpr uint32_t kBlock = 16;  // distances computed at once; blocks may reach beyond the last photon

  std::vector<float> x_, y_, z_;
  std::vector<Payload> payload_;
};

/// The box around the photons.
Box bounds_of(const std::vector<Photon>& photons);

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
    const auto n = static_cast<uint32_t>(std::min<size_t>(kBlock, end - block));
    for (uint32_t near = bits_below(d2, limit2) & ((1u << n) - 1); near != 0; near &= near - 1) {
      const int i = std::countr_zero(near);
      visit(block + static_cast<size_t>(i), Vec3(dx[i], dy[i], dz[i]), d2[i]);
    }
  }
}

template <class Visit>
void PhotonTable::for_each_beside(size_t begin, size_t end, const Ray& ray, const Interval& interval, float limit2,
                                  Visit&& visit) const {
  const Vec3 o = ray.origin, w = ray.direction;
  for (size_t block = begin; block < end; block += kBlock) {
    const float *x = &x_[block], *y = &y_[block], *z = &z_[block];
    float t[kBlock], d2[kBlock];
    for (uint32_t i = 0; i < kBlock; ++i) {
      const float dx = x[i] - o.x, dy = y[i] - o.y, dz = z[i] - o.z;
      t[i] = dx * w.x + dy * w.y + dz * w.z;
      const float ex = dx - t[i] * w.x, ey = dy - t[i] * w.y, ez = dz - t[i] * w.z;
      const float across = ex * ex + ey * ey + ez * ez;
      d2[i] = t[i] >= interval.t0 && t[i] < interval.t1 ? across : kInfinity;
    }
    const auto n = static_cast<uint32_t>(std::min<size_t>(kBlock, end - block));
    for (uint32_t near = bits_below(d2, limit2) & ((1u << n) - 1); near != 0; near &= near - 1) {
      const int i = std::countr_zero(near);
      visit(block + static_cast<size_t>(i), t[i], d2[i]);
    }
  }
}

}  // namespace vpm
