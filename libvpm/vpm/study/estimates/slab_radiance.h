// Radiance and fluence in slabs, by the path tracer and by photons.
#pragma once

#include "vpm/study/estimates/photon_rays.h"
#include "vpm/study/estimates/slab.h"

namespace vpm {

/// A ray out of the slab: the cosine of its exit to the normal, and the side it leaves to.
struct SlabExit {
  double mu = 1.0;  // in (0, 1]
  bool below = false;
};

/// What the radiance at exits, W/(m^2 sr), and the fluence at depths, W/m^2, is estimated with: one sample is a path to
/// each of them.
struct SlabRadiances {
  std::vector<Moments> exits, fluences;
};

/// Under an irradiance of 1 W/m^2. Parallel light is invisible to paths: what has not scattered counts under diffuse
/// light only.
SlabRadiances estimate_slab_radiance(const Slab& slab, const std::vector<SlabExit>& exits,
                                     const std::vector<double>& depths, uint64_t samples, uint64_t seed);

/// A range of cosines in [0.5, 1] of the light that leaves to one side.
struct SlabRange {
  double from = 0.5, to = 1.0;
  bool below = false;
};

/// The radiance at exits with cosines of 0.5 and more, W/(m^2 sr), and the flux in ranges of them, W/m^2, under
/// parallel light of an irradiance of 1 W/m^2.
struct SlabSights {
  std::vector<RadianceByPhotons> exits, fluxes;
};

/// By photons that are gathered along rays. The slab's mirrors are close, so that most photons come near the rays,
/// which keep away from them.
SlabSights estimate_slab_radiance_by_photons(const Slab& slab, const std::vector<SlabExit>& exits,
                                             const std::vector<SlabRange>& ranges, const PhotonRays& by);

/// The fluence at a depth of the light that has not scattered, W/m^2, by direct light sampling.
Moments estimate_unscattered_fluence(const Slab& slab, double depth, uint64_t samples, uint64_t seed);

}  // namespace vpm
