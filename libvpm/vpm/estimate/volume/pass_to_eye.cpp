// Loops over places on a ray.
#include "vpm/estimate/volume/pass_to_eye.h"

#include "vpm/photon/stored_power.h"

namespace vpm {
namespace {

/// beam_transmittance() along a ray through a homogeneous medium.
void pass_homogeneous(const Rgb& sigma_t, const Mirrored& mirrored, std::span<const float> distances, Passed& passed) {
  const auto [t0, t1] = mirrored;
  if (is_grey(sigma_t)) {
    const float sigma = sigma_t.r;
    for (size_t i = 0; i < distances.size(); ++i)
      passed.r[i] = passed.g[i] = passed.b[i] = exp_negative(-sigma * (Mirrored{t0, t1}(distances[i]) - t0));
    return;
  }
  const Rgb sigma = sigma_t;
  for (size_t i = 0; i < distances.size(); ++i) {
    const Rgb kept = beam_transmittance(sigma, Mirrored{t0, t1}(distances[i]) - t0);
    passed.r[i] = kept.r;
    passed.g[i] = kept.g;
    passed.b[i] = kept.b;
  }
}

/// beam_transmittance() from places on a ray through a grid; times the relative density there, for the density at the
/// query.
void pass_grid(const DensityIntegralsAlong& integrals, const Medium& medium, VolumeForm form, const Mirrored& mirrored,
               std::span<const float> distances, Passed& passed) {
  float integral[PhotonBatch::kMost], density[PhotonBatch::kMost];
  for (size_t i = 0; i < distances.size(); ++i) {
    const DensityIntegralsAlong::Place place = integrals.at(mirrored(distances[i]));
    integral[i] = static_cast<float>(place.integral);
    density[i] =
        form == VolumeForm::density_at_query ? relative_density(medium, static_cast<float>(place.density)) : 1.0f;
  }
  for (size_t i = 0; i < distances.size(); ++i) {
    const Rgb kept = beam_transmittance(medium.sigma_t, integral[i]) * density[i];
    passed.r[i] = kept.r;
    passed.g[i] = kept.g;
    passed.b[i] = kept.b;
  }
}

}  // namespace

void pass_to_eye(const Medium& medium, const DensityIntegralsAlong* integrals, VolumeForm form,
                 const Mirrored& mirrored, std::span<const float> distances, Passed& passed) {
  if (integrals)
    pass_grid(*integrals, medium, form, mirrored, distances, passed);
  else
    pass_homogeneous(medium.sigma_t, mirrored, distances, passed);
}

}  // namespace vpm
