// Drawing planes' directions.
#include "vpm/photon/photon_plane.h"

namespace vpm {

std::vector<PhotonPlane> planes_of(const std::vector<std::vector<PhotonBeam>>& flights, const Scene& scene, float scale,
                                   Rng& rng) {
  std::vector<PhotonPlane> planes;
  for (size_t m = 0; m < flights.size(); ++m)
    for (const PhotonBeam& flight : flights[m]) {
      const Vec3 scattered = phase_sample(scene.media[m].phase, flight.direction, rng.uniform2());
      planes.push_back(
          {flight.origin, flight.length, flight.direction, scattered, scale * flight.power, static_cast<MediumId>(m)});
    }
  return planes;
}

}  // namespace vpm
