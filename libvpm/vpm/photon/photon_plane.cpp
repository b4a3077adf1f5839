// Recording planes.
#include "vpm/photon/photon_plane.h"

namespace vpm {

void PlaneRecorder::join(PhotonRecorder& part) {
  auto& other = static_cast<PlaneRecorder&>(part);
  for (size_t m = 0; m < planes.size(); ++m) join_lists(planes[m], other.planes[m]);
}

void PlaneRecorder::flew(const Track& track, const ArrivingPhoton&, Rng& rng) {
  const Medium& medium = scene_.media[track.medium];
  if (!medium.scatters() || !(track.length > 0.0f)) return;
  const Vec3 scattered = phase_sample(medium.phase, track.ray.direction, rng.uniform2());
  planes[track.medium].push_back({track.ray.origin, track.length, track.ray.direction, scattered, track.throughput});
}

}  // namespace vpm
