// Clipping triangles to texels, in double precision.
#include "vpm/integrators/photon_map/surface/uv_layout.h"

#include <fmt/format.h>

#include <algorithm>

#include "vpm/base/error.h"

namespace vpm {
namespace {

/// Overlaps of less, in texels, are rounding of texture coordinates where triangles meet.
constexpr double kLeastOverlap = 1e-3;

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// In texels; of either sign, by the order of the corners.
double signed_area(const UvPolygon& p) {
  double twice = 0.0;
  for (int i = 2; i < p.count; ++i) twice += cross(p.corners[i - 1] - p.corners[0], p.corners[i] - p.corners[0]);
  return 0.5 * twice;
}

/// The part of a polygon where distance(point) >= 0; `distance` is affine [Sutherland1974].
template <class Distance>
UvPolygon clip(const UvPolygon& polygon, Distance&& distance) {
  UvPolygon kept;
  for (int i = 0; i < polygon.count; ++i) {
    const glm::dvec2 &a = polygon.corners[i], &b = polygon.corners[i + 1 < polygon.count ? i + 1 : 0];
    const double from = distance(a), to = distance(b);
    if (from >= 0.0) kept.corners[kept.count++] = a;
    if ((from < 0.0) != (to < 0.0)) kept.corners[kept.count++] = glm::mix(a, b, from / (from - to));
  }
  return kept;
}

/// The part between two lines along the other axis.
UvPolygon clip_band(const UvPolygon& polygon, int axis, int lo) {
  const UvPolygon above = clip(polygon, [&](const glm::dvec2& p) { return p[axis] - lo; });
  return clip(above, [&](const glm::dvec2& p) { return lo + 1 - p[axis]; });
}

UvPolygon polygon_of(const UvTriangle& t) {
  UvPolygon polygon;
  for (const glm::dvec2& corner : t.corners) polygon.corners[polygon.count++] = corner;
  return polygon;
}

/// From the least to the largest coordinate.
std::pair<double, double> extent(const UvPolygon& p, int axis) {
  double lo = p.corners[0][axis], hi = lo;
  for (int i = 1; i < p.count; ++i) {
    lo = std::min(lo, p.corners[i][axis]);
    hi = std::max(hi, p.corners[i][axis]);
  }
  return {lo, hi};
}

/// Calls found(cell) for each cell of a row or column of `count` that the polygon reaches into.
template <class Found>
void for_cells(const UvPolygon& p, int axis, int count, Found&& found) {
  if (p.count == 0) return;
  const auto [lo, hi] = extent(p, axis);
  const int first = std::clamp(static_cast<int>(lo), 0, count - 1);  // of the last edge, lo = count: no area there
  for (int cell = first; cell < std::min(count, static_cast<int>(std::ceil(hi))); ++cell) found(cell);
}

/// The area in texels that two convex polygons have in common.
double common_area(UvPolygon a, const UvPolygon& b) {
  const double turn = signed_area(b) < 0.0 ? -1.0 : 1.0;
  for (int i = 0; i < b.count && a.count > 0; ++i) {
    const glm::dvec2 &from = b.corners[i], &to = b.corners[i + 1 < b.count ? i + 1 : 0];
    a = clip(a, [&](const glm::dvec2& p) { return turn * cross(to - from, p - from); });
  }
  return std::abs(signed_area(a));
}

std::string uv_text(const UvLayout& layout, const glm::dvec2& texel) {
  return fmt::format("({:.6g}, {:.6g})", texel.x / layout.resolution, 1.0 - texel.y / layout.resolution);
}

UvTriangle lay_out_triangle(const Geometry& geometry, uint32_t shape, uint32_t triangle, int resolution) {
  static constexpr Vec2 kCorners[] = {{0.0f, 0.0f}, {1.0f, 0.0f}, {0.0f, 1.0f}};
  UvTriangle result;
  Vec3d at[3];
  for (int c = 0; c < 3; ++c) {
    const Hit corner = geometry.point_of_triangle(shape, triangle, kCorners[c]);
    const Vec2 uv = geometry.uv(corner);
    if (!(uv.x >= 0.0f && uv.x <= 1.0f && uv.y >= 0.0f && uv.y <= 1.0f)) {
      const Vec3& p = corner.position;
      throw InputError(fmt::format(
          "a corner of triangle {} has the texture coordinates ({}, {}), at x, y, z = {}, {}, {}; a light map needs "
          "all of them in [0, 1]",
          triangle, uv.x, uv.y, p.x, p.y, p.z));
    }
    at[c] = Vec3d(corner.position);
    result.corners[c] = {double{uv.x} * resolution, (1.0 - double{uv.y}) * resolution};
  }
  const double flat = std::abs(signed_area(polygon_of(result)));
  result.area = flat > 0.0 ? 0.5 * glm::length(glm::cross(at[1] - at[0], at[2] - at[0])) / flat : 0.0;
  return result;
}

UvPiece piece_of(const UvLayout& layout, uint32_t triangle, size_t texel) {
  const auto n = static_cast<size_t>(layout.resolution);
  const UvPolygon row = clip_band(polygon_of(layout.triangles[triangle]), 1, static_cast<int>(texel / n));
  UvPiece piece{triangle, 0.0, clip_band(row, 0, static_cast<int>(texel % n))};
  piece.area = std::abs(signed_area(piece.polygon)) * layout.triangles[triangle].area;
  return piece;
}

/// Throws where pieces of a texel cover the same places.
void check_overlaps(const UvLayout& layout, std::vector<UvPiece>& pieces) {
  std::sort(pieces.begin(), pieces.end(),
            [](const UvPiece& a, const UvPiece& b) { return extent(a.polygon, 0).first < extent(b.polygon, 0).first; });
  double overlap = 0.0;
  for (size_t i = 0; i < pieces.size(); ++i) {
    const double end = extent(pieces[i].polygon, 0).second;
    for (size_t j = i + 1; j < pieces.size() && extent(pieces[j].polygon, 0).first < end; ++j) {
      overlap += common_area(pieces[i].polygon, pieces[j].polygon);
      if (overlap < kLeastOverlap) continue;
      throw InputError(
          fmt::format("triangles {} and {} overlap in texture coordinates near {}; in a light map each place on the "
                      "surface needs a place of its own",
                      pieces[i].triangle, pieces[j].triangle, uv_text(layout, pieces[j].polygon.corners[0])));
    }
  }
}

using Covered = std::vector<std::pair<size_t, uint32_t>>;  // texels, and triangles that cover some of them

/// Looks at once into a texel that is covered more than wholly: a mesh of many overlaps would fill the memory.
void check_texel(const UvLayout& layout, const Covered& covered, size_t texel) {
  std::vector<UvPiece> pieces;
  for (const auto& [where, triangle] : covered)
    if (where == texel) pieces.push_back(piece_of(layout, triangle, texel));
  check_overlaps(layout, pieces);
}

/// Sorts the triangles by the texels they cover.
void fill_texels(UvLayout& layout) {
  const int n = layout.resolution;
  Covered covered;
  for (uint32_t t = 0; t < layout.triangles.size(); ++t) {
    const UvTriangle& triangle = layout.triangles[t];
    if (triangle.area == 0.0) ++layout.flat_triangles;
    if (triangle.area == 0.0) continue;
    for_cells(polygon_of(triangle), 1, n, [&](int y) {
      const UvPolygon row = clip_band(polygon_of(triangle), 1, y);
      for_cells(row, 0, n, [&](int x) {
        const double share = std::abs(signed_area(clip_band(row, 0, x)));
        if (share == 0.0) return;
        const size_t texel = static_cast<size_t>(y) * n + x;
        covered.emplace_back(texel, t);
        layout.coverage[texel] += static_cast<float>(share);
        layout.areas[texel] += share * triangle.area;
        if (layout.coverage[texel] > 1.0 + 2.0 * kLeastOverlap) check_texel(layout, covered, texel);
      });
    });
  }
  for (const auto& [texel, triangle] : covered) ++layout.begin[texel + 1];
  for (size_t texel = 0; texel < layout.texels(); ++texel) layout.begin[texel + 1] += layout.begin[texel];
  layout.of_texels.resize(covered.size());
  std::vector<size_t> next = layout.begin;
  for (const auto& [texel, triangle] : covered) layout.of_texels[next[texel]++] = triangle;
}

/// The barycentric coordinates, as in Hit, of a point in texels.
Vec2 barycentric(const UvTriangle& t, const glm::dvec2& point) {
  const glm::dvec2 b = t.corners[1] - t.corners[0], c = t.corners[2] - t.corners[0], p = point - t.corners[0];
  return Vec2(cross(p, c), cross(b, p)) / static_cast<float>(cross(b, c));
}

}  // namespace

UvLayout lay_out(const Geometry& geometry, uint32_t shape, int resolution) {
  const auto triangles = static_cast<uint32_t>(geometry.triangle_count(shape));
  if (triangles == 0) throw InputError("it is no mesh: light maps are of meshes and quads");
  if (!geometry.has_uvs(shape))
    throw InputError(
        "it has no texture coordinates: quads have them, and meshes whose file gives them to the vertices");
  UvLayout layout;
  layout.shape = shape;
  layout.resolution = resolution;
  layout.coverage.resize(static_cast<size_t>(resolution) * resolution);
  layout.areas.resize(layout.texels());
  layout.begin.resize(layout.texels() + 1);
  layout.triangles.reserve(triangles);
  for (uint32_t t = 0; t < triangles; ++t) layout.triangles.push_back(lay_out_triangle(geometry, shape, t, resolution));
  fill_texels(layout);
  if (layout.of_texels.empty()) throw InputError("its triangles have no area in texture coordinates");
  std::vector<UvPiece> pieces;
  for (size_t texel = 0; texel < layout.texels(); ++texel) {
    if (layout.begin[texel + 1] - layout.begin[texel] < 2) continue;
    find_pieces(layout, texel, pieces);
    check_overlaps(layout, pieces);
  }
  return layout;
}

void find_pieces(const UvLayout& layout, size_t texel, std::vector<UvPiece>& pieces) {
  pieces.clear();
  for (size_t i = layout.begin[texel]; i < layout.begin[texel + 1]; ++i)
    pieces.push_back(piece_of(layout, layout.of_texels[i], texel));
}

Hit sample_pieces(const Geometry& geometry, const UvLayout& layout, std::span<const UvPiece> pieces, Rng& rng) {
  double total = 0.0;
  for (const UvPiece& piece : pieces) total += piece.area;
  double u = rng.uniform_double() * total;
  const UvPiece* picked = pieces.data();
  for (; picked != &pieces.back() && u >= picked->area; ++picked) u -= picked->area;

  const UvPolygon& p = picked->polygon;
  const UvTriangle& triangle = layout.triangles[picked->triangle];
  int i = 2;  // of the fan about the first corner, by the same number
  for (; i < p.count - 1; ++i) {
    const double share = 0.5 * std::abs(cross(p.corners[i - 1] - p.corners[0], p.corners[i] - p.corners[0]));
    if (u < share * triangle.area) break;
    u -= share * triangle.area;
  }
  double a = rng.uniform_double(), b = rng.uniform_double();
  if (a + b > 1.0) a = 1.0 - a, b = 1.0 - b;
  const glm::dvec2 point = p.corners[0] + a * (p.corners[i - 1] - p.corners[0]) + b * (p.corners[i] - p.corners[0]);
  return geometry.point_of_triangle(layout.shape, picked->triangle, barycentric(triangle, point));
}

Rgbd received_power(const UvLayout& layout, const Image& irradiance) {
  Rgbd sum(0.0);
  for (size_t texel = 0; texel < layout.texels(); ++texel) sum += layout.areas[texel] * Rgbd(irradiance.pixels[texel]);
  return sum;
}

Image dilated(const Image& map, const UvLayout& layout, int rings) {
  Image result = map;
  std::vector<bool> known(layout.texels());
  for (size_t texel = 0; texel < known.size(); ++texel) known[texel] = layout.covers(texel);
  for (int ring = 0; ring < rings; ++ring) {
    const Image before = result;
    std::vector<bool> reached = known;
    for (int y = 0; y < map.height; ++y)
      for (int x = 0; x < map.width; ++x) {
        const size_t texel = static_cast<size_t>(y) * map.width + x;
        if (known[texel]) continue;
        Rgb sum(0.0f);
        int count = 0;
        for (int j = std::max(0, y - 1); j <= std::min(map.height - 1, y + 1); ++j)
          for (int i = std::max(0, x - 1); i <= std::min(map.width - 1, x + 1); ++i) {
            if (!known[static_cast<size_t>(j) * map.width + i]) continue;
            sum += before.at(i, j);
            ++count;
          }
        if (count == 0) continue;
        result.at(x, y) = sum / static_cast<float>(count);
        reached[texel] = true;
      }
    known = std::move(reached);
  }
  return result;
}

}  // namespace vpm
