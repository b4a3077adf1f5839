// What is refused of shapes, and the parts of a mesh that rays cannot meet.
#pragma once

#include "vpm/surface/geometry.h"

namespace vpm {

/// The triangles of a mesh that have an area. Throws InputError as Geometry::add().
std::vector<glm::uvec3> checked_triangles(const TriangleMesh& mesh);
/// Throws InputError where a sphere or disc (`title`) has its center too far away, or no proper radius.
void check_round(const char* title, const Vec3& center, float radius);

}  // namespace vpm
