// How the radii of photon maps change from pass to pass, and how the maps of one pass are made.
#pragma once

#include "vpm/estimate/photon_map.h"
#include "vpm/estimate/statistics.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// The boxes around photons, by medium, m.
using MediaBounds = std::vector<Box>;

/// What the maps of a pass depend on.
struct PassOfMaps {
  int number = 0;                       // from 0
  bool shrinks = true;                  // do radii shrink from pass to pass?
  uint32_t photons_in_cube = 0;         // > 0: control_density()
  const MediaBounds* around = nullptr;  // all photons of the pass, of which the maps hold a block; null: they hold all
};

/// Default radii, as fractions of the medium's extent (grids) or of the scene's diagonal. kDefaultSearch is for
/// gathers by count, where the radius is only the largest allowed.
inline constexpr float kDefaultRadius = 0.01f, kDefaultSearch = 0.1f;
/// The radius of a map in the first pass, m: the one that is given, or the default fraction of the diagonal.
float first_radius(const AskedGather& gather, const Scene& scene);
float first_radius(const AskedGather& gather, const Scene& scene, const Medium& medium);

/// Does the radius shrink from pass to pass? The largest radius of the nearest mode does not.
bool shrinks(const AskedGather& gather, const PassOfMaps& pass);
/// The settings of a map in the pass, for its first radius (m) and the dimension of its kernel.
GatherSettings gather_in_pass(const AskedGather& gather, float first_radius, int dimension, const PassOfMaps& pass);

/// Merges photons where the pass asks for it, for gathers with the radius of `gather`.
void merge_photons(std::vector<Photon>& photons, const GatherSettings& gather, const PassOfMaps& pass,
                   RenderStatistics& statistics);
/// Makes a map of the photons, and takes them. `emitted` is the number of photons emitted.
PhotonMap make_map(std::vector<Photon>& photons, const GatherSettings& gather, uint64_t emitted, const PassOfMaps& pass,
                   RenderStatistics& statistics);

}  // namespace vpm
