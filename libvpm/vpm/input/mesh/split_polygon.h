// Polygons as triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "vpm/base/vec.h"

namespace vpm {

struct PolygonSplit {
  std::vector<std::array<uint32_t, 3>> triangles;  // numbers of corners; turning as the polygon does
  bool flat = true;                                // no corner is further than 1 % of its extent off its plane
  bool crosses_itself = false;                     // so that it has no inside; `triangles` is not complete then
};

/// Splits a polygon of at least three corners, m, which may repeat places, as where a slit leads to a hole. One that a
/// fan of triangles from its first corner covers, as every convex one, becomes that fan; any other loses an ear at a
/// time: a triangle of three neighbours that holds no other corner [Meisters1975].
void split_polygon(std::span<const Vec3> corners, PolygonSplit& split);

}  // namespace vpm
