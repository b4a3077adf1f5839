// The coefficients of volume estimates, defined only here: the power with which a photon is stored, and the factor for
// sums over stored photons. This way albedo and densities are each applied once.
//
// Photons are stored at collisions, and the density of collisions is sigma_t times fluence. The source of radiance is
// sigma_s times the angular density of fluence. The quotient is the albedo sigma_s / sigma_t. With the density at the
// query there is one more factor: the density at the query over that at the photon. Densities are taken relative to the
// medium's largest, so that powers fit into floats whatever the scale of densities.
#pragma once

#include <algorithm>

#include "vpm/medium/medium.h"
#include "vpm/photon/photon.h"

namespace vpm {

/// The stored power of a photon that carries the power `flux` (W) and collides where the density, relative to the
/// medium's largest, is `density`. It is `flux` for the density at the photon, and flux / density for the density at
/// the query. The latter is bounded by `floor` in [0, 1], the least density to divide by. What that takes away where
/// the density is below the floor, photons that are stored along flights add (CollisionRecorder).
inline Rgb stored_power(const Rgb& flux, VolumeForm form, float density, float floor) {
  return form == VolumeForm::density_at_query ? flux / std::max(density, floor) : flux;
}

/// A density relative to the medium's largest: the factor in the estimate with the density at the query.
inline float relative_density(const Medium& medium, float density) { return density / medium.max_density(); }

/// The floor of relative densities that is used where `floor` is asked for: no more than the mean of what the medium
/// holds. So there are no more photons along flights than there would be collisions in an even medium, however much
/// denser a few voxels are.
inline float floor_in(const Medium& medium, float floor) {
  return std::min(floor, relative_density(medium, static_cast<float>(medium.mean_of_stored())));
}

/// The factor that turns a sum of stored powers times phase function and kernel into the source of radiance, W/(m^3
/// sr): the albedo. With the density at the query, the relative density there is one more factor.
inline Rgb source_factor(const Medium& medium) { return medium.albedo(); }

}  // namespace vpm
