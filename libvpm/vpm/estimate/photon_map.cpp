// Building photon maps, with the radii of passes.
#include "vpm/estimate/photon_map.h"
#include "vpm/estimate/radius_schedule.h"
#include "vpm/photon/density_control.h"

namespace vpm {

size_t PhotonMap::prepare_sums_by_nodes() {
  if (!sums_by_nodes(settings)) return 0;
  auto& by_count = std::get<NearestMap>(index);
  by_count.add_nodes();
  return by_count.nodes()->memory_bytes();
}

size_t PhotonMap::size() const {
  return std::visit([](const auto& map) { return map.size(); }, index);
}
const Box& PhotonMap::bounds() const {
  return std::visit([](const auto& map) -> const Box& { return map.bounds(); }, index);
}
size_t PhotonMap::memory_bytes() const {
  return std::visit([](const auto& map) { return map.memory_bytes(); }, index);
}

PhotonMap make_photon_map(std::vector<Photon> photons, const GatherSettings& settings, uint64_t emitted) {
  const auto scale = static_cast<float>(1.0 / static_cast<double>(emitted));
  if (settings.mode == GatherMode::radius) return {settings, RadiusMap(photons, settings.radius, scale)};
  return {settings, NearestMap(photons, scale)};
}

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
