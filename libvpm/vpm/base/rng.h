// Random numbers addressed by (seed, stream, index), so that a result never depends on thread order.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include "vpm/base/vec.h"

namespace vpm {

/// What a stream of random numbers is used for; keeps streams of one pass apart.
enum class RngUse : uint64_t {
  photon = 1,
  pixel = 2,
  probe = 3,
  test = 4,
  texel = 5,
  importon = 6,
  scout = 7,
  caustic = 8,
  caustic_scout = 9,
  pilot = 10,
  flight = 11,
  plane = 12,
  sequence = 13,
  square = 14,
  lamp = 15
};

/// A permuted congruential generator with 128 bits of state [ONeill2014, sec. 6.3, XSL RR]. Equal (seed, stream,
/// index) give equal sequences; different ones start at hashed, unrelated states.
class Rng {
 public:
  Rng(uint64_t seed, uint64_t stream, uint64_t index) {
    uint64_t h = mix(seed + 0x9e3779b97f4a7c15ull);
    h = mix(h ^ mix(stream + 0xd1b54a32d192ed03ull));
    const uint64_t low = mix(h ^ mix(index + 0x8cb92ba72f3d8dd7ull));
    state_ = (static_cast<Uint128>(mix(low ^ h)) << 64) | low;
  }

  /// The next draws are these, before those of the generator. They must stay where they are until they are drawn.
  void lead(std::span<const uint64_t> draws) {
    lead_ = draws.data();
    lead_end_ = lead_ + draws.size();
  }

  /// 64 uniform bits.
  uint64_t bits() {
    if (lead_ != lead_end_) return *lead_++;
    state_ = state_ * kMultiplier + kIncrement;
    const auto folded = static_cast<uint64_t>(state_ >> 64) ^ static_cast<uint64_t>(state_);
    const auto turn = static_cast<unsigned>(state_ >> 122);
    return (folded >> turn) | (folded << ((-turn) & 63u));
  }
  /// Uniform in [0, 1), a multiple of 2^-24.
  float uniform() { return static_cast<float>(bits() >> 40) * 0x1p-24f; }
  /// Uniform in [0, 1), a multiple of 2^-53: for free flights, whose tails need more than 24 bits.
  [[gnu::always_inline]] double uniform_double() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  /// Exponential of mean 1. 1 - u is exact, so that its logarithm is -log1p(-u), at half the cost.
  double exponential() { return -std::log(1.0 - uniform_double()); }
  /// Two uniform numbers in [0, 1).
  Vec2 uniform2() {
    const uint64_t b = bits();
    return {static_cast<float>(b >> 40) * 0x1p-24f, static_cast<float>((b >> 8) & 0xffffffu) * 0x1p-24f};
  }

 private:
  __extension__ typedef unsigned __int128 Uint128;
  static constexpr Uint128 kMultiplier = (static_cast<Uint128>(0x2360ed051fc65da4ull) << 64) | 0x4385df649fccf645ull;
  static constexpr Uint128 kIncrement = (static_cast<Uint128>(0x5851f42d4c957f2dull) << 64) | 0x14057b7ef767814full;

  /// Finaliser of SplitMix64 [Steele2014, fig. 16].
  static uint64_t mix(uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }

  Uint128 state_;
  const uint64_t* lead_ = nullptr;  // draws that come first
  const uint64_t* lead_end_ = nullptr;
};

/// The stream number of one use in one pass.
inline uint64_t rng_stream(RngUse use, uint64_t pass) { return (static_cast<uint64_t>(use) << 56) | pass; }

}  // namespace vpm
