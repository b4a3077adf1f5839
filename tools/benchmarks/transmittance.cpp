// Transmittance estimators along rays through the whole cloud.
#include "vpm/medium/transmittance/estimator.h"

#include "benchmarks/bench.h"
#include "benchmarks/cloud.h"

namespace vpm::bench {

void measure_transmittance(Bench& bench, const Sizes&) {
  const CloudRays rays = cloud_rays(20'000);
  const Medium medium = cloud_medium();
  // One sample a ray: the noisiest sums err by about 1 %.
  Comparison comparison{
      "Transmittance, cloud of 256^3", "ray", static_cast<double>(rays.rays.size()), 0.05, Clock::processor, {}};
  for (const EstimatorInfo& info : transmittance_estimators()) {
    TransmittanceSettings settings;
    settings.estimator = info.name;
    const std::shared_ptr<const TransmittanceEstimator> estimator = make_transmittance_estimator(settings);
    comparison.alternatives.push_back(
        {"vpm, " + std::string(info.name), [estimator, &medium, &rays] {
           double sum = 0.0;
           for (size_t i = 0; i < rays.rays.size(); ++i) {
             Rng rng(1, rng_stream(RngUse::photon, 0), i);
             sum += estimator->estimate(medium, rays.rays[i], {0.0f, rays.length}, rng).value.r;
           }
           return sum;
         }});
  }
  bench.compare(comparison);
}

}  // namespace vpm::bench
