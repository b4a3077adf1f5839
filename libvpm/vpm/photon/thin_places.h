// Photons along flights, where a grid is so thin that they collide too seldom.
#pragma once

#include <algorithm>
#include <cmath>

#include "vpm/base/cancel.h"
#include "vpm/medium/distance/mixture.h"
#include "vpm/path/walk.h"
#include "vpm/photon/stored_power.h"

namespace vpm {

/// Where a grid is so thin that photons are also stored along flights.
struct ThinParts {
  float density_floor;  // the density below which it is, in [0, 1], relative to the medium's largest: see floor_in()
  bool where_empty;     // also where the density is 0, unless a whole brick of the grid is empty?
};

/// Calls visit(t) at places of a flight, m, where its medium is thinner than the floor: with collisions there are then
/// as many as there would be collisions in a medium of the floor's density, in the channel of the largest extinction.
/// Candidates are evenly spaced, from a random place on; of these a fraction 1 - density/floor counts.
template <class Visit>
void visit_thin_places(const Medium& medium, const Track& track, const ThinParts& thin, Rng& rng, Visit&& visit) {
  if (!medium.grid || !medium.scatters()) return;
  const float floor = floor_in(medium, thin.density_floor);
  const double spacing = 1.0 / (double{floor} * max_channel(medium.majorant()));  // m
  const double first = rng.uniform_double() * spacing;                            // m
  if (!(first < track.interval.t1)) return;
  medium.visit_majorants(track.ray, track.interval, [&](const DensityStretch& stretch) {
    if (relative_density(medium, stretch.min) >= floor) return true;
    for (double i = std::ceil((stretch.t0 - first) / spacing); first + i * spacing < stretch.t1; ++i) {
      cancellation_point();
      const double t = first + i * spacing;
      const float density = relative_density(medium, stretch.density(t));
      if (density == 0.0f && !thin.where_empty) continue;
      if (rng.uniform() * floor >= density) visit(t);
    }
    return true;
  });
}

/// The power with which a photon is stored at such a place, the density integral up to which is given: that of a
/// collision there, over the floor.
inline Rgb power_along(const Medium& medium, const Track& track, double integral, const ThinParts& thin) {
  const Rgb flux = track.throughput / floor_in(medium, thin.density_floor);
  if (is_grey(medium.sigma_t)) return flux;
  const Rgb relative = medium.sigma_t / max_channel(medium.sigma_t);  // first: coefficients may be as large as floats
  return flux * relative * analog_weight(medium, channel_shares(track.throughput), integral, false);
}

}  // namespace vpm
