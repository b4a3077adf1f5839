// Reading a mesh file, and making triangles of its polygons.
#include "vpm/input/mesh/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "vpm/base/cancel.h"
#include "vpm/base/error.h"
#include "vpm/input/mesh/mesh_parts.h"
#include "vpm/input/mesh/split_polygon.h"
#include "vpm/input/source.h"
#include "vpm/surface/mesh.h"

namespace vpm {
namespace {

bool is_normal(const Vec3& n) { return is_finite(n) && n != Vec3(0.0f); }

/// Makes the triangles of polygons, and a vertex for each combination that their corners name, in the order in which
/// they first stand there; where corners name vertices as a whole, these are the file's, and others come behind them.
class MeshBuilder {
 public:
  MeshBuilder(const std::string& name, PolygonMesh mesh) : name_(name), from_(std::move(mesh)) {
    to_.notes.free_form = from_.free_form;
    for (MeshCorner& corner : from_.corners) {
      if (from_.uvs.empty()) corner.uv = MeshCorner::kNone;
      if (from_.normals.empty() && corner.normal != MeshCorner::kNone) {
        corner.normal = MeshCorner::kNone;
        ++to_.notes.bad_normals;
      }
      has_uvs_ |= corner.uv < MeshCorner::kMissing;
      has_normals_ |= corner.normal < MeshCorner::kMissing;
    }
    if (!has_normals_) from_.normals.clear();
    if (!has_uvs_) from_.uvs.clear();
    keeps_ = from_.values_of_vertices || (!has_uvs_ && !has_normals_);
    vertices_ = from_.positions.size();
    if (keeps_)
      to_.mesh = {std::move(from_.positions), {}, std::move(from_.normals), std::move(from_.uvs)};
    else
      first_.resize(from_.positions.size(), MeshCorner::kNone);
  }

  LoadedMesh build() {
    if (from_.faces.empty())
      fail_in_mesh(name_, 0,
                   std::string("the mesh has no faces") +
                       (from_.free_form > 0 ? "; its curves and free-form surfaces are not read" : ""));
    size_t begin = 0;
    for (const MeshFace& face : from_.faces) {
      cancellation_point();
      line_ = face.line;
      add_face({from_.corners.data() + begin, face.end - begin});
      begin = face.end;
    }
    clean_unused();
    if (to_.mesh.triangles.empty()) fail_in_mesh(name_, 0, "no face of the mesh has an area");
    return std::move(to_);
  }

 private:
  /// Of vertices that no triangle has, values may be what no mesh may have.
  void clean_unused() {
    for (Vec3& normal : to_.mesh.normals)
      if (!is_normal(normal)) normal = Vec3(0.0f, 0.0f, 1.0f);
    for (Vec2& uv : to_.mesh.uvs)
      if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) uv = Vec2(0.0f);
  }

  const std::vector<Vec3>& positions() const { return keeps_ ? to_.mesh.positions : from_.positions; }
  const std::vector<Vec3>& normals() const { return keeps_ ? to_.mesh.normals : from_.normals; }
  const std::vector<Vec2>& uvs() const { return keeps_ ? to_.mesh.uvs : from_.uvs; }

  /// Throws InputError where a corner names what the file does not have: it has so many.
  void check(uint32_t number, size_t count, const char* kind) const {
    if (number >= count)
      fail_in_mesh(name_, line_,
                   fmt::format("a face names {} {}{}, but there are only {}", kind, uint64_t{number} + from_.first,
                               from_.first == 0 ? " (counted from 0)" : "", count));
  }

  /// Fills places_ with where the corners are.
  void find_places(std::span<const MeshCorner> corners) {
    places_.clear();
    for (const MeshCorner& corner : corners) {
      check(corner.position, vertices_, "vertex");
      places_.push_back(positions()[corner.position]);
      if (corner.uv < MeshCorner::kMissing) check(corner.uv, uvs().size(), "texture coordinate");
      if (corner.normal < MeshCorner::kMissing) check(corner.normal, normals().size(), "normal");
      if (is_finite(places_.back())) continue;
      fail_in_mesh(name_, from_.bad_positions.at(corner.position),
                   fmt::format("the position of vertex {}, which a face names, is not finite",
                               uint64_t{corner.position} + from_.first));
    }
  }

  void add_face(std::span<const MeshCorner> corners) {
    find_places(corners);
    if (corners.size() < 3) {
      ++to_.notes.without_area;
      return;
    }
    split_polygon(places_, split_);
    if (split_.crosses_itself)
      fail_in_mesh(name_, line_,
                   fmt::format("a face of {} corners crosses itself: split it into faces that do not", corners.size()));
    if (!split_.flat) ++to_.notes.not_plane;
    for (const auto& [a, b, c] : split_.triangles) {
      const Vec3d area = area_vector(places_[a], places_[b], places_[c]);
      if (area == Vec3d(0.0)) {
        ++to_.notes.without_area;
        continue;
      }
      const Vec3 own_normal(glm::normalize(area));
      to_.mesh.triangles.push_back(glm::uvec3{vertex(corners[a], own_normal), vertex(corners[b], own_normal),
                                              vertex(corners[c], own_normal)});  // braces: from left to right
    }
  }

