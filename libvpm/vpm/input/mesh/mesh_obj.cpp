// Wavefront OBJ: the lines `v`, `vt`, `vn` and `f` (or `fo`). Curves and free-form surfaces are counted; all other
// lines describe what a mesh here does not have.
//
// It is read here because tinyobjloader, as Debian 12 packages it (2.0.0~rc10), takes faces that name vertices which
// the file does not have (TALOS-2020-1212, mended upstream in 2023); damaged files must be refused with the line and
// the reason.
#include <algorithm>
#include <charconv>

#include "vpm/base/cancel.h"
#include "vpm/input/mesh/mesh_numbers.h"
#include "vpm/input/mesh/mesh_parts.h"

namespace vpm {
namespace {

/// Begins the line a surface that is none of polygons?
bool is_free_form(std::string_view keyword) {
  return keyword == "surf" || keyword == "curv" || keyword == "bsp" || keyword == "bzp" || keyword == "cdp";
}

class ObjReader {
 public:
  ObjReader(const std::string& name, std::string_view text) : name_(name), rest_(without_mark(name, text)) {
    mesh_.first = 1;
  }

  PolygonMesh read() {
    while (!rest_.empty()) {
      cancellation_point();
      next_line();
      const std::string_view keyword = next_word();
      if (keyword == "v") read_position();
      if (keyword == "vt") read_uv();
      if (keyword == "vn") mesh_.normals.push_back(read_three("a normal needs three coordinates"));
      if (keyword == "f" || keyword == "fo") read_face();  // which was the word before version 3
      if (is_free_form(keyword)) ++mesh_.free_form;
    }
    return std::move(mesh_);
  }

 private:
  /// The next line of the file, up to a line feed, a carriage return or both.
  std::string_view next_piece() {
    const size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    const std::string_view piece = rest_.substr(0, end);
    rest_.remove_prefix(end);
    if (!rest_.empty()) rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : 1);
    return piece;
  }

  /// A piece up to its comment, which does not begin in 1.#QNAN0.
  static std::string_view without_comment(std::string_view piece) {
    size_t comment = piece.find('#');
    while (comment != std::string_view::npos && comment > 0 && piece[comment - 1] == '.')
      comment = piece.find('#', comment + 1);
    return piece.substr(0, comment);
  }

  /// Takes up a line, with those that a backslash joins to it, without its comment. The backslash of a comment, as in
  /// the name of a folder, joins nothing.
  void next_line() {
    line_ = next_;
    words_ = without_comment(next_piece());
    ++next_;
    if (!words_.ends_with('\\')) return;
    joined_.clear();
    while (words_.ends_with('\\') && !rest_.empty()) {
      joined_ += words_.substr(0, words_.size() - 1);
      joined_ += ' ';
      words_ = without_comment(next_piece());
      ++next_;
    }
    joined_ += words_.substr(0, words_.size() - (words_.ends_with('\\') ? 1 : 0));
    words_ = joined_;
  }

  /// The next word of the line; empty at its end.
  std::string_view next_word() {
    constexpr std::string_view kSpace = " \t";
    words_.remove_prefix(std::min(words_.find_first_not_of(kSpace), words_.size()));
    const std::string_view word = words_.substr(0, words_.find_first_of(kSpace));
    words_.remove_prefix(word.size());
    return word;
  }

  /// NaN for all that is not finite.
  float next_coordinate(const char* missing) {
    const std::string_view word = next_word();
    if (word.empty()) fail_in_mesh(name_, line_, missing);
    const std::optional<float> value = number_in<float>(word);
    if (!value) fail_in_mesh(name_, line_, "the coordinate '" + std::string(word) + "' is not a finite number");
    return *value;
  }

  Vec3 read_three(const char* missing) {
    const float x = next_coordinate(missing), y = next_coordinate(missing), z = next_coordinate(missing);
    return {x, y, z};
  }

  void read_position() {
    const Vec3 position = read_three("a vertex needs three coordinates");
    if (!is_finite(position)) mesh_.bad_positions.emplace(static_cast<uint32_t>(mesh_.positions.size()), line_);
    mesh_.positions.push_back(position);
  }

  void read_uv() {
    const float u = next_coordinate("a texture coordinate needs a number");
    const std::string_view rest = words_;
    const float v = next_word().empty() ? 0.0f : (words_ = rest, next_coordinate(""));
    mesh_.uvs.emplace_back(u, v);
  }

  /// A number of a corner: counted from 1, or backwards from the last so far by negative numbers.
  uint32_t index(std::string_view digits, size_t so_far, const char* kind, std::string_view word) const {
    int64_t number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    const auto count = static_cast<int64_t>(so_far);
    const int64_t found = number < 0 ? count + number : number - 1;
    const bool clean = error == std::errc() && end == digits.data() + digits.size();
    if (!clean || number == 0 || found < 0 || found >= MeshCorner::kMissing)
      fail_in_mesh(name_, line_,
                   "'" + std::string(word) + "' names no " + kind + "; there are " + std::to_string(count) + " so far");
    return static_cast<uint32_t>(found);
  }

  /// Some writers put 0 where there is none.
  uint32_t value_index(std::string_view digits, size_t so_far, const char* kind, std::string_view word) const {
    return digits == "0" ? MeshCorner::kMissing : index(digits, so_far, kind, word);
  }

  /// `position[/[texture]][/normal]`.
  MeshCorner corner(std::string_view word) const {
    std::string_view rest = word;
    const auto next_part = [&rest] {
      const std::string_view part = rest.substr(0, rest.find('/'));
      rest.remove_prefix(std::min(part.size() + 1, rest.size()));
      return part;
    };
    MeshCorner corner;
    corner.position = index(next_part(), mesh_.positions.size(), "vertex", word);
    const std::string_view uv = next_part();
    if (!uv.empty()) corner.uv = value_index(uv, mesh_.uvs.size(), "texture coordinate", word);
    if (!rest.empty()) corner.normal = value_index(rest, mesh_.normals.size(), "normal", word);
    return corner;
  }

  void read_face() {
    for (std::string_view word = next_word(); !word.empty(); word = next_word()) mesh_.corners.push_back(corner(word));
    mesh_.faces.push_back({mesh_.corners.size(), line_});
  }

  const std::string& name_;
  std::string_view rest_, words_;
  std::string joined_;            // of several lines
  uint32_t line_ = 0, next_ = 1;  // where words_ began, and where rest_ begins
  PolygonMesh mesh_;
};

}  // namespace

PolygonMesh parse_obj(const std::string& name, std::string_view text) { return ObjReader(name, text).read(); }

}  // namespace vpm
