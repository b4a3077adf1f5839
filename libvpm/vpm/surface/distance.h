// How far a point is from shapes, in double precision.
#pragma once

#include "vpm/surface/geometry.h"

namespace vpm {

/// The distance of a point to the nearest one of a triangle, m.
double distance_to_triangle(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c);
/// The distance of a point to the nearest one of a sphere's surface, or of a disc, m.
double distance_to(const SphereShape& sphere, const Vec3& point);
double distance_to(const DiscShape& disc, const Vec3& point);

}  // namespace vpm
