// Distances along a ray at which to look for single scattering.
#pragma once

#include <optional>

#include "vpm/light/light.h"
#include "vpm/medium/density_integrals_along.h"

namespace vpm {

/// Distances along an interval of a ray, uniform in the angle at which they are seen from a point [Kulla2012]. Their
/// density is proportional to 1/r^2, r being the distance from the point, like the light that a light at the point
/// sends there.
class EquiangularDistances {
 public:
  /// Returns nothing where there is no point, or where the point lies on the line of the ray.
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
  double closest_ = 0.0;        // projection of the point onto the ray, m
  double beside_ = 0.0;         // perpendicular distance of the point, m, > 0
  double angle_ = 0.0;          // at which the interval is seen from the point, > 0
};

/// Distances with the density of the light that would reach the eye if light were the same everywhere. It is a mixture
/// over channels of the densities Tr(t) sigma_t(t) / (1 - Tr). Each is weighted by the fraction of that light which is
/// in its channel.
class AttenuatedDistances {
 public:
  /// `integrals`, which must outlive this, are those of a medium of extinction `sigma_t`, 1/m at density 1. `weight`
  /// says, for each channel, how much the light counts that is scattered per metre of density integral right at the
  /// eye: >= 0, and 0 where sigma_t is 0.
  AttenuatedDistances(const DensityIntegralsAlong& integrals, const Rgb& sigma_t, const Rgb& weight);
  /// Is there nothing to draw: no density, or no weight?
  bool empty() const { return !(total_ > 0.0); }
  /// The distance, m, that a uniform number in [0, 1) yields.
  double draw(double u) const;
  /// The density of distances, 1/m, at that place of `integrals`.
  double pdf(const DensityIntegralsAlong::Place& place) const {
    return place.density * glm::dot(weight_, glm::exp(-sigma_t_ * place.integral)) / total_;
  }

 private:
  const DensityIntegralsAlong& integrals_;
  Rgbd sigma_t_, weight_;
  Rgbd share_{0.0};     // the fraction of each channel in the total
  double total_ = 0.0;  // integral of density times weight times transmittance, m
};

}  // namespace vpm
