// What happens to photons in a plane-parallel slab without sides: where they leave it, and where they are absorbed.
#pragma once

#include <vector>

#include "vpm/base/statistics/moments.h"
#include "vpm/medium/distance/strategy.h"
#include "vpm/scene/scene.h"
#include "vpm/study/estimates/layers.h"

namespace vpm {

/// How light falls on the slab: along its normal, or with the same radiance from the whole hemisphere.
enum class Incidence { collimated, diffuse };

/// A slab that is lit from above.
struct Slab {
  Layers layers;
  double albedo = 1.0;
  double g = 0.0;  // of Henyey and Greenstein's phase function
  Incidence incidence = Incidence::collimated;
};

/// A slab 1 m thick of the same extinction everywhere.
Slab homogeneous_slab(double optical_thickness, double albedo, double g, Incidence incidence);

/// Light for photons, which all fall on a square metre or less, or for rays towards it, which come from everywhere.
/// What leaves a slab without sides is the same for both: 1 W on a spot, summed over the top; or 1 W/m^2, at any point.
enum class SlabLight { spot, everywhere };

/// How far away the mirrors that close a slab's sides are, in thicknesses.
inline constexpr double kFarMirrors = 1e3;

/// The slab between y = 0 and y = -thickness. Throws InputError where the nodes of a part without jumps lie on no
/// common lattice, so that no grid can represent the extinction exactly.
///
/// Mirrors so many thicknesses away close the slab's sides: what is reflected there comes from an equal slab beyond, so
/// that sums over the top, and radiance under even light, are those of an endless slab. Far mirrors are so far away
/// that few photons get there, and cut only those rays towards the light that make less than 1e-3 rad with the
/// horizontal after crossing the whole slab.
Scene slab_scene(const Slab& slab, SlabLight light, double mirrors = kFarMirrors);

/// What to tally besides reflectance and transmittance.
struct SlabTallies {
  std::vector<double> mu_edges;  // ascending from 0 to 1: bins of the cosine of exit
  std::vector<double> planes;    // m, ascending depths: fluxes at them, absorption and collisions between them
};

/// Powers over the incident one; a sample is a photon.
struct SlabEstimate {
  Moments reflected, transmitted, absorbed;
  Moments unscattered;                                // part of the transmitted
  Moments lost;                                       // through the sides, or by the limit of events
  Moments collisions;                                 // the power that collides, each time
  std::vector<Moments> reflected_at, transmitted_at;  // scattered, by bin of the cosine of exit
  std::vector<Moments> net_flux;                      // downwards at the planes
  std::vector<Moments> absorbed_between, collisions_between;
};

SlabEstimate estimate_slab(const Slab& slab, const DistanceStrategy& strategy, const SlabTallies& tallies,
                           uint64_t photons, uint64_t seed);

}  // namespace vpm
