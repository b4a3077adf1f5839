// The photons of a pass as plain lists: for studies of photons, and for comparing photon maps with brute force.
#pragma once

#include "vpm/photon/records.h"
#include "vpm/photon/trace.h"

namespace vpm {

/// How photons are traced, and which of them are listed.
struct ListSettings : TraceSettings {
  VolumeForm volume_form = VolumeForm::density_at_query;
  float density_floor = 0.0f;                         // density at the query: see CollisionRecorder
  bool direct_collisions = true, direct_hits = true;  // also list photons that have not scattered yet
};

/// The listed photons. Their powers are not yet divided by `ledger.emitted_count`.
struct PhotonLists {
  std::vector<std::vector<Photon>> volume;  // photons that collided, by medium
  std::vector<Photon> surface;              // photons on non-specular surfaces
  Ledger ledger;
};

PhotonLists list_photons(const Scene& scene, const DistanceStrategy& strategy, const ListSettings& settings);

}  // namespace vpm
