// Distances to triangles, spheres and discs.
#include "vpm/surface/distance.h"

#include <algorithm>
#include <cmath>

namespace vpm {

namespace {

/// m^2. `way` and `edge` start at one end of the edge: `way` leads to the point.
double square_to_edge(const Vec3d& way, const Vec3d& edge) {
  const double square = glm::dot(edge, edge);
  const double along = square > 0.0 ? std::clamp(glm::dot(way, edge) / square, 0.0, 1.0) : 0.0;
  const Vec3d across = way - along * edge;
  return glm::dot(across, across);
}

}  // namespace

double distance_to_triangle(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3d corners[] = {Vec3d(a), Vec3d(b), Vec3d(c)};
  const Vec3d edges[] = {corners[1] - corners[0], corners[2] - corners[1], corners[0] - corners[2]};
  const Vec3d ways[] = {Vec3d(point) - corners[0], Vec3d(point) - corners[1], Vec3d(point) - corners[2]};
  const Vec3d across = glm::cross(edges[0], corners[2] - corners[0]);
  bool above = true;  // is the nearest point of the plane in the triangle?
  for (int i = 0; i < 3; ++i) above = above && glm::dot(glm::cross(edges[i], ways[i]), across) >= 0.0;
  if (above) return std::abs(glm::dot(ways[0], across)) / glm::length(across);
  double square = kInfinity;
  for (int i = 0; i < 3; ++i) square = std::min(square, square_to_edge(ways[i], edges[i]));
  return std::sqrt(square);
}

double distance_to(const SphereShape& sphere, const Vec3& point) {
  return std::abs(glm::length(Vec3d(point) - Vec3d(sphere.center)) - sphere.radius);
}

double distance_to(const DiscShape& disc, const Vec3& point) {
  const Vec3d way = Vec3d(point) - Vec3d(disc.center), normal(disc.normal);
  const double height = glm::dot(way, normal);
  const double beyond_rim = std::max(0.0, glm::length(way - height * normal) - disc.radius);
  return std::hypot(height, beyond_rim);
}

}  // namespace vpm
