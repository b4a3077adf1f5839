// Laying planes out for the loop over all.
#include "vpm/photon/photon_plane_list.h"

namespace vpm {

PhotonPlaneList::PhotonPlaneList(const std::vector<std::vector<PhotonPlane>>& by_medium, float scale) {
  for (size_t m = 0; m < by_medium.size(); ++m)
    for (const PhotonPlane& plane : by_medium[m]) {
      planes_.push_back(plane);
      planes_.back().power *= scale;
      media_.push_back(static_cast<MediumId>(m));
    }
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

size_t PhotonPlaneList::memory_bytes() const {
  return sizeof(*this) + planes_.capacity() * sizeof(PhotonPlane) + media_.capacity() * sizeof(MediumId) +
         10 * x_.capacity() * sizeof(float);
}

}  // namespace vpm
