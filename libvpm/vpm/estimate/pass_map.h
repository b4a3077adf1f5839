// How photon maps change from pass to pass, and how they are made in one.
#pragma once

#include "vpm/estimate/photon_map.h"
#include "vpm/estimate/statistics.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// What the maps of a pass go by.
struct PassOfMaps {
  int number = 0;                // from 0
  bool shrinks = true;           // do radii shrink from pass to pass?
  uint32_t photons_in_cube = 0;  // > 0: control_density()
};

/// Radii that nothing is known of: their shares of the diagonal of the medium's bounds (grids) or of the scene. The
/// second where gathers go by count, and the radius only bounds them.
inline constexpr float kDefaultRadius = 0.01f, kDefaultSearch = 0.1f;
/// The radius of a map in the first pass, m: the one that is given, or such a share of the diagonal.
float first_radius(const AskedGather& gather, const Scene& scene);
float first_radius(const AskedGather& gather, const Scene& scene, const Medium& medium);

/// Does the radius go by the pass? Not the largest radius of the nearest mode.
bool shrinks(const AskedGather& gather, const PassOfMaps& pass);
/// The settings of a map in the pass, for its first radius (m) and the dimension of its kernel.
GatherSettings gather_in_pass(const AskedGather& gather, float first_radius, int dimension, const PassOfMaps& pass);

/// Merges photons where the pass asks for that, for gathers by that radius.
void merge_photons(std::vector<Photon>& photons, const GatherSettings& gather, const PassOfMaps& pass,
                   RenderStatistics& statistics);
/// A map of photons of which that many were emitted; takes them.
PhotonMap make_map(std::vector<Photon>& photons, const GatherSettings& gather, uint64_t emitted, const PassOfMaps& pass,
                   RenderStatistics& statistics);

}  // namespace vpm
