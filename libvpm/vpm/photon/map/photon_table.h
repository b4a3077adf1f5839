// Photons in the order of a map, laid out for gathering. Positions are in arrays of their own for the loop that
// computes distances. The rest is stored apart, because only the few near photons need it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "vpm/base/floats.h"
#include "vpm/base/vec.h"
#include "vpm/photon/map/ray_bundle.h"
#include "vpm/photon/photon.h"

namespace vpm {

class PhotonTable {
 public:
  /// The data of a photon that a gather reads besides the position.
  struct Payload {
    PackedDirection travel;
    PackedPower power;
  };
  static_assert(sizeof(Payload) == 12);

  PhotonTable() = default;
  /// Stores the photons in the order `order`, with powers multiplied by `scale`.
  PhotonTable(const std::vector<Photon>& photons, const std::vector<uint32_t>& order, float scale);

  /// Calls visit(squared distances from `point` (m^2), how many, number of the first) for the photons of [begin, end),
  /// in blocks of at most kBlock. The array always has kBlock entries; those behind the last distance have no meaning.
  template <class Visit>
  void for_each_block(size_t begin, size_t end, const Vec3& point, Visit&& visit) const;

  /// The same with squared perpendicular distances from the ray. They are infinite for photons whose projection onto
  /// the ray lies outside the interval.
  template <class Visit>
  void for_each_block(size_t begin, size_t end, const Ray& ray, const Interval& interval, Visit&& visit) const;

  /// The same with how far photons lie outside of half spaces, which are counted from `origin`: m, below 0 inside.
  template <class Visit>
  void for_each_block(size_t begin, size_t end, const Vec3& origin, const HalfSpaces& region, Visit&& visit) const;

  /// Prefetches the positions of the block that begins with a photon.
  void prefetch(size_t begin) const {
    for (const std::vector<float>* along : {&x_, &y_, &z_}) {
      __builtin_prefetch(along->data() + begin);
      __builtin_prefetch(along->data() + begin + kBlock - 1);
    }
  }
  Vec3 position(size_t i) const { return {x_[i], y_[i], z_[i]}; }
  const Payload& payload(size_t i) const { return payload_[i]; }
  size_t size() const { return payload_.size(); }
  size_t memory_bytes() const { return 3 * x_.capacity() * sizeof(float) + payload_.capacity() * sizeof(Payload); }

 private:
  // With kBlock further entries behind the last photon, so that whole blocks can be read.
  std::vector<float> x_, y_, z_;
  std::vector<Payload> payload_;
};

/// The box around the photons.
Box bounds_of(const std::vector<Photon>& photons);

template <class Visit>
void PhotonTable::for_each_block(size_t begin, size_t end, const Vec3& point, Visit&& visit) const {
  for (size_t block = begin; block < end; block += kBlock) {
    const float *x = &x_[block], *y = &y_[block], *z = &z_[block];
    float d2[kBlock];
    for (uint32_t i = 0; i < kBlock; ++i) {
      const float dx = x[i] - point.x, dy = y[i] - point.y, dz = z[i] - point.z;
      d2[i] = dx * dx + dy * dy + dz * dz;
    }
    visit(d2, static_cast<uint32_t>(std::min<size_t>(kBlock, end - block)), static_cast<uint32_t>(block));
  }
}

template <class Visit>
void PhotonTable::for_each_block(size_t begin, size_t end, const Ray& ray, const Interval& interval,
                                 Visit&& visit) const {
  const Vec3 o = ray.origin, w = ray.direction;
  const auto [t0, t1] = interval;
  for (size_t block = begin; block < end; block += kBlock) {
    const float *x = &x_[block], *y = &y_[block], *z = &z_[block];
    float d2[kBlock];
    for (uint32_t i = 0; i < kBlock; ++i) {
      const float dx = x[i] - o.x, dy = y[i] - o.y, dz = z[i] - o.z;
      const float t = dx * w.x + dy * w.y + dz * w.z;
      const float ex = dx - t * w.x, ey = dy - t * w.y, ez = dz - t * w.z;
      const float across = ex * ex + ey * ey + ez * ez;
      const float beyond = std::max(t0 - t, t < t1 ? -1.0f : 1.0f);  // > 0 outside; no branch, so that it is one loop
      d2[i] = beyond > 0.0f ? kInfinity : across;
    }
    visit(d2, static_cast<uint32_t>(std::min<size_t>(kBlock, end - block)), static_cast<uint32_t>(block));
  }
}

template <class Visit>
void PhotonTable::for_each_block(size_t begin, size_t end, const Vec3& origin, const HalfSpaces& region,
                                 Visit&& visit) const {
  const Vec3 o = origin;
  for (size_t block = begin; block < end; block += kBlock) {
    const float *x = &x_[block], *y = &y_[block], *z = &z_[block];
    float outside[kBlock];
    std::fill_n(outside, kBlock, -kInfinity);
    for (int k = 0; k < region.count(); ++k) {
      const Vec3 n = region.normal(k);
      const float offset = region.offset(k);
      for (uint32_t i = 0; i < kBlock; ++i)
        outside[i] = std::max(outside[i], offset - n.x * (x[i] - o.x) - n.y * (y[i] - o.y) - n.z * (z[i] - o.z));
    }
    visit(outside, static_cast<uint32_t>(std::min<size_t>(kBlock, end - block)), static_cast<uint32_t>(block));
  }
}

}  // namespace vpm
