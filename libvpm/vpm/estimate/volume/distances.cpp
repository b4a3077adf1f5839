// Draws and densities.
#include "vpm/estimate/volume/distances.h"

#include <algorithm>
#include <cmath>

#include "vpm/estimate/volume/march.h"

namespace vpm {

std::optional<EquiangularDistances> EquiangularDistances::towards(const std::optional<LightPoint>& point,
                                                                  const Ray& ray, const Interval& interval) {
  if (!point) return std::nullopt;
  EquiangularDistances d;
  const Vec3d to_point = Vec3d(point->position) - Vec3d(ray.origin), direction(ray.direction);
  d.t0_ = interval.t0;
  d.t1_ = interval.t1;
  d.closest_ = glm::dot(to_point, direction);
  d.beside_ = glm::length(to_point - d.closest_ * direction);
  const double a = d.t0_ - d.closest_, b = d.t1_ - d.closest_;
  // The difference of the ends' angles, with all its digits where that is small.
  d.angle_ = std::isinf(b) ? std::atan2(d.beside_, a) : std::atan2(d.beside_ * (b - a), d.beside_ * d.beside_ + a * b);
  if (!(d.beside_ > 0.0 && d.angle_ > 0.0)) return std::nullopt;
  return d;
}

double EquiangularDistances::draw(double u) const {
  // beside tan(angle of t0 + u angle) [Kulla2012] less the same for u = 0, without their cancellation.
  const double a = t0_ - closest_, part = u * angle_;
  const double past = (beside_ * beside_ + a * a) * std::sin(part) / (beside_ * std::cos(part) - a * std::sin(part));
  return std::min(t0_ + past, t1_);
}

AttenuatedDistances::AttenuatedDistances(const DensityIntegralsAlong& integrals, const Rgb& sigma_t, const Rgb& weight)
    : integrals_(integrals), sigma_t_(sigma_t), weight_(weight) {
  for (int c = 0; c < 3; ++c)
    if (weight_[c] > 0.0) share_[c] = weight_[c] * attenuated_integral(sigma_t_[c], integrals.integral());
  total_ = share_.r + share_.g + share_.b;
  share_ /= total_;
}

double AttenuatedDistances::draw(double u) const {
  int channel = 0;
  for (; channel < 2 && u >= share_[channel]; ++channel) u -= share_[channel];
  while (share_[channel] == 0.0) --channel;  // rounding led past the last one
  const double within = std::clamp(u / share_[channel], 0.0, 1.0 - 1e-15);
  return integrals_.where(draw_attenuated(sigma_t_[channel], integrals_.integral(), within));
}

}  // namespace vpm
