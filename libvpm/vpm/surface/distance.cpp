// Distances to triangles, spheres and discs.
#include "vpm/surface/distance.h"

#include <algorithm>

namespace vpm {

namespace {

/// `way` and `edge` start at one end of the edge: `way` leads to the point.
double distance_to_edge(const Vec3d& way, const Vec3d& edge) {
  const double square = glm::dot(edge, edge);
  const double along = square > 0.0 ? std::clamp(glm::dot(way, edge) / square, 0.0, 1.0) : 0.0;
  return glm::length(way - along * edge);
}

}  // namespace

double distance_to_triangle(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3d corners[] = {Vec3d(a), Vec3d(b), Vec3d(c)};
  const Vec3d across = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  double to_edges = kInfinity;
  bool above = true;  // is the nearest point of the plane in the triangle?
  for (int i = 0; i < 3; ++i) {
    const Vec3d way = Vec3d(point) - corners[i], edge = corners[(i + 1) % 3] - corners[i];
    to_edges = std::min(to_edges, distance_to_edge(way, edge));
    above = above && glm::dot(glm::cross(edge, way), across) >= 0.0;
  }
  return above ? std::abs(glm::dot(Vec3d(point) - corners[0], across)) / glm::length(across) : to_edges;
}

double distance_to(const SphereShape& sphere, const Vec3& point) {
  return std::abs(glm::length(Vec3d(point) - Vec3d(sphere.centre)) - sphere.radius);
}

double distance_to(const DiscShape& disc, const Vec3& point) {
  const Vec3d way = Vec3d(point) - Vec3d(disc.centre), normal(disc.normal);
  const double height = glm::dot(way, normal);
  const double beyond_rim = std::max(0.0, glm::length(way - height * normal) - disc.radius);
  return std::hypot(height, beyond_rim);
}

}  // namespace vpm
