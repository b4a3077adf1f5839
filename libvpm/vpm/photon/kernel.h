// Density estimation kernels in one to three dimensions, normalised over the unit ball, and estimates by them, each
// with what would correct its bias, from the same photons. A kernel of order 4 has no second moment: the error that it
// makes in a smooth density is of the fourth power of its radius, where that of the others is of the second. For that
// it is negative near its border, so that estimates may be.
#pragma once

#include <array>
#include <cmath>

#include "vpm/base/vec.h"

namespace vpm {

/// A sum that is linear in a kernel, and the same sum with kernel_correction() in the place of the kernel. The noise of
/// the two is that of the same photons, so few passes are enough to estimate the bias: it is minus the mean of
/// `correction` where it goes as r^2, and minus twice that where it goes as r.
template <class T>
struct KernelPair {
  T value{0.0f};
  T correction{0.0f};  // 0: no kernel takes part

  KernelPair() = default;
  /// What no kernel takes part in.
  KernelPair(const T& exact) : value(exact) {}
  KernelPair(const T& of_kernel, const T& of_correction) : value(of_kernel), correction(of_correction) {}

  KernelPair& operator+=(const KernelPair& other) {
    value += other.value;
    correction += other.correction;
    return *this;
  }
  KernelPair& operator-=(const KernelPair& other) {
    value -= other.value;
    correction -= other.correction;
    return *this;
  }
  friend KernelPair operator+(KernelPair a, const KernelPair& b) { return a += b; }
  friend KernelPair operator-(KernelPair a, const KernelPair& b) { return a -= b; }
  friend KernelPair operator*(const KernelPair& a, const T& factor) {
    return {a.value * factor, a.correction * factor};
  }
  friend KernelPair operator*(const T& factor, const KernelPair& a) { return a * factor; }
};

/// Of a radiance or an irradiance.
using KernelEstimate = KernelPair<Rgb>;

/// Cone: [Jensen2001, sec. 7.2]; order_4: [Silverman1986, sec. 3.6]; the others: [Silverman1986, sec. 4.2].
enum class KernelKind { constant, cone, epanechnikov, biweight, triweight, order_4 };

struct KernelInfo {
  KernelKind kind;
  const char* name;
  float line;        // what the profile is multiplied by for its integral from -1 to 1 to be 1
  float disc, ball;  // pi times what it is multiplied by for its integral over the unit disc, or ball, to be 1
  float line_size, disc_size, ball_size;  // 1 over the integral of the square of the kernel at the radius 1; of the
                                          // last two, over pi
};

/// All kernels, in the order of KernelKind.
inline constexpr std::array<KernelInfo, 6> kKernels{
    {{KernelKind::constant, "constant", 0.5f, 1.0f, 0.75f, 2.0f, 1.0f, 4.0f / 3},
     {KernelKind::cone, "cone", 1.0f, 3.0f, 3.0f, 1.5f, 2.0f / 3, 5.0f / 6},
     {KernelKind::epanechnikov, "epanechnikov", 0.75f, 2.0f, 1.875f, 5.0f / 3, 0.75f, 14.0f / 15},
     {KernelKind::biweight, "biweight", 0.9375f, 3.0f, 3.28125f, 1.4f, 5.0f / 9, 22.0f / 35},
     {KernelKind::triweight, "triweight", 1.09375f, 4.0f, 4.921875f, 429.0f / 350, 0.4375f, 143.0f / 315},
     {KernelKind::order_4, "order-4", 1.40625f, 6.0f, 8.203125f, 0.8f, 5.0f / 24, 88.0f / 525}}};

inline const KernelInfo& kernel_info(KernelKind kind) { return kKernels[static_cast<size_t>(kind)]; }

/// The power of the radius that the error of a kernel in a smooth density goes with.
inline int kernel_order(KernelKind kind) { return kind == KernelKind::order_4 ? 4 : 2; }

/// The mean of the square of a coordinate under a kernel of radius 1 in `dimension` dimensions. 0 for order 4. Of lines
/// across a ray, which have one dimension in two, it is half of that along each axis.
constexpr float kernel_variance(KernelKind kind, int dimension) {
  const auto d = static_cast<float>(dimension);
  if (kind == KernelKind::order_4) return 0.0f;
  if (kind == KernelKind::cone) return (d + 1.0f) / ((d + 2.0f) * (d + 3.0f));
  const auto power = static_cast<float>(kind == KernelKind::constant       ? 0
                                        : kind == KernelKind::epanechnikov ? 1
                                        : kind == KernelKind::biweight     ? 2
                                                                           : 3);  // of 1 - q
  return 1.0f / (2.0f * power + d + 2.0f);
}

/// `a` where the condition holds, else `b`; floats.h has that of many numbers.
inline float select(bool condition, float a, float b) { return condition ? a : b; }

/// The kernels' profiles in q = (distance / radius)^2, q <= 1, without their normalisation: (1 - q)^n, and 1 - sqrt(q).
/// That of order 4 in d dimensions is (1 - q) (1 - c q): the integral of q times it over the ball is proportional to
/// 1/(d+2) - (1+c)/(d+4) + c/(d+6), which is 0 for c = (d+6)/(d+2). A Real is a float, or Floats.
template <KernelKind K, int Dimension, class Real>
Real kernel_profile(const Real& q) {
  using std::sqrt;
  if constexpr (K == KernelKind::constant) return 1.0f;
  if constexpr (K == KernelKind::cone) return 1.0f - sqrt(q);
  if constexpr (K == KernelKind::epanechnikov) return 1.0f - q;
  if constexpr (K == KernelKind::biweight) return (1.0f - q) * (1.0f - q);
  if constexpr (K == KernelKind::triweight) return (1.0f - q) * (1.0f - q) * (1.0f - q);
  if constexpr (K == KernelKind::order_4) return (1.0f - q) * (1.0f - (Dimension + 6.0f) / (Dimension + 2.0f) * q);
}

/// What a kernel sum changes by where its kernel shrinks: -(r/2) d/dr of the kernel in `Dimension` dimensions, over its
/// normalisation, as the kernels' profiles are. It integrates to 0, and the sum of both has no second moment: a bias
/// that goes as r^2 is minus what this weight gives on average. One that goes as r is twice that; one that goes as r^4,
/// the least that a kernel of order 4 has, is half of that. A constant kernel has no derivative at its edge; for it,
/// the difference from the kernel of radius r/sqrt(2) has the same two properties.
template <KernelKind K, int Dimension, class Real>
Real kernel_correction(const Real& q) {
  using std::sqrt;
  constexpr float d = Dimension;
  if constexpr (K == KernelKind::constant) return select(q < 0.5f, 2.0f * std::exp2(d / 2.0f) - 2.0f, -2.0f);
  if constexpr (K == KernelKind::cone) return d / 2.0f - (d + 1.0f) / 2.0f * sqrt(q);
  if constexpr (K == KernelKind::epanechnikov) return d / 2.0f * (1.0f - q) - q;
  if constexpr (K == KernelKind::biweight) return (1.0f - q) * (d / 2.0f * (1.0f - q) - 2.0f * q);
  if constexpr (K == KernelKind::triweight) return (1.0f - q) * (1.0f - q) * (d / 2.0f * (1.0f - q) - 3.0f * q);
  if constexpr (K == KernelKind::order_4) {
    constexpr float c = (d + 6.0f) / (d + 2.0f);
    return d / 2.0f * (1.0f - q) * (1.0f - c * q) - q * (1.0f + c - 2.0f * c * q);
  }
}

/// What the profile is multiplied by for its integral over the ball of radius r to be 1: 1/m, 1/m^2 or 1/m^3.
inline float kernel_norm_1d(KernelKind kind, float r) { return kernel_info(kind).line / r; }
inline float kernel_norm_2d(KernelKind kind, float r) { return kernel_info(kind).disc / (kPi * r * r); }
inline float kernel_norm_3d(KernelKind kind, float r) { return kernel_info(kind).ball / (kPi * r * r * r); }

/// The length (m), area (m^2) or volume (m^3) of a constant kernel that has the variance of this one: 1 over the
/// integral of the square of the normalised kernel.
inline float kernel_size_1d(KernelKind kind, float r) { return kernel_info(kind).line_size * r; }
inline float kernel_size_2d(KernelKind kind, float r) { return kernel_info(kind).disc_size * kPi * r * r; }
inline float kernel_size_3d(KernelKind kind, float r) { return kernel_info(kind).ball_size * kPi * r * r * r; }

/// The integral of the normalised kernel over the interval, disc, or ball of `t` <= 1 times its radius; 1 at 1,
/// exactly. It is never negative, and above 1 for order 4 where its negative rim is cut off.
inline double kernel_within_1d(KernelKind kind, double t) {
  const double q = t * t;
  switch (kind) {
    case KernelKind::constant:
      return t;
    case KernelKind::cone:
      return t * (2.0 - t);
    case KernelKind::epanechnikov:
      return t * (3.0 - q) / 2.0;
    case KernelKind::biweight:
      return t * (15.0 + q * (3.0 * q - 10.0)) / 8.0;
    case KernelKind::triweight:
      return t * (35.0 + q * (q * (21.0 - 5.0 * q) - 35.0)) / 16.0;
    case KernelKind::order_4:
      break;
  }
  return t * (45.0 + q * (21.0 * q - 50.0)) / 16.0;
}
inline double kernel_within_2d(KernelKind kind, double t) {
  const double q = t * t, rest = 1.0 - q;
  switch (kind) {
    case KernelKind::constant:
      return q;
    case KernelKind::cone:
      return q * (3.0 - 2.0 * t);
    case KernelKind::epanechnikov:
      return 1.0 - rest * rest;
    case KernelKind::biweight:
      return 1.0 - rest * rest * rest;
    case KernelKind::triweight:
      return 1.0 - rest * rest * rest * rest;
    case KernelKind::order_4:
      break;
  }
  return q * (6.0 - q * (9.0 - 4.0 * q));
}
inline double kernel_within_3d(KernelKind kind, double t) {
  const double q = t * t, cube = q * t;
  switch (kind) {
    case KernelKind::constant:
      return cube;
    case KernelKind::cone:
      return cube * (4.0 - 3.0 * t);
    case KernelKind::epanechnikov:
      return cube * (5.0 - 3.0 * q) / 2.0;
    case KernelKind::biweight:
      return cube * (35.0 + q * (15.0 * q - 42.0)) / 8.0;
    case KernelKind::triweight:
      return cube * (105.0 + q * (q * (135.0 - 35.0 * q) - 189.0)) / 16.0;
    case KernelKind::order_4:
      break;
  }
  return cube * (175.0 + q * (135.0 * q - 294.0)) / 16.0;
}

/// The integral of the normalised kernel over the interval (dimension 1), disc (2) or ball (3) of `t` <= 1 times its
/// radius, and that of its correction: t/2 times the derivative of the first.
KernelPair<double> kernel_within(KernelKind kind, int dimension, double t);

}  // namespace vpm
