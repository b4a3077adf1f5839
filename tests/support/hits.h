// Hits that no ray has made.
#pragma once

#include "vpm/surface/geometry.h"

namespace vpm {

inline Hit hit_at(const Vec3& position, const Vec3& normal, const Vec3& shading_normal) {
  Hit hit;
  hit.position = position;
  hit.normal = normal;
  hit.shading_normal = shading_normal;
  return hit;
}
inline Hit hit_at(const Vec3& position, const Vec3& normal) { return hit_at(position, normal, normal); }

}  // namespace vpm
