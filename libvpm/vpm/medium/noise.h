// Lattice noise from integer hashes, with its gradient: the same bits on every machine.
#pragma once

#include "vpm/base/vec.h"

namespace vpm {

/// A value and its gradient.
struct NoiseSample {
  float value = 0.0f;
  Vec3 gradient{0.0f};
};

/// 32 well-mixed bits of a lattice point.
uint32_t lattice_hash(const Vec3i& p, uint32_t seed);
/// A number in [0, 1) of a lattice point.
float lattice_value(const Vec3i& p, uint32_t seed);

/// Gradient noise [Perlin2002] with its exact gradient: 0 at lattice points, about -0.8 to 0.8, features of size 1.
NoiseSample gradient_noise(const Vec3& p, uint32_t seed);

/// Value noise: random numbers in [0, 1) at the lattice points, interpolated trilinearly.
float value_noise(const Vec3& p, uint32_t seed);

/// Sum of `octaves` gradient noises, each of half the size and amplitude of the one before; about -1 to 1.
float fractal_noise(const Vec3& p, int octaves, uint32_t seed);

/// As fractal_noise, of absolute values: round bulges that meet in creases; 0 to about 1.
float billow_noise(const Vec3& p, int octaves, uint32_t seed);

/// A swirling displacement free of divergence: the curl of three gradient noises [Bridson2007, sec. 2].
Vec3 curl_noise(const Vec3& p, uint32_t seed);

}  // namespace vpm
