// Drawing planes' directions, and laying planes out for the loop over all.
#include "vpm/photon/photon_plane.h"

#include <utility>

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

PhotonPlaneList::PhotonPlaneList(std::vector<PhotonPlane> planes) : planes_(std::move(planes)) {
  for (std::vector<float>* values : {&x_, &y_, &z_, &length_, &ax_, &ay_, &az_, &bx_, &by_, &bz_})
    values->assign(planes_.size() + kBlock, 0.0f);
  for (size_t i = 0; i < planes_.size(); ++i) {
    const PhotonPlane& plane = planes_[i];
    x_[i] = plane.origin.x;
    y_[i] = plane.origin.y;
    z_[i] = plane.origin.z;
    length_[i] = plane.length;
    ax_[i] = plane.direction.x;
    ay_[i] = plane.direction.y;
    az_[i] = plane.direction.z;
    bx_[i] = plane.scattered.x;
    by_[i] = plane.scattered.y;
    bz_[i] = plane.scattered.z;
  }
}

std::pair<Vec3, Vec3> PhotonPlaneList::across(const Vec3& direction) {
  std::pair<Vec3, Vec3> axes;
  make_frame(direction, axes.first, axes.second);
  return axes;
}

size_t PhotonPlaneList::memory_bytes() const {
  return sizeof(*this) + planes_.capacity() * sizeof(PhotonPlane) + 10 * x_.capacity() * sizeof(float);
}

}  // namespace vpm
