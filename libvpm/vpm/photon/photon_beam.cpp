// Recording flights.
#include "vpm/photon/photon_beam.h"

namespace vpm {

BeamRecorder::BeamRecorder(const Scene& scene, PhotonFilter filter, const More& more)
    : beams(scene.media.size()), scene_(scene), filter_(filter), more_(more) {}

void BeamRecorder::join(PhotonRecorder& part) {
  auto& other = static_cast<BeamRecorder&>(part);
  for (size_t m = 0; m < beams.size(); ++m) join_lists(beams[m], other.beams[m]);
}

void BeamRecorder::flew(const Track& track, const ArrivingPhoton& photon, Rng&) {
  const float length = more_.long_beams ? track.reach : track.interval.t1;
  if (!scene_.media[track.medium].scatters() || !filter_(photon) || !(length > 0.0f)) return;
  PhotonBeam beam{track.ray.origin, length, track.ray.direction, track.throughput, {}, 0.0f};
  if (more_.turns && photon.turn) {
    beam.turned_from = PackedDirection(photon.turn.from);
    beam.scattering_rate = mean_channel(scene_.media[photon.turn.medium].sigma_s) * photon.turn.density;
  }
  beams[track.medium].push_back(beam);
}

}  // namespace vpm
