// Rays against flat discs, in double precision.
#pragma once

#include "vpm/surface/geometry.h"

namespace vpm {

/// The t >= t_min > 0 at which the ray meets the disc, in m; infinity where it does not.
double intersect_disc(const DiscShape& disc, const Ray& ray, float t_min);
/// The point of the disc's plane next to origin + t direction.
Vec3d disc_point(const DiscShape& disc, const Ray& ray, double t);
/// The box around a disc.
Box bounds_of(const DiscShape& disc);

}  // namespace vpm
