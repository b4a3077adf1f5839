// Estimates by kernels, each with what would correct its bias, from the same photons.
#pragma once

#include "vpm/base/vec.h"

namespace vpm {

/// A sum that is linear in a kernel, and the same sum with kernel_correction() in the place of the kernel. The noise of
/// the two is that of the same photons, so few passes tell the bias: it is minus the mean of `correction` where it goes
/// as r^2, and minus twice that where it goes as r.
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

}  // namespace vpm
