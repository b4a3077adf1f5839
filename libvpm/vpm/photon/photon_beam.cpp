// Recording flights.
#include "vpm/photon/photon_beam.h"

namespace vpm {

BeamRecorder::BeamRecorder(const Scene& scene, PhotonFilter filter)
    : beams(scene.media.size()), scene_(scene), filter_(filter) {}

void BeamRecorder::join(PhotonRecorder& part) {
  auto& other = static_cast<BeamRecorder&>(part);
  for (size_t m = 0; m < beams.size(); ++m) join_lists(beams[m], other.beams[m]);
}

size_t BeamRecorder::stored() const {
  size_t all = 0;
  for (const std::vector<PhotonBeam>& of_medium : beams) all += of_medium.size();
  return all;
}

void BeamRecorder::flew(const Track& track, const ArrivingPhoton& photon, Rng&) {
  if (!scene_.media[track.medium].scatters() || !filter_(photon) || !(track.length > 0.0f)) return;
  beams[track.medium].push_back({track.ray.origin, track.length, track.ray.direction, track.throughput});
}

void thin_flights(std::vector<std::vector<PhotonBeam>>& by_medium, uint64_t most, Rng& rng) {
  uint64_t all = 0;
  for (const std::vector<PhotonBeam>& beams : by_medium) all += beams.size();
  if (most == 0 || all <= most) return;
  const double step = static_cast<double>(all) / static_cast<double>(most);
  double next = step * rng.uniform_double();
  uint64_t number = 0;
  for (std::vector<PhotonBeam>& beams : by_medium) {
    size_t kept = 0;
    for (const PhotonBeam& beam : beams) {
      if (number++ != static_cast<uint64_t>(next)) continue;
      beams[kept] = beam;
      beams[kept++].power *= static_cast<float>(step);
      next += step;
    }
    beams.resize(kept);
  }
}

}  // namespace vpm
