// The coefficient factor of volume estimates, its one home: what a photon is stored with, and what sums over stored
// photons are multiplied by, so that albedo and densities are each applied once.
//
// Photons are stored at collisions, whose density is sigma_t times fluence. The source of radiance is sigma_s times the
// fluence's angular density, which leaves the albedo sigma_s / sigma_t; and for the density at the query the density
// there over that at the photon. Densities are taken relative to the medium's largest: powers then fit into floats
// whatever the scale of densities.
#pragma once

#include <algorithm>

#include "vpm/medium/medium.h"
#include "vpm/photon/photon.h"

namespace vpm {

/// What a photon of flux `flux` (W) that collides where the density is `density`, over the medium's largest, is stored
/// with: the flux (density at the photon) or the flux over that density (density at the query). A floor in [0, 1], the
/// least to divide by, bounds the latter; what is thinner than the floor then scatters less, by density / floor.
inline Rgb stored_power(const Rgb& flux, VolumeForm form, float density, float floor) {
  return form == VolumeForm::density_at_query ? flux / std::max(density, floor) : flux;
}

/// A density over the medium's largest: what the estimate with the density at the query has as a factor.
inline float relative_density(const Medium& medium, float density) { return density / medium.max_density(); }

/// What a sum of stored powers times phase function and kernel is multiplied by to be the source of radiance, W/(m^3
/// sr): the albedo; for the density at the query the relative density there is one more factor.
inline Rgb source_factor(const Medium& medium) { return medium.albedo(); }

}  // namespace vpm
