// Where a mesh lies on the texels of a square map over its texture coordinates.
//
// Texels are the cells of the unit square: rows from the top, where v = 1, columns from u = 0, as Texture has them.
// Each triangle is clipped to the texels it covers, exactly, so that a point can be drawn in what a texel shows of the
// surface, however little that is.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "vpm/base/rng.h"
#include "vpm/image/image.h"
#include "vpm/surface/geometry.h"

namespace vpm {

/// A convex polygon of few corners, in texels: x to the right, y down from the map's top left.
struct UvPolygon {
  static constexpr int kMost = 16;  // a triangle clipped by a square has 7 corners, two of these in common at most 14
  std::array<glm::dvec2, kMost> corners;
  int count = 0;
};

struct UvTriangle {
  std::array<glm::dvec2, 3> corners;  // in texels
  double area = 0.0;                  // of the surface over that in texels, m^2
};

/// What a texel shows of a triangle.
struct UvPiece {
  uint32_t triangle = 0;
  double area = 0.0;  // m^2
  UvPolygon polygon;
};

struct UvLayout {
  uint32_t shape = 0;
  int resolution = 0;  // texels along an edge
  std::vector<UvTriangle> triangles;
  std::vector<size_t> begin;        // of each texel's triangles in `of_texels`, row by row; and the end
  std::vector<uint32_t> of_texels;  // triangles
  std::vector<float> coverage;      // of each texel: the share of its cell that triangles cover
  std::vector<double> areas;        // of the surface that each texel shows, m^2
  uint64_t flat_triangles = 0;      // without an area in texture coordinates: no texel shows them

  size_t texels() const { return coverage.size(); }
  size_t covered_texels() const {
    return static_cast<size_t>(std::count_if(areas.begin(), areas.end(), [](double a) { return a > 0.0; }));
  }
  bool covers(size_t texel) const { return begin[texel] < begin[texel + 1]; }
};

/// Lays out a mesh. Throws InputError, which names no shape, where the shape is no mesh or has no texture coordinates,
/// where these leave the unit square, and where triangles overlap in them.
UvLayout lay_out(const Geometry& geometry, uint32_t shape, int resolution);

/// The pieces in a texel, into `pieces`.
void find_pieces(const UvLayout& layout, size_t texel, std::vector<UvPiece>& pieces);
/// A point of the surface in the pieces of a texel, at least one: uniform by area.
Hit sample_pieces(const Geometry& geometry, const UvLayout& layout, std::span<const UvPiece> pieces, Rng& rng);

/// The power, W, that a map of irradiance says the shape receives: the sum of irradiance times area over the texels.
Rgbd received_power(const UvLayout& layout, const Image& irradiance);

/// Sets each uncovered texel to the mean of those of its eight neighbours that are covered, and repeats this `rings`
/// times, so that bilinear lookups at the edges do not see black.
Image dilated(const Image& map, const UvLayout& layout, int rings);

}  // namespace vpm
