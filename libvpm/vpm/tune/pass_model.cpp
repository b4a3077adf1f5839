// Sums over passes whose radii shrink.
#include "vpm/tune/pass_model.h"

#include <algorithm>
#include <cmath>

#include "vpm/estimate/radius_schedule.h"

namespace vpm {

Line rising_line(std::span<const Measured> values) {
  double w = 0.0, x = 0.0, xx = 0.0, y = 0.0, xy = 0.0;  // weighted sums, of relative values
  for (const Measured& value : values) {
    if (!(value.y > 0.0)) continue;
    w += value.weight / (value.y * value.y);
    x += value.weight * value.x / (value.y * value.y);
    xx += value.weight * value.x * value.x / (value.y * value.y);
    y += value.weight / value.y;
    xy += value.weight * value.x / value.y;
  }
  if (w == 0.0) return {};
  const double spread = w * xx - x * x;
  const double by = spread > 1e-9 * w * xx ? (w * xy - x * y) / spread : 0.0;
  if (by <= 0.0) return {y / w, 0.0};
  const double at = (y - by * x) / w;
  return at >= 0.0 ? Line{at, by} : Line{0.0, xy / xx};
}

double PassModel::seconds(double photons, double radii) const {
  return making(photons) + seeing(radii * radii * photons);
}

double PassModel::error(double passes, double photons, double radii, const RenderSettings& settings) const {
  constexpr int kDimension = 2, kMostSummed = 2000;
  const int order = kernel_order(settings.volume.kernel), n = static_cast<int>(std::min(passes, double{kMostSummed}));
  const bool shrinks = settings.radii != RadiusSchedule::constant;
  double of_photons = 0.0, bias = 0.0, measure = 1.0;  // summed over passes, relative to those of the first
  for (int pass = 0; pass < n; ++pass) {
    if (pass > 0 && shrinks) measure *= (pass + best_a(kDimension, order)) / (pass + 1.0);
    of_photons += 1.0 / measure;
    bias += std::pow(measure, 0.5 * kPowerOfBias / kDimension);
  }
  const double noise_of_photons = photons > 0.0 ? noise.by / photons * std::pow(radii, -power_of_noise) : 0.0;
  return (noise.at + unseen) / passes + noise_of_photons * of_photons / (n * passes) +
         bias2 * std::pow(radii, kPowerOfBias) * (bias / n) * (bias / n);
}

}  // namespace vpm
