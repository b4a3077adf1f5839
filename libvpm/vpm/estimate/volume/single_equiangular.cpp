// Pairs of distances, and what is scattered there.
#include "vpm/estimate/volume/single_equiangular.h"

#include "vpm/estimate/volume/distances.h"

namespace vpm {

KernelEstimate SingleEquiangular::along(const EyeSegment& segment, EyeWork& work) const {
  if (!segment.medium()) return Rgb(0.0f);
  const Medium& medium = *segment.medium();
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
