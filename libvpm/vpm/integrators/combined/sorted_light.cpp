// Maps of light sub-paths, for the techniques that merge.
#include <algorithm>
#include <utility>

#include "vpm/integrators/combined/combined.h"

namespace vpm {
namespace {

std::vector<LightBeams> sorted_beams(LightFlights& flights, float radius, float scale) {
  std::vector<LightBeams> beams;
  for (size_t m = 0; m < flights.beams.size(); ++m) {
    beams.push_back({PhotonBeamMap(flights.beams[m], radius, scale), std::move(flights.flights[m])});
    flights.beams[m] = {};
  }
  return beams;
}

}  // namespace

SortedLight::SortedLight(const Scene& scene, const TechniqueCounts& counts, const MergeKernels& kernels,
                         LightSubPaths paths)
    : paths_(std::move(paths)), on_surfaces_(std::exchange(paths_.on_surfaces, {}), kernels.surface) {
  const float reach = std::max(kernels.points_2d, kernels.points_3d);
  const float scale = 1.0f / static_cast<float>(paths_.ledger.emitted_count);
  for (MediumId m = 0; m < static_cast<MediumId>(scene.media.size()); ++m) {
    scales_.push_back(behind_scale(counts, mean_channel(scene.media[m].sigma_t)));
    for (MergePhoton& photon : paths_.photons[m]) photon.behind = photon.behind.over(1.0 / scales_.back());
    in_media_.emplace_back(paths_.photons[m], reach);
    paths_.photons[m] = {};
  }
  beams_ = sorted_beams(paths_.flights, kernels.beams, scale);
}

size_t SortedLight::beam_count() const {
  size_t sum = 0;
  for (const LightBeams& of_medium : beams_) sum += of_medium.map.size();
  return sum;
}

size_t SortedLight::photons_in_media() const {
  size_t sum = 0;
  for (const MergeMap& map : in_media_) sum += map.size();
  return sum;
}

size_t SortedLight::memory_bytes() const {
  size_t bytes = on_surfaces_.memory_bytes();
  for (const MergeMap& map : in_media_) bytes += map.memory_bytes();
  for (const LightBeams& of_medium : beams_)
    bytes += of_medium.map.memory_bytes() + of_medium.flights.capacity() * sizeof(FlightTerms);
  return bytes;
}

}  // namespace vpm
