// `mean-extinction`: exponential flights at the mean rate over the medium's bounds, empty voxels included [Jarosz2008,
// sec. 7.4.1].
//
// Known failure: E[w^2] contains exp(-(2 sigma_t - s) d), which grows without bound along any stretch where sigma_t < s
// / 2: in a cloud with thin edges every sample is unbiased and the variance is enormous.
#include "vpm/medium/distance/mixture.h"
#include "vpm/medium/distance/strategies.h"

namespace vpm {

Flight MeanExtinction::sample(const Medium& medium, const Ray& ray, const Interval& interval, const Rgb& power,
                              Rng& rng) const {
  return exponential_flight(medium, ray, interval, medium.sigma_t * static_cast<float>(medium.mean_density()), power,
                            rng);
}

}  // namespace vpm
