// Where light from infinity enters the scene: the box around it, by the area that the box shows to each direction.
#include "vpm/light/kinds.h"

namespace vpm {

Vec3d face_areas(const Box& box) {
  const Vec3d e(box.extent());
  return {e.y * e.z, e.z * e.x, e.x * e.y};
}

double area_across(const Box& box, const Vec3& direction) {
  return glm::dot(glm::abs(Vec3d(direction)), face_areas(box));
}

int pick_axis(const Vec3d& weights, double choice) {
  const double target = choice * (weights.x + weights.y + weights.z);
  return target < weights.x ? 0 : target < weights.x + weights.y ? 1 : 2;
}

Vec3 point_on_face(const Box& box, int axis, bool upper, const Vec2& u) {
  Vec3 p;
  p[axis] = upper ? box.hi[axis] : box.lo[axis];
  for (const int k : {0, 1}) {
    const int along = (axis + 1 + k) % 3;
    p[along] = std::lerp(box.lo[along], box.hi[along], u[k]);
  }
  return p;
}

Ray ray_into(const Box& box, const Vec3& direction, const EmissionNumbers& u) {
  // The three faces that look against the direction hide nothing of each other.
  const int axis = pick_axis(glm::abs(Vec3d(direction)) * face_areas(box), u.face);
  return {point_on_face(box, axis, direction[axis] < 0.0f, u.place), direction};
}

}  // namespace vpm
