// Rays against spheres, in double precision: robust for spheres that are far, tiny or huge, from inside and outside.
#pragma once

#include "surface/geometry.h"

namespace vpm {

/// The smallest root t >= t_min > 0 of |origin + t direction - centre| = radius, in m; infinity where there is none.
double intersect_sphere(const SphereShape& sphere, const Ray& ray, float t_min);
/// The outward unit normal at the point of the sphere next to origin + t direction.
Vec3d sphere_normal(const SphereShape& sphere, const Ray& ray, double t);

}  // namespace vpm
