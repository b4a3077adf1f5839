// One shadow ray's worth of light, scattered; pairs of distances, their densities, and what is scattered there.
#include "vpm/integrators/photon_map/volume/single_scattering.h"

#include <algorithm>
#include <cmath>

#include "vpm/estimate/march.h"

namespace vpm {

LightSource ScatteredOnce::draw(Rng& rng) const {
  const PickedLight picked = pick_light(scene_, rng.uniform_double());
  return {picked, draw_light_point(scene_.lights[picked.number], rng)};
}

Rgb ScatteredOnce::towards_eye(const LightSource& light, const EyeSegment& segment, const Vec3& point,
                               EyeWork& work) const {
  count(work.counters.shadow_rays);
  const ShadowRays rays{scene_, *transmittance_, work.rng, work.counters.walk};
  const DirectSample sample = sample_direct(rays, light.picked.number, {point, segment.medium}, light.from);
  if (is_black(sample.irradiance)) return Rgb(0.0f);
  const float phase = phase_value(segment.around()->phase, -sample.direction, -segment.ray.direction);
  return sample.irradiance * phase / light.picked.probability;
}

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

KernelEstimate SingleEquiangular::along(const EyeSegment& segment, EyeWork& work) const {
  if (!segment.around()) return Rgb(0.0f);
  const Medium& medium = *segment.around();
  const Interval interval = medium.clip(segment.ray, segment.interval);
  if (!medium.scatters() || interval.empty()) return Rgb(0.0f);
  const DensityIntegralsAlong& integrals = segment.integrals(work);
  const Rgb weight = segment.throughput * medium.sigma_s;
  const AttenuatedDistances attenuated(integrals, medium.sigma_t, weight);
  if (attenuated.empty()) return Rgb(0.0f);
  Rgb sum(0.0f);
  for (int pair = 0; pair < pairs_; ++pair) {
    const LightSource light = light_.draw(work.rng);
    const auto equiangular = EquiangularDistances::towards(light.from, segment.ray, interval);
    for (const int which : {0, 1}) {
      // Numbers of all pairs are stratified: by technique, or where there is but one all together.
      const double u = work.rng.uniform_double();
      const double alone = (2 * pair + which + u) / (2 * pairs_), paired = (pair + u) / pairs_;
      const double drawn = !equiangular ? attenuated.draw(alone)
                           : which == 0 ? equiangular->draw(paired)
                                        : attenuated.draw(paired);
      const auto t = static_cast<float>(drawn);  // as the point is
      const DensityIntegralsAlong::Place place = integrals.at(t);
      if (!(place.density > 0.0)) continue;
      const double by_attenuation = attenuated.pdf(place);
      const double pdf = by_attenuation + (equiangular ? equiangular->pdf(t) : by_attenuation);  // of both together
      const Rgb seen(Rgbd(weight) * glm::exp(-Rgbd(medium.sigma_t) * place.integral) * place.density / pdf);
      if (!is_black(seen)) sum += seen * light_.towards_eye(light, segment, segment.ray.at(t), work);
    }
  }
  return sum / static_cast<float>(pairs_);
}

}  // namespace vpm
