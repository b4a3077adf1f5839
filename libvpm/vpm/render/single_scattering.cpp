// Distances for single scattering.
#include "vpm/render/single_scattering.h"

#include <algorithm>
#include <cmath>

#include "vpm/render/march.h"

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

AttenuatedDistances::AttenuatedDistances(const ColumnsAlong& columns, const Rgb& sigma_t, const Rgb& weight)
    : columns_(columns), sigma_t_(sigma_t), weight_(weight) {
  for (int c = 0; c < 3; ++c)
    if (weight_[c] > 0.0) share_[c] = weight_[c] * attenuated_column(sigma_t_[c], columns.column());
  total_ = share_.r + share_.g + share_.b;
  share_ /= total_;
}

double AttenuatedDistances::draw(double u) const {
  int channel = 0;
  for (; channel < 2 && u >= share_[channel]; ++channel) u -= share_[channel];
  while (share_[channel] == 0.0) --channel;  // rounding led past the last one
  const double within = std::clamp(u / share_[channel], 0.0, 1.0 - 1e-15);
  return columns_.where(draw_attenuated(sigma_t_[channel], columns_.column(), within));
}

Rgb single_scattering(const EyeContext& context, const EyeSegment& segment, Rng& rng, EyeCounters& counters) {
  static thread_local ColumnsAlong columns;
  const auto& [ray, whole, number, throughput] = segment;
  const Medium& medium = context.scene.media[number];
  const Interval interval = medium.clip(ray, whole);
  if (interval.empty()) return Rgb(0.0f);
  count(counters.walk.lookups, columns.walk(&medium, ray, interval));
  const Rgb weight = throughput * medium.sigma_s;
  const AttenuatedDistances attenuated(columns, medium.sigma_t, weight);
  if (attenuated.empty()) return Rgb(0.0f);
  const int pairs = context.settings.direct_samples;
  Rgb sum(0.0f);
  for (int pair = 0; pair < pairs; ++pair) {
    const PickedLight picked = pick_light(context.scene, rng.uniform_double());
    const auto from = draw_light_point(context.scene.lights[picked.number], rng);
    const auto equiangular = EquiangularDistances::towards(from, ray, interval);
    for (const int which : {0, 1}) {
      // Numbers of all pairs are stratified: by technique, or where there is but one all together.
      const double u = rng.uniform_double(), alone = (2 * pair + which + u) / (2 * pairs), beside = (pair + u) / pairs;
      const double drawn = !equiangular ? attenuated.draw(alone)
                           : which == 0 ? equiangular->draw(beside)
                                        : attenuated.draw(beside);
      const auto t = static_cast<float>(drawn);  // as the point is
      const ColumnsAlong::Place place = columns.at(t);
      if (!(place.density > 0.0)) continue;
      const double by_attenuation = attenuated.pdf(place);
      const double pdf = by_attenuation + (equiangular ? equiangular->pdf(t) : by_attenuation);  // of both together
      const Rgb seen(Rgbd(weight) * glm::exp(-Rgbd(medium.sigma_t) * place.column) * place.density / pdf);
      if (is_black(seen)) continue;
      sum += seen * scattered_light(context, {picked, from}, {ray.at(t), number}, ray.direction, rng, counters);
    }
  }
  return sum / static_cast<float>(pairs);
}

}  // namespace vpm
