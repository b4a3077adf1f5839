// Wavefront OBJ: the lines `v` and `f`; all others describe what a mesh here does not have.
#include <charconv>
#include <cmath>
#include <limits>

#include "input/mesh_parts.h"

namespace vpm {
namespace {

class ObjReader {
 public:
  ObjReader(const std::string& name, std::string_view text) : name_(name), rest_(text) {}

  TriangleMesh read() {
    while (!rest_.empty()) {
      ++line_;
      const size_t end = std::min(rest_.find('\n'), rest_.size());
      words_ = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      words_ = words_.substr(0, words_.find('#'));
      const std::string_view keyword = next_word();
      if (keyword == "v") read_vertex();
      if (keyword == "f") read_face();
    }
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

  float next_coordinate() {
    const std::string_view word = next_word();
    float value = 0.0f;
    const size_t plus = word.starts_with('+') ? 1 : 0;
    const auto [end, error] = std::from_chars(word.data() + plus, word.data() + word.size(), value);
    if (word.empty()) fail_in_mesh(name_, line_, "a vertex needs three coordinates");
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
      fail_in_mesh(name_, line_, "the coordinate '" + std::string(word) + "' is not a finite number");
    return value;
  }

  void read_vertex() {
    const float x = next_coordinate(), y = next_coordinate(), z = next_coordinate();
    mesh_.positions.emplace_back(x, y, z);
  }

  /// `position[/[texture]][/normal]`: counted from 1, or backwards from the last vertex so far by negative numbers.
  uint32_t corner(std::string_view word) const {
    int64_t number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    const auto count = static_cast<int64_t>(mesh_.positions.size());
    const int64_t index = number < 0 ? count + number : number - 1;
    const bool clean = error == std::errc() && (end == word.data() + word.size() || *end == '/');
    if (!clean || number == 0 || index < 0 || index > std::numeric_limits<uint32_t>::max())
      fail_in_mesh(name_, line_,
                   "'" + std::string(word) + "' names no vertex; there are " + std::to_string(count) + " so far");
    return static_cast<uint32_t>(index);
  }

  void read_face() {
    std::vector<uint32_t> corners;
    for (std::string_view word = next_word(); !word.empty(); word = next_word()) corners.push_back(corner(word));
    if (corners.size() < 3) fail_in_mesh(name_, line_, "a face needs at least three corners");
    add_fan(corners, mesh_);
  }

  const std::string& name_;
  std::string_view rest_, words_;
  size_t line_ = 0;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh parse_obj(const std::string& name, std::string_view text) { return ObjReader(name, text).read(); }

}  // namespace vpm
