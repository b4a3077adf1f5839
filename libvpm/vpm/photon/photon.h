// The photon record, directions in four bytes, powers in eight.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "vpm/base/vec.h"

namespace vpm {

/// A unit vector in four bytes: octahedral coordinates of 16 bits each [Cigolle2014]. The error is at most 7e-5 rad.
class PackedDirection {
 public:
  PackedDirection() = default;
  [[gnu::always_inline]] explicit PackedDirection(const Vec3& d) {
    const float scale = 1.0f / (std::abs(d.x) + std::abs(d.y) + std::abs(d.z));
    const Vec2 p = d.z < 0.0f ? fold({d.x * scale, d.y * scale}) : Vec2(d.x * scale, d.y * scale);
    bits_ = step_of(p.x) << 16 | (step_of(p.y) & 0xffffu);
  }
  /// The direction, unit.
  Vec3 unpack() const { return glm::normalize(on_octahedron()); }
  /// The same direction, scaled to |x| + |y| + |z| = 1 instead. Needs no square root.
  Vec3 on_octahedron() const {
    const Vec2 p(static_cast<float>(static_cast<int32_t>(bits_) >> 16) / kSteps,
                 static_cast<float>(static_cast<int32_t>(bits_ << 16) >> 16) / kSteps);
    const float z = 1.0f - std::abs(p.x) - std::abs(p.y);
    const float below = std::max(0.0f, -z);  // for folding back without a branch
    return {p.x - std::copysign(below, p.x), p.y - std::copysign(below, p.y), z};
  }

 private:
  static constexpr float kSteps = 32767.0f;
  static uint32_t step_of(float x) { return static_cast<uint32_t>(std::lround(x * kSteps)); }
  /// Maps the octahedron's lower half to the square's corners.
  static Vec2 fold(const Vec2& p) {
    return {std::copysign(1.0f - std::abs(p.y), p.x), std::copysign(1.0f - std::abs(p.x), p.y)};
  }

  uint32_t bits_ = 0;  // x in the upper half, y in the lower
};

/// A power in eight bytes: 18 bits for each channel, and one binary exponent for all three. The error is at most 4e-6
/// of the largest channel, or 2e-38 W: far less than the noise of any sum over photons.
class PackedPower {
 public:
  PackedPower() = default;
  /// Each channel must be finite and >= 0.
  explicit PackedPower(const Rgb& power) {
    const float most = max_channel(power);
    int exponent = std::max(static_cast<int>(std::bit_cast<uint32_t>(most) >> 23) - 126, kLeastExponent);
    if (std::lrint(most * power_of_two(kBits - exponent)) > kMost) ++exponent;
    const float scale = power_of_two(kBits - exponent);
    auto bits = static_cast<uint64_t>(exponent - kLeastExponent);
    for (int c = 0; c < 3; ++c) bits = bits << kBits | static_cast<uint64_t>(std::lrint(power[c] * scale));
    low_ = static_cast<uint32_t>(bits);
    high_ = static_cast<uint32_t>(bits >> 32);
  }
  /// The power, W.
  Rgb unpack() const {
    const auto channel = [](uint32_t bits) { return static_cast<float>(static_cast<int>(bits & kMost)); };
    const float step = power_of_two(static_cast<int>(high_ >> (3 * kBits - 32)) + kLeastExponent - kBits);
    const Rgb steps(channel(high_ >> (2 * kBits - 32)), channel(high_ << (32 - kBits) | low_ >> kBits), channel(low_));
    return steps * step;
  }

 private:
  static constexpr int kBits = 18;
  static constexpr long kMost = (1l << kBits) - 1;
  static constexpr int kLeastExponent = kBits - 126;  // one step is then the least normal float
  static float power_of_two(int exponent) { return std::bit_cast<float>(static_cast<uint32_t>(exponent + 127) << 23); }

  uint32_t low_ = 0, high_ = 0;  // two words, so that a photon is aligned to four bytes
};

/// The two forms of the volumetric radiance estimate in a heterogeneous medium: with the density at the query point on
/// the ray, or at the photon. They agree as the radius goes to 0.
enum class VolumeForm { density_at_query, density_at_photon };

/// A photon as a map stores it.
struct Photon {
  Vec3 position{0.0f};     // m
  PackedDirection travel;  // direction in which it travelled when it arrived
  Rgb power{0.0f};         // W, or W over the density relative to the medium's largest: see stored_power()
};

static_assert(sizeof(Photon) == 28);

}  // namespace vpm
