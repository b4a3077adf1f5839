// Density fields given by formulas: a smoke plume, a cumulus cloud, a fire, and simple shapes whose answers are known.
// And the noise in them: lattice noise from integer hashes, with its gradient, the same bits on every machine.
#pragma once

#include <span>
#include <string_view>

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

struct ProceduralField {
  std::string_view name;
  std::string_view summary;
  Vec3 world_size;                    // m, of the box that the unit cube stands for
  float (*value)(const Vec3& unit);   // at a point of [0, 1]^3: finite, >= 0, a density at most 1; y points up
  std::string_view grid = "density";  // its name in a file; temperatures are in kelvin
};

/// All fields. Their values are pure functions of the position. Those of one name belong into one file, the density
/// first.
std::span<const ProceduralField> procedural_fields();

/// The first field of that name, or null.
const ProceduralField* find_procedural_field(std::string_view name);

}  // namespace vpm
