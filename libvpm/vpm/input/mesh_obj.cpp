// Wavefront OBJ: the lines `v`, `vt`, `vn` and `f`; all others describe what a mesh here does not have.
//
// It is read here because tinyobjloader, as Debian 12 packages it (2.0.0~rc10), takes faces that name vertices which
// the file does not have (TALOS-2020-1212, mended upstream in 2023); damaged files must be refused with the line and
// the reason.
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "vpm/base/cancel.h"
#include "vpm/input/mesh_parts.h"

namespace vpm {
namespace {

/// What a corner of a face names: numbers of a position and, where it has them, a texture coordinate and a normal.
struct Corner {
  uint32_t position = 0;
  std::optional<uint32_t> uv, normal;
  auto operator<=>(const Corner&) const = default;
};

class ObjReader {
 public:
  ObjReader(const std::string& name, std::string_view text) : name_(name), rest_(text) {}

  TriangleMesh read() {
    while (!rest_.empty()) {
      cancellation_point();
      ++line_;
      const size_t end = std::min(rest_.find('\n'), rest_.size());
      words_ = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      words_ = words_.substr(0, words_.find('#'));
      const std::string_view keyword = next_word();
      if (keyword == "v") positions_.push_back(read_three("a vertex needs three coordinates"));
      if (keyword == "vt") read_uv();
      if (keyword == "vn") read_normal();
      if (keyword == "f") read_face();
    }
    make_vertices();
    return std::move(mesh_);
  }

 private:
  /// The next word of the line; empty at its end.
  std::string_view next_word() {
    constexpr std::string_view kSpace = " \t\r";
    words_.remove_prefix(std::min(words_.find_first_not_of(kSpace), words_.size()));
    const std::string_view word = words_.substr(0, words_.find_first_of(kSpace));
    words_.remove_prefix(word.size());
    return word;
  }

  float next_coordinate(const char* missing) {
    const std::string_view word = next_word();
    float value = 0.0f;
    const size_t plus = word.starts_with('+') ? 1 : 0;
    const auto [end, error] = std::from_chars(word.data() + plus, word.data() + word.size(), value);
    if (word.empty()) fail_in_mesh(name_, line_, missing);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
      fail_in_mesh(name_, line_, "the coordinate '" + std::string(word) + "' is not a finite number");
    return value;
  }

  Vec3 read_three(const char* missing) {
    const float x = next_coordinate(missing), y = next_coordinate(missing), z = next_coordinate(missing);
    return {x, y, z};
  }

  void read_uv() {
    constexpr const char* kMissing = "a texture coordinate needs two numbers";
    const float u = next_coordinate(kMissing), v = next_coordinate(kMissing);
    uvs_.emplace_back(u, v);
  }

  void read_normal() {
    const Vec3 normal = read_three("a normal needs three coordinates");
    if (normal == Vec3(0.0f)) fail_in_mesh(name_, line_, "a normal must not be the zero vector");
    normals_.push_back(normal);
  }

  /// A number of a corner: counted from 1, or backwards from the last so far by negative numbers.
  uint32_t index(std::string_view digits, size_t so_far, const char* kind, std::string_view word) const {
    int64_t number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    const auto count = static_cast<int64_t>(so_far);
    const int64_t found = number < 0 ? count + number : number - 1;
    const bool clean = error == std::errc() && end == digits.data() + digits.size();
    if (!clean || number == 0 || found < 0 || found > std::numeric_limits<uint32_t>::max())
      fail_in_mesh(name_, line_,
                   "'" + std::string(word) + "' names no " + kind + "; there are " + std::to_string(count) + " so far");
    return static_cast<uint32_t>(found);
  }

  /// `position[/[texture]][/normal]`.
  Corner corner(std::string_view word) const {
    std::string_view rest = word;
    const auto next_part = [&rest] {
      const std::string_view part = rest.substr(0, rest.find('/'));
      rest.remove_prefix(std::min(part.size() + 1, rest.size()));
      return part;
    };
    Corner corner;
    corner.position = index(next_part(), positions_.size(), "vertex", word);
    const std::string_view uv = next_part();
    if (!uv.empty()) corner.uv = index(uv, uvs_.size(), "texture coordinate", word);
    if (!rest.empty()) corner.normal = index(rest, normals_.size(), "normal", word);
    return corner;
  }

  void read_face() {
    std::vector<uint32_t> numbers;
    for (std::string_view word = next_word(); !word.empty(); word = next_word()) {
      numbers.push_back(static_cast<uint32_t>(corners_.size()));
      corners_.push_back(corner(word));
      const Corner &first = corners_.front(), &last = corners_.back();
      if (first.uv.has_value() != last.uv.has_value() || first.normal.has_value() != last.normal.has_value())
        fail_in_mesh(name_, line_,
                     "some corners have texture coordinates or normals, and '" + std::string(word) +
                         "' differs: all of the mesh need them, or none");
    }
    if (numbers.size() < 3) fail_in_mesh(name_, line_, "a face needs at least three corners");
    add_fan(numbers, mesh_);
  }

  /// Turns the numbers of corners that triangles hold so far into numbers of vertices. Without texture coordinates and
  /// normals these are the file's own; else there is a vertex for each combination that a corner names.
  void make_vertices() {
    const bool plain = corners_.empty() || (!corners_.front().uv && !corners_.front().normal);
    std::map<Corner, uint32_t> numbers;
    for (glm::uvec3& triangle : mesh_.triangles)
      for (int i = 0; i < 3; ++i) {
        const Corner& corner = corners_[triangle[i]];
        triangle[i] = plain ? corner.position : numbers.try_emplace(corner, numbers.size()).first->second;
        if (!plain && triangle[i] == mesh_.positions.size()) add_vertex(corner);
      }
    if (plain) mesh_.positions = std::move(positions_);
  }

  void add_vertex(const Corner& corner) {
    mesh_.positions.push_back(named(positions_, corner.position, "vertex"));
    if (corner.uv) mesh_.uvs.push_back(named(uvs_, *corner.uv, "texture coordinate"));
    if (corner.normal) mesh_.normals.push_back(named(normals_, *corner.normal, "normal"));
  }

  template <class T>
  const T& named(const std::vector<T>& list, uint32_t number, const std::string& kind) const {
    if (number >= list.size())
      fail_in_mesh(name_, 0,
                   "a face names " + kind + " " + std::to_string(uint64_t{number} + 1) + ", but there are only " +
                       std::to_string(list.size()));
    return list[number];
  }

  const std::string& name_;
  std::string_view rest_, words_;
  size_t line_ = 0;
  std::vector<Vec3> positions_, normals_;
  std::vector<Vec2> uvs_;
  std::vector<Corner> corners_;
  TriangleMesh mesh_;  // its triangles hold numbers of corners until make_vertices()
};

}  // namespace

TriangleMesh parse_obj(const std::string& name, std::string_view text) { return ObjReader(name, text).read(); }

}  // namespace vpm
