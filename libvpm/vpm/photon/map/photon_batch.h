// The photons that a query finds, in batches, with their members in arrays: a loop over the photons of a batch compiles
// to vector instructions.
#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "vpm/base/below.h"
#include "vpm/photon/kernel.h"
#include "vpm/photon/map/photon_table.h"

namespace vpm {

/// Collects photons nearer than a limit, and hands them on before the room runs out.
class NearPhotons {
 public:
  static constexpr size_t kMost = 256;

  /// Adds the photons of a block that are nearer than the square root of `limit2` (m^2). The block has `number` <=
  /// kBlock photons, numbered from `first` on. If there is no room for another block, calls use(NearPhotons&) and drops
  /// all.
  template <class Use>
  void add(const float* distances2, uint32_t number, uint32_t first, float limit2, Use&& use) {
    size_ += append_below(distances2, number, limit2, first, distances2_ + size_, photons_ + size_);
    if (size_ > kMost - kBlock) take(use);
  }
  /// Calls use(NearPhotons&) for the photons collected so far, if any, and drops them.
  template <class Use>
  void take(Use&& use) {
    if (size_ > 0) use(*this);
    size_ = 0;
  }
  /// Drops the photons for which accept(PackedDirection travel, offset from `point`) is false.
  template <class Accept>
  void keep(const PhotonTable& table, const Vec3& point, Accept&& accept);

  size_t size() const { return size_; }
  const uint32_t* photons() const { return photons_; }     // their numbers
  const float* distances2() const { return distances2_; }  // m^2

 private:
  size_t size_ = 0;
  float distances2_[kMost];
  uint32_t photons_[kMost];
};

/// Photons copied from a table, in whole blocks. The last block is filled up with photons of power 0.
class PhotonBatch {
 public:
  static constexpr size_t kMost = NearPhotons::kMost;

  /// `count` photons (1 to kMost), given by their numbers in the table and their squared distances (m^2).
  PhotonBatch(const PhotonTable& table, const uint32_t* photons, const float* distances2, size_t count);

  uint32_t number() const { return number_; }  // of photons, without those that fill up the last block
  size_t size() const { return (number_ + kBlock - 1) / kBlock * kBlock; }
  Vec3 travel(size_t i) const { return {x_[i], y_[i], z_[i]}; }
  Rgb power(size_t i) const { return {r_[i], g_[i], b_[i]}; }
  float distance2(size_t i) const { return distance2_[i]; }  // m^2

 private:
  uint32_t number_;
  float distance2_[kMost];
  float x_[kMost], y_[kMost], z_[kMost];
  float r_[kMost], g_[kMost], b_[kMost];
};

template <class Accept>
void NearPhotons::keep(const PhotonTable& table, const Vec3& point, Accept&& accept) {
  uint32_t travel[kMost];
  float x[kMost], y[kMost], z[kMost];
  for (size_t i = 0; i < size_; ++i) {
    const uint32_t photon = photons_[i];
    travel[i] = std::bit_cast<uint32_t>(table.payload(photon).travel);
    const Vec3 offset = table.position(photon) - point;
    x[i] = offset.x;
    y[i] = offset.y;
    z[i] = offset.z;
  }
  for (size_t i = 0; i < size_; ++i) {
    const bool accepted = accept(std::bit_cast<PackedDirection>(travel[i]), Vec3(x[i], y[i], z[i]));
    distances2_[i] = accepted ? distances2_[i] : kInfinity;
  }
  size_ = keep_up_to(distances2_, photons_, size_, std::numeric_limits<float>::max());
}

/// Sums over the photons of a batch, lane by lane: in floats, over at most kMost / kBlock values.
struct LaneSums {
  float r[kBlock] = {0.0f}, g[kBlock] = {0.0f}, b[kBlock] = {0.0f};

  void add(size_t lane, const Rgb& v) {
    r[lane] += v.r;
    g[lane] += v.g;
    b[lane] += v.b;
  }
  Rgbd total() const {
    Rgbd sum(0.0);
    for (size_t lane = 0; lane < kBlock; ++lane) sum += Rgbd(r[lane], g[lane], b[lane]);
    return sum;
  }
};

/// The sum of value(travel, power) * weight(number in the batch). Weights are pairs of floats or of Rgb.
template <class Weight, class Value>
KernelPair<Rgbd> sum_photons(const PhotonBatch& batch, Weight&& weight, Value&& value) {
  LaneSums values, corrections;
  for (size_t block = 0; block < batch.size(); block += kBlock)
    for (size_t lane = 0; lane < kBlock; ++lane) {
      const size_t i = block + lane;
      const Rgb v = value(batch.travel(i), batch.power(i));
      const auto w = weight(i);
      values.add(lane, v * w.value);
      corrections.add(lane, v * w.correction);
    }
  return {values.total(), corrections.total()};
}

}  // namespace vpm
