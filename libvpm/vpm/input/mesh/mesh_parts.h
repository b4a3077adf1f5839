// What the readers of the two mesh formats share.
#pragma once

#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "vpm/base/vec.h"

namespace vpm {

/// What a corner of a face names: numbers of a position and, where it has them, of a texture coordinate and a normal.
struct MeshCorner {
  static constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();
  static constexpr uint32_t kMissing = kNone - 1;  // named, by a number of none
  uint32_t position = 0, uv = kNone, normal = kNone;
};

/// A face: its corners, of which there may be fewer than three, up to here in the list of all, and its line in the
/// file; 0 in files that are no text.
struct MeshFace {
  size_t end = 0;
  uint32_t line = 0;
};

/// A mesh as it stands in a file: polygons, whose corners may name what there is not, and values that may be no finite
/// numbers. Both are wrong only where a face uses them.
struct PolygonMesh {
  std::vector<Vec3> positions, normals;  // m
  std::vector<Vec2> uvs;
  std::vector<MeshCorner> corners;  // of all faces, one after the other
  std::vector<MeshFace> faces;
  std::map<uint32_t, uint32_t> bad_positions;  // the lines of those that are not finite
  bool values_of_vertices = false;             // does each corner name its position's number in all lists?
  uint32_t first = 0;                          // the number that the format gives to the first vertex
  uint64_t free_form = 0;                      // surfaces of other kinds, which are not read
};

/// `name` is for messages.
PolygonMesh parse_ply(const std::string& name, std::string_view text);
PolygonMesh parse_obj(const std::string& name, std::string_view text);

/// The text without the mark that writers on Windows put before UTF-8. Throws InputError for text in UTF-16.
std::string_view without_mark(const std::string& name, std::string_view text);

/// Throws InputError "name:line: wrong"; "name: wrong" for line 0.
[[noreturn]] void fail_in_mesh(const std::string& name, size_t line, const std::string& wrong);

}  // namespace vpm
