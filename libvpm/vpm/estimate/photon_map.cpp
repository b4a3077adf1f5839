// Building photon maps.
#include "vpm/estimate/photon_map.h"

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

}  // namespace vpm
