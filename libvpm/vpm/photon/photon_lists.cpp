// Two recorders that keep all.
#include "vpm/photon/photon_lists.h"

#include "vpm/base/counters.h"

namespace vpm {

PhotonLists list_photons(const Scene& scene, const DistanceStrategy& strategy, const ListSettings& settings) {
  const auto keeps = [](bool direct) { return direct ? any_photon : indirect_photon; };
  CollisionRecorder collisions(scene, settings.volume_form, {settings.density_floor, true},
                               keeps(settings.direct_collisions));
  HitRecorder hits(scene, keeps(settings.direct_hits), HitUse::surface_map);
  Progress silent("photons", 0, false);
  PhotonLists lists;
  lists.ledger = trace_photons(scene, strategy, settings, {&collisions, &hits}, silent);
  count(lists.ledger.floored, collisions.floored);
  lists.volume = std::move(collisions.photons);
  lists.surface = std::move(hits.photons);
  return lists;
}

}  // namespace vpm
