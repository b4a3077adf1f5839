// Radii of passes, and the making of maps.
#include "vpm/estimate/pass_map.h"

#include "vpm/estimate/radius_schedule.h"
#include "vpm/photon/density_control.h"

namespace vpm {
namespace {

float default_share(const AskedGather& gather) { return gather.goes_by_count() ? kDefaultSearch : kDefaultRadius; }

}  // namespace

float first_radius(const AskedGather& gather, const Scene& scene) {
  return gather.radius.is_given() ? gather.radius.metres() : default_share(gather) * scene.bounds.diagonal();
}

float first_radius(const AskedGather& gather, const Scene& scene, const Medium& medium) {
  if (gather.radius.is_given() || !medium.grid) return first_radius(gather, scene);
  return default_share(gather) * static_cast<float>(medium.grid->extent());
}

bool shrinks(const AskedGather& gather, const PassOfMaps& pass) {
  return pass.shrinks && gather.mode != GatherMode::nearest;
}

GatherSettings gather_in_pass(const AskedGather& gather, float first_radius, int dimension, const PassOfMaps& pass) {
  const float radius = shrinks(gather, pass)
                           ? radius_of_pass(first_radius, dimension, pass.number, kernel_order(gather.kernel))
                           : first_radius;
  return {gather.mode, radius, gather.count, gather.kernel, gather.boundary, gather.beam_count};
}

void merge_photons(std::vector<Photon>& photons, const GatherSettings& gather, const PassOfMaps& pass,
                   RenderStatistics& statistics) {
  if (pass.photons_in_cube > 0 && gather.mode != GatherMode::nearest)
    statistics.merged_photons += control_density(photons, 0.5f * gather.radius, pass.photons_in_cube);
}

PhotonMap make_map(std::vector<Photon>& photons, const GatherSettings& gather, uint64_t emitted, const PassOfMaps& pass,
                   RenderStatistics& statistics) {
  merge_photons(photons, gather, pass, statistics);
  PhotonMap map = make_photon_map(std::move(photons), gather, emitted);
  statistics.photon_map_bytes += map.memory_bytes();
  return map;
}

}  // namespace vpm
