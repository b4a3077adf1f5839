// Photon planes: flights of photons, each with a direction in which its photon might have been scattered from anywhere
// along it. And those of a pass, as a list.
#pragma once

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "vpm/base/below.h"
#include "vpm/base/cancel.h"
#include "vpm/photon/photon_beam.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// The places that a photon comes to if it collides anywhere on its flight and is scattered into one direction
/// [Bitterli2017].
struct PhotonPlane {
  Vec3 origin{0.0f};          // of the flight, m
  float length = 0.0f;        // of the flight, m, > 0
  Vec3 direction{0.0f};       // of the flight, unit
  Vec3 scattered{0.0f};       // the direction after the collision, unit
  Rgb power{0.0f};            // of the photon at the origin, W
  MediumId medium = kVacuum;  // of the flight
};

/// A plane for each flight, by medium, also for those that end at surfaces and for photons that are absorbed: any place
/// on a flight might have been that of the collision. Directions are drawn from the media's phase functions. Powers are
/// multiplied by `scale`.
std::vector<PhotonPlane> planes_of(const std::vector<std::vector<PhotonBeam>>& flights, const Scene& scene, float scale,
                                   Rng& rng);

/// Where a ray crosses a plane.
struct PlaneCrossing {
  const PhotonPlane& plane;
  float along_flight;  // from the plane's origin to the collision, m
  float beyond;        // from the collision to the crossing, m
  float t;             // along the ray, m
  float determinant;   // of the directions of flight, scattered light and ray: the volume that they span, > 0
  size_t number;       // of the plane in the list
};

/// The photon planes of a pass, met by rays. Planes reach so far that a ray crosses a good part of them, and asks for a
/// shadow ray at each of these. So it looks at all of them.
class PhotonPlaneList {
 public:
  PhotonPlaneList() = default;
  explicit PhotonPlaneList(std::vector<PhotonPlane> planes);

  /// Calls visit(const PlaneCrossing&) for the planes that the ray crosses in the interval, in their order.
  template <class Visit>
  void visit_crossings(const Ray& ray, const Interval& interval, Visit&& visit) const;

  size_t size() const { return planes_.size(); }
  size_t memory_bytes() const;

 private:
  /// Two unit axes across a direction.
  static std::pair<Vec3, Vec3> across(const Vec3& direction);

  std::vector<PhotonPlane> planes_;
  // The same once more, for the loop over all, with kBlock further ones that no ray crosses.
  std::vector<float> x_, y_, z_, length_;  // origins and lengths of flights, m
  std::vector<float> ax_, ay_, az_;        // directions of flights
  std::vector<float> bx_, by_, bz_;        // directions of scattered light
};

template <class Visit>
void PhotonPlaneList::visit_crossings(const Ray& ray, const Interval& interval, Visit&& visit) const {
  const auto [right, up] = across(ray.direction);
  const Vec3 along = ray.direction, o = ray.origin;
  const auto [t0, t1] = interval;
  cancellation_point();
  for (size_t block = 0; block < planes_.size(); block += kBlock) {
    float from[kBlock], beyond[kBlock], t[kBlock], determinant[kBlock];
    bool crossed[kBlock];
    for (size_t i = 0; i < kBlock; ++i) {
      const size_t p = block + i;
      const Vec3 d(o.x - x_[p], o.y - y_[p], o.z - z_[p]);
      const Vec3 a(ax_[p], ay_[p], az_[p]), b(bx_[p], by_[p], bz_[p]);
      // s a + u b = d across the ray, with the distances s along the flight and u beyond the collision.
      const float a0 = glm::dot(a, right), a1 = glm::dot(a, up), b0 = glm::dot(b, right), b1 = glm::dot(b, up);
      const float d0 = glm::dot(d, right), d1 = glm::dot(d, up);
      const float volume = a0 * b1 - a1 * b0, inverse = 1.0f / volume;
      const float s = (d0 * b1 - d1 * b0) * inverse, u = (a0 * d1 - a1 * d0) * inverse;
      const float at = s * glm::dot(a, along) + u * glm::dot(b, along) - glm::dot(d, along);
      from[i] = s;
      beyond[i] = u;
      t[i] = at;
      determinant[i] = std::abs(volume);
      crossed[i] = s >= 0.0f && s < length_[p] && u > 0.0f && at >= t0 && at < t1;
    }
    for (size_t i = 0; i < kBlock; ++i)
      if (crossed[i]) visit(PlaneCrossing{planes_[block + i], from[i], beyond[i], t[i], determinant[i], block + i});
  }
}

}  // namespace vpm
