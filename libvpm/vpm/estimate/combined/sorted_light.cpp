// Maps of light sub-paths, for the techniques that merge.
#include <algorithm>

#include "vpm/estimate/combined/combined.h"

namespace vpm {
namespace {

VertexMap<SurfacePhoton> sort_surfaces(const std::vector<LightVertex>& vertices, const TechniqueCounts& counts,
                                       float radius) {
  if (counts.surfaces == 0.0) return {};
  std::vector<PlacedRecord<SurfacePhoton>> photons;
  for (const LightVertex& light : vertices) {
    const PathVertex& vertex = light.at.vertex;
    if (vertex.on_surface && !light.at.sums.straight)
      photons.push_back(
          {vertex.point, {vertex.point, vertex.travel, light.power, behind_merge(counts, light.at.sums)}});
  }
  return {photons, radius};
}

}  // namespace

SortedLight::SortedLight(const Scene& scene, const TechniqueCounts& counts, const MergeKernels& kernels,
                         LightSubPaths paths)
    : paths_(std::move(paths)), on_surfaces_(sort_surfaces(paths_.vertices, counts, kernels.surface)) {
  const float reach = std::max(kernels.points_2d, kernels.points_3d);
  const float scale = 1.0f / static_cast<float>(paths_.ledger.emitted_count);
  for (MediumId m = 0; m < static_cast<MediumId>(scene.media.size()); ++m) {
    in_media_.push_back(VertexMap<MediumPhoton>(paths_.photons[m], reach));
    paths_.photons[m] = {};
    beams_.push_back(counts.beams > 0.0 ? PhotonBeamMap(paths_.beams[m], kernels.beams, scale) : PhotonBeamMap());
    paths_.beams[m] = {};
  }
}

size_t SortedLight::beam_count() const {
  size_t sum = 0;
  for (const PhotonBeamMap& map : beams_) sum += map.size();
  return sum;
}

size_t SortedLight::memory_bytes() const {
  size_t bytes = paths_.vertices.capacity() * sizeof(LightVertex) + on_surfaces_.memory_bytes();
  for (const auto& starts : paths_.starts) bytes += starts.capacity() * sizeof(LightBeam);
  for (const VertexMap<MediumPhoton>& map : in_media_) bytes += map.memory_bytes();
  for (const PhotonBeamMap& map : beams_) bytes += map.memory_bytes();
  return bytes;
}

}  // namespace vpm
