// Maps of light sub-paths, for the techniques that merge.
#include <utility>

#include "vpm/estimate/combined/combined.h"

namespace vpm {
namespace {

std::vector<LightBeams> sorted_beams(LightFlights& flights, float radius, float scale) {
  std::vector<LightBeams> beams;
  for (size_t m = 0; m < flights.beams.size(); ++m) {
    beams.push_back({PhotonBeamMap(flights.beams[m], radius, scale), std::move(flights.starts[m])});
    flights.beams[m] = {};
  }
  return beams;
}

}  // namespace

SortedLight::SortedLight(const Scene& scene, const TechniqueCounts& counts, const MergeKernels& kernels,
                         LightSubPaths paths)
    : paths_(std::move(paths)), of_media_(scene.media.size()) {
  std::vector<Vec3> surfaces;
  std::vector<std::vector<Vec3>> media(scene.media.size());
  for (uint32_t i = 0; i < paths_.vertices.size(); ++i) {
    const PathVertex& vertex = paths_.vertices[i].at.vertex;
    (vertex.on_surface ? of_surfaces_ : of_media_[vertex.medium]).push_back(i);
    (vertex.on_surface ? surfaces : media[vertex.medium]).push_back(vertex.point);
  }
  if (counts.surfaces > 0.0) on_surfaces_ = VertexMap(surfaces, kernels.surface);
  const float scale = 1.0f / static_cast<float>(paths_.ledger.emitted_count);
  for (size_t m = 0; m < scene.media.size(); ++m) {
    around_points_.push_back(counts.points_3d > 0.0 ? VertexMap(media[m], kernels.points_3d) : VertexMap());
    beside_rays_.push_back(counts.points_2d > 0.0 ? VertexMap(media[m], kernels.points_2d) : VertexMap());
  }
  short_beams_ = sorted_beams(paths_.short_beams, kernels.beams, scale);
  long_beams_ = sorted_beams(paths_.long_beams, kernels.beams, scale);
  planes_ = PhotonPlaneList(std::exchange(paths_.planes, {}));
}

size_t SortedLight::beam_count() const {
  size_t sum = 0;
  for (const auto* beams : {&short_beams_, &long_beams_})
    for (const LightBeams& of_medium : *beams) sum += of_medium.map.size();
  return sum;
}

size_t SortedLight::memory_bytes() const {
  size_t bytes = paths_.vertices.capacity() * sizeof(LightVertex) + on_surfaces_.memory_bytes() +
                 of_surfaces_.capacity() * sizeof(uint32_t);
  for (const auto& numbers : of_media_) bytes += numbers.capacity() * sizeof(uint32_t);
  bytes += planes_.memory_bytes() + paths_.plane_starts.capacity() * sizeof(FlightStart);
  for (const auto* maps : {&around_points_, &beside_rays_})
    for (const VertexMap& map : *maps) bytes += map.memory_bytes();
  for (const auto* beams : {&short_beams_, &long_beams_})
    for (const LightBeams& of_medium : *beams)
      bytes += of_medium.map.memory_bytes() + of_medium.starts.capacity() * sizeof(FlightStart);
  return bytes;
}

}  // namespace vpm
