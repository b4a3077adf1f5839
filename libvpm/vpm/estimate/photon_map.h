// A photon map of either kind, ready to be gathered from: how the maps of one pass are made, and how their radii change
// from pass to pass.
#pragma once

#include <variant>

#include "vpm/estimate/gather.h"
#include "vpm/estimate/statistics.h"
#include "vpm/photon/map/nearest_map.h"
#include "vpm/photon/map/radius_map.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// Is a sum over so many nearest photons, of which the powers alone count, made of whole nodes (nearest_sums.h)? At
/// borders the place of each counts, too.
template <class Radius>
bool sums_by_nodes(const GatherRule<Radius>& gather) {
  return gather.mode == GatherMode::nearest && gather.count >= NearestMap::kMany &&
         gather.kernel == KernelKind::epanechnikov && gather.boundary == BoundaryRule::none;
}

/// Photons sorted for the gathering of one pass, powers divided by the photons emitted.
struct PhotonMap {
  GatherSettings settings;  // radius > 0, as it is in this pass
  std::variant<RadiusMap, NearestMap> index;

  /// Prepares the sums of sums_by_nodes(), where the settings ask for such. Returns how many bytes that takes.
  size_t prepare_sums_by_nodes();

  size_t size() const;
  const Box& bounds() const;
  size_t memory_bytes() const;
};

/// The counters of the gathers of one thread, and the memory that they work in.
struct GatherWork {
  GatherCounters& counters;
  Neighbours& neighbours;  // of the last search by count
};

/// A view of a photon map that counts its gathers. Its settings may differ from those of the map in radius and kernel,
/// but not in mode.
struct CountedMap {
  const PhotonMap& map;
  GatherWork work;
  const GatherSettings& settings = map.settings;
};

/// Builds the map that the settings ask for. `emitted` > 0.
PhotonMap make_photon_map(std::vector<Photon> photons, const GatherSettings& settings, uint64_t emitted);

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
