// How a path meets a surface: from which side, and where the mirror's law sends it.
#pragma once

#include <algorithm>

#include "vpm/base/vec.h"

namespace vpm {

/// Directions that leave a surface make at least this cosine with the side they go to. At grazing incidence rounding
/// could otherwise carry a path through a mirror, or a refracted one back.
inline constexpr float kMinCosine = 1e-6f;

/// `direction` with unit length, on the side of the unit vector `n`.
inline Vec3 on_side(const Vec3& direction, const Vec3& n) {
  const Vec3 d = glm::normalize(direction);
  const float cosine = glm::dot(d, n);
  return cosine >= kMinCosine ? d : glm::normalize(d + (2.0f * kMinCosine - cosine) * n);
}

/// A path before the surface: the normal on its side, and the cosine of incidence to it in [0, 1].
struct Incidence {
  Vec3 normal{0.0f};
  float cosine = 0.0f;
  bool from_outside = true;

  Incidence(const Vec3& outward, const Vec3& travel) {
    const float along = glm::dot(outward, travel);
    from_outside = along < 0.0f;
    normal = from_outside ? outward : -outward;
    cosine = std::min(1.0f, std::abs(along));
  }
};

/// The direction into which a mirror sends a path.
inline Vec3 mirrored(const Incidence& in, const Vec3& travel) {
  return on_side(travel + 2.0f * in.cosine * in.normal, in.normal);
}

}  // namespace vpm
