// Rays against spheres, in double precision: robust for spheres that are far, tiny or huge, from inside and outside.
#pragma once

#include "vpm/surface/geometry.h"

namespace vpm {

/// The smallest root t >= t_min > 0 of |origin + t direction - centre| = radius, in m; infinity where there is none.
double intersect_sphere(const SphereShape& sphere, const Ray& ray, float t_min);
/// The outward unit normal at the point of the sphere next to origin + t direction.
Vec3d sphere_normal(const SphereShape& sphere, const Ray& ray, double t);
/// The box around a sphere.
inline Box bounds_of(const SphereShape& sphere) {
  return {sphere.centre - sphere.radius, sphere.centre + sphere.radius};
}

/// The coordinates in a texture of the point of a sphere with that unit outward normal: u the angle about the y axis
/// over 2 pi, from +z (0) over +x (1/4); v the height in angle over pi, from -y (0) to +y (1). As of a globe whose
/// north is up and that is seen from outside, the map is not mirrored.
Vec2 sphere_uv(const Vec3& normal);

}  // namespace vpm
