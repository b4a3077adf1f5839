// Points of a Poisson process along a ray, at a rate that changes from stretch to stretch: where tracking estimators
// look.
#pragma once

#include "vpm/base/cancel.h"
#include "vpm/base/rng.h"
#include "vpm/base/vec.h"

namespace vpm {

class PoissonPoints {
 public:
  explicit PoissonPoints(Rng& rng) : rng_(rng), left_(draw()) {}

  /// Calls visit(t) for the points in [t0, t1), m, at `rate`, 1/m, until it returns false; returns whether it never
  /// did. Stretches are visited in order.
  template <class Visit>
  bool visit(double t0, double t1, double rate, Visit&& visit) {
    double t = t0;
    while (left_ < (t1 - t) * rate) {
      cancellation_point();
      t += left_ / rate;
      left_ = draw();
      if (!visit(t)) return false;
    }
    left_ -= (t1 - t) * rate;
    return true;
  }

 private:
  double draw() { return rng_.exponential(); }

  Rng& rng_;
  double left_;  // to the next point: the integral of the rate
};

/// Russian roulette of a product of look-ups once all channels are below 1 %: it survives with probability 1/2 and
/// doubles, or is black. False where it is black.
inline bool survives(Rgbd& product, Rng& rng) {
  constexpr double kRouletteBelow = 0.01;
  const Rgbd size = glm::abs(product);
  const double largest = std::max(size.r, std::max(size.g, size.b));
  if (largest >= kRouletteBelow) return true;
  const bool goes_on = largest > 0.0 && rng.uniform() < 0.5f;
  product *= goes_on ? 2.0 : 0.0;
  return goes_on;
}

}  // namespace vpm
