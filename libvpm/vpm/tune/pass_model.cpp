// Sums over passes whose radii shrink.
#include "vpm/tune/pass_model.h"

#include <algorithm>
#include <cmath>

#include "vpm/estimate/radius_schedule.h"

namespace vpm {

double PassModel::error(double passes, double photons, double radii, const RenderSettings& settings) const {
  constexpr int kDimension = 2, kMostSummed = 2000;
  const int order = kernel_order(settings.volume.kernel), n = static_cast<int>(std::min(passes, double{kMostSummed}));
  const bool shrinks = settings.radii != RadiusSchedule::constant;
  double of_photons = 0.0, bias = 0.0, measure = 1.0;  // summed over passes, relative to those of the first
  const double a = best_a(kDimension, order), power = 0.5 * kPowerOfBias / kDimension;
  for (int pass = 0; pass < n; ++pass) {
    if (pass > 0 && shrinks) measure *= (pass + a) / (pass + 1.0);
    of_photons += 1.0 / measure;
    bias += std::pow(measure, power);
  }
  if (shrinks) {  // measures go on as a power of the number of passes
    of_photons *= std::pow(passes / n, 1.0 - a);
    bias *= std::pow(passes / n, power * (a - 1.0));
  }
  const double noise_of_photons = photons > 0.0 ? noise.by / photons * std::pow(radii, -power_of_noise) : 0.0;
  return (noise.at + unseen) / passes + noise_of_photons * of_photons / (n * passes) +
         bias2 * std::pow(radii, kPowerOfBias) * (bias / n) * (bias / n);
}

}  // namespace vpm
