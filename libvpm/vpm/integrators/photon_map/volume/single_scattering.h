// Single scattering along a segment of an eye ray: light that points of a medium receive straight from a light, one
// shadow ray each, at points of a march or at a few distances that are drawn.
#pragma once

#include <memory>
#include <optional>

#include "vpm/estimate/eye_segment.h"
#include "vpm/integrators/photon_map/estimator.h"
#include "vpm/light/light.h"
#include "vpm/medium/grid/density_integrals_along.h"
#include "vpm/path/direct_light.h"

namespace vpm {

/// A light, and a point of it where one is drawn beforehand.
struct LightSource {
  PickedLight picked;
  std::optional<LightPoint> from;
};

/// Single scattering at points, by one shadow ray each.
class ScatteredOnce {
 public:
  ScatteredOnce(const Scene& scene, std::shared_ptr<const TransmittanceEstimator> transmittance)
      : scene_(scene), transmittance_(std::move(transmittance)) {}

  /// Picks a light by power, and draws a point of it where it has points.
  LightSource draw(Rng& rng) const;
  /// Picks a light by power.
  LightSource pick(Rng& rng) const { return {pick_light(scene_, rng.uniform_double()), {}}; }
  /// What the light sends to a point of the segment, scattered there towards the eye: irradiance times phase function
  /// over the probability to pick that light, W/(m^2 sr).
  Rgb towards_eye(const LightSource& light, const EyeSegment& segment, const Vec3& point, EyeWork& work) const;

 private:
  const Scene& scene_;
  std::shared_ptr<const TransmittanceEstimator> transmittance_;
};

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

/// Single scattering along a segment of an eye ray, found at a few distances. Each is drawn either equiangularly
/// towards the light, or with the density of what scatters and reaches the eye. MIS weights combine the two.
///
/// Draws pairs of distances, each pair with a point of a light of its own. Where there is such a point, one distance of
/// the pair is equiangular [Kulla2012], and the MIS weights of both are those of the balance heuristic [Veach1997,
/// ch. 9].
class SingleEquiangular final : public VolumeEstimator {
 public:
  /// `pairs` >= 1, on each segment.
  SingleEquiangular(const Scene& scene, std::shared_ptr<const TransmittanceEstimator> transmittance, int pairs)
      : light_(scene, std::move(transmittance)), pairs_(pairs) {}

  ScatteredLight finds() const override { return {.once = true}; }
  KernelEstimate along(const EyeSegment& segment, EyeWork& work) const override;

 private:
  ScatteredOnce light_;
  int pairs_;
};

}  // namespace vpm
