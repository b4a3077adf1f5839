// Distances along a ray at which to look for single scattering.
#pragma once

#include <optional>

#include "vpm/light/light.h"
#include "vpm/medium/density_integrals_along.h"

namespace vpm {

/// Distances along an interval of a ray, uniform in the angle under which a point sees them [Kulla2012]: the
/// density goes with 1/r^2, as the light of a light there does.
class EquiangularDistances {
 public:
  /// None without a point, nor where it lies on the ray's line.
  static std::optional<EquiangularDistances> towards(const std::optional<LightPoint>& point, const Ray& ray,
                                                     const Interval& interval);
  /// The distance, m, that a uniform number in [0, 1) yields.
  double draw(double u) const;
  /// The density of distances, 1/m, within the interval.
  double pdf(double t) const {
    const double along = t - closest_;
    return beside_ / (angle_ * (beside_ * beside_ + along * along));
  }

 private:
  double t0_ = 0.0, t1_ = 0.0;  // of the interval, m
  double closest_ = 0.0;        // where the ray passes the point, m
  double beside_ = 0.0;         // how far from it, m, > 0
  double angle_ = 0.0;          // under which the point sees the interval, > 0
};

/// Distances with the density of what reaches the eye if light is the same everywhere: the mixture over channels of the
/// densities Tr(t) sigma_t(t) / (1 - Tr), each with the share that its channel has in all of that light.
class AttenuatedDistances {
 public:
  /// In a medium of extinction `sigma_t`, 1/m at density 1, walked by `density integrals`, which must outlive this.
  /// `weight`, of each channel, is what light scattered along a metre of density integral at the eye counts for: >= 0,
  /// and 0 where sigma_t is.
  AttenuatedDistances(const DensityIntegralsAlong& integrals, const Rgb& sigma_t, const Rgb& weight);
  /// Is there nothing to draw: no density, or no weight?
  bool empty() const { return !(total_ > 0.0); }
  /// The distance, m, that a uniform number in [0, 1) yields.
  double draw(double u) const;
  /// The density of distances, 1/m, at such a place of the density integrals.
  double pdf(const DensityIntegralsAlong::Place& place) const {
    return place.density * glm::dot(weight_, glm::exp(-sigma_t_ * place.integral)) / total_;
  }

 private:
  const DensityIntegralsAlong& integrals_;
  Rgbd sigma_t_, weight_;
  Rgbd share_{0.0};     // of each channel in the total
  double total_ = 0.0;  // integral of density times weight times transmittance, m
};

}  // namespace vpm
