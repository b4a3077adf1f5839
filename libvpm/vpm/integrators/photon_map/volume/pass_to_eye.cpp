// Loops over places on a ray.
#include "vpm/integrators/photon_map/volume/pass_to_eye.h"

#include <algorithm>

#include "vpm/photon/stored_power.h"

namespace vpm {

void PassToEye::operator()(std::span<const float> distances, Passed& passed, float* sigma_t) const {
  if (integrals_) return pass_grid(distances, passed, sigma_t);
  pass_homogeneous(distances, passed);
  if (sigma_t) std::fill_n(sigma_t, distances.size(), mean_channel(medium_.sigma_t));
}

void PassToEye::pass_homogeneous(std::span<const float> distances, Passed& passed) const {
  const auto [t0, t1] = mirrored_;
  if (is_grey(medium_.sigma_t)) {
    const float sigma = medium_.sigma_t.r;
    for (size_t i = 0; i < distances.size(); ++i)
      passed.r[i] = passed.g[i] = passed.b[i] = exp_negative(-sigma * (Mirrored{t0, t1}(distances[i]) - t0));
    return;
  }
  const Rgb sigma = medium_.sigma_t;
  for (size_t i = 0; i < distances.size(); ++i) {
    const Rgb kept = beam_transmittance(sigma, Mirrored{t0, t1}(distances[i]) - t0);
    passed.r[i] = kept.r;
    passed.g[i] = kept.g;
    passed.b[i] = kept.b;
  }
}

void PassToEye::pass_grid(std::span<const float> distances, Passed& passed, float* sigma_t) const {
  float integral[PhotonBatch::kMost], factor[PhotonBatch::kMost];
  const float mean = mean_channel(medium_.sigma_t);  // at density 1, 1/m
  for (size_t i = 0; i < distances.size(); ++i) {
    const DensityIntegralsAlong::Place place = integrals_->at(mirrored_(distances[i]));
    const auto density = static_cast<float>(place.density);
    integral[i] = static_cast<float>(place.integral);
    factor[i] = form_ == VolumeForm::density_at_query ? relative_density(medium_, density) : 1.0f;
    if (sigma_t) sigma_t[i] = mean * density;
  }
  for (size_t i = 0; i < distances.size(); ++i) {
    const Rgb kept = beam_transmittance(medium_.sigma_t, integral[i]) * factor[i];
    passed.r[i] = kept.r;
    passed.g[i] = kept.g;
    passed.b[i] = kept.b;
  }
}

}  // namespace vpm
