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

}  // namespace vpm
