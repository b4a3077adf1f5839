// A photon map of either kind, ready to be gathered from.
#pragma once

#include <variant>

#include "vpm/estimate/gather.h"
#include "vpm/photon/nearest_map.h"
#include "vpm/photon/radius_map.h"

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

}  // namespace vpm