  /// The number of the vertex that a corner of a triangle is.
  uint32_t vertex(const MeshCorner& corner, const Vec3& own_normal) {
    const bool own = has_normals_ && (corner.normal >= MeshCorner::kMissing || !is_normal(normals()[corner.normal]));
    if (own) {
      if (corner.normal != MeshCorner::kNone) ++to_.notes.bad_normals;
      return add_vertex(corner, own_normal);
    }
    if (keeps_) {
      if (has_uvs_) to_.mesh.uvs[corner.position] = uv_of(corner);
      return corner.position;
    }
    uint32_t* number = &first_[corner.position];
    while (*number != MeshCorner::kNone && !is_as(*number, corner)) number = &chain_[*number].next;
    if (*number != MeshCorner::kNone) return *number;
    const auto added = static_cast<uint32_t>(to_.mesh.positions.size());
    *number = added;
    return add_vertex(corner, has_normals_ ? normals()[corner.normal] : Vec3(0.0f));
  }

  bool is_as(uint32_t number, const MeshCorner& corner) const {
    return chain_[number].uv == corner.uv && chain_[number].normal == corner.normal;
  }

  uint32_t add_vertex(const MeshCorner& corner, const Vec3& normal) {
    const auto number = static_cast<uint32_t>(to_.mesh.positions.size());
    to_.mesh.positions.push_back(Vec3(positions()[corner.position]));
    if (has_normals_) to_.mesh.normals.push_back(normal);
    if (has_uvs_) to_.mesh.uvs.push_back(uv_of(corner));
    if (!keeps_) chain_.push_back({corner.uv, corner.normal});
    return number;
  }

  Vec2 uv_of(const MeshCorner& corner) {
    const Vec2 uv =
        corner.uv >= MeshCorner::kMissing ? Vec2(std::numeric_limits<float>::quiet_NaN()) : uvs()[corner.uv];
    if (std::isfinite(uv.x) && std::isfinite(uv.y)) return uv;
    if (to_.notes.without_uvs++ == 0) to_.notes.first_without_uvs = line_;
    return Vec2(0.0f);
  }

  /// A vertex that was made, by what its corner names; and the next one at the same position.
  struct Made {
    uint32_t uv = MeshCorner::kNone, normal = MeshCorner::kNone;
    uint32_t next = MeshCorner::kNone;
  };

  const std::string& name_;
  PolygonMesh from_;
  LoadedMesh to_;
  bool has_uvs_ = false, has_normals_ = false;
  bool keeps_ = false;   // the file's vertices
  size_t vertices_ = 0;  // of the file
  uint32_t line_ = 0;
  std::vector<uint32_t> first_;  // the vertex that was made first at each position of the file
  std::vector<Made> chain_;
  std::vector<Vec3> places_;  // of a face's corners
  PolygonSplit split_;
};

}  // namespace

void fail_in_mesh(const std::string& name, size_t line, const std::string& wrong) {
  throw InputError(name + (line > 0 ? ":" + std::to_string(line) : "") + ": " + wrong);
}

std::string_view without_mark(const std::string& name, std::string_view text) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    fail_in_mesh(name, 1, "the text is in UTF-16; save it as UTF-8 or ASCII");
  return text.substr(text.starts_with("\xef\xbb\xbf") ? 3 : 0);
}

LoadedMesh checked_mesh(const std::string& name, TriangleMesh mesh) {
  if (mesh.triangles.empty()) fail_in_mesh(name, 0, "the mesh has no faces");
  for (const glm::uvec3& t : mesh.triangles)
    if (const uint32_t largest = std::max({t.x, t.y, t.z}); largest >= mesh.positions.size())
      fail_in_mesh(name, 0,
                   fmt::format("a face names vertex {} (counted from 0), but there are only {}", largest,
                               mesh.positions.size()));
  LoadedMesh loaded{std::move(mesh), {}};
  loaded.notes.without_area = drop_flat_triangles(loaded.mesh);
  if (loaded.mesh.triangles.empty()) fail_in_mesh(name, 0, "no face of the mesh has an area");
  return loaded;
}

LoadedMesh load_mesh(const std::string& path) {
  const std::string extension = lower_extension(path);
  if (extension != ".ply" && extension != ".obj") fail_in_mesh(path, 0, "a mesh must be a .ply or .obj file");
  const std::string text = read_whole_file(path);
  return MeshBuilder(path, extension == ".ply" ? parse_ply(path, text) : parse_obj(path, text)).build();
}

}  // namespace vpm
