// PLY: a header that describes elements of properties, then their values as text or as bytes of either order.
//
// It is read here because Debian 12 packages no reader of PLY alone, and because damaged files must be refused with the
// line and the reason.
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "vpm/base/cancel.h"
#include "vpm/input/mesh/mesh_numbers.h"
#include "vpm/input/mesh/mesh_parts.h"

namespace vpm {
namespace {

struct ScalarType {
  std::string_view name, old_name;
  size_t bytes;
  bool integer;
  double (*decode)(const char*);  // from bytes in this machine's order
};

template <class T>
double decode_as(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}

constexpr std::array<ScalarType, 8> kTypes = {{{"int8", "char", 1, true, decode_as<int8_t>},
                                               {"uint8", "uchar", 1, true, decode_as<uint8_t>},
                                               {"int16", "short", 2, true, decode_as<int16_t>},
                                               {"uint16", "ushort", 2, true, decode_as<uint16_t>},
                                               {"int32", "int", 4, true, decode_as<int32_t>},
                                               {"uint32", "uint", 4, true, decode_as<uint32_t>},
                                               {"float32", "float", 4, false, decode_as<float>},
                                               {"float64", "double", 8, false, decode_as<double>}}};

/// The values of a vertex: position, normal, texture coordinate; and what writers call them.
constexpr size_t kSlots = 8;
struct SlotName {
  std::string_view name;
  int slot;
};
constexpr std::array<SlotName, 12> kSlotNames = {{{"x", 0},
                                                  {"y", 1},
                                                  {"z", 2},
                                                  {"nx", 3},
                                                  {"ny", 4},
                                                  {"nz", 5},
                                                  {"u", 6},
                                                  {"v", 7},
                                                  {"s", 6},
                                                  {"t", 7},
                                                  {"texture_u", 6},
                                                  {"texture_v", 7}}};

struct Property {
  std::string name;
  const ScalarType* type = nullptr;
  const ScalarType* count_type = nullptr;  // of a list's length; null: a single value
};
struct Element {
  std::string name;
  uint64_t count = 0;
  std::vector<Property> properties;
};

class PlyReader {
 public:
  PlyReader(const std::string& name, std::string_view text) : name_(name), rest_(without_mark(name, text)) {
    const size_t end = rest_.find_first_of("\r\n");
    if (end < rest_.size() && !rest_.substr(end).starts_with("\r\n")) line_end_ = rest_[end];
  }

  PolygonMesh read() {
    read_header();
    for (const Element& element : elements_) {
      check_count(element);
      if (element.name == "vertex")
        read_vertices(element);
      else if (element.name == "face")
        read_faces(element, [this](const Property& property, uint64_t face) { read_polygon(property, face); });
      else if (element.name == "tristrips")
        read_faces(element, [this](const Property& property, uint64_t) { read_strips(property); });
      else
        skip(element);
    }
    mesh_.values_of_vertices = has_uvs_ || uvs_of_corners_.empty();
    if (!has_uvs_) mesh_.uvs = std::move(uvs_of_corners_);
    for (MeshCorner& corner : mesh_.corners) {  // vertices may stand behind faces
      if (has_uvs_) corner.uv = corner.position;
      if (has_normals_) corner.normal = corner.position;
    }
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& wrong) const { fail_in_mesh(name_, line_in_text(), wrong); }
  uint32_t line_in_text() const { return binary_ ? 0 : line_; }

  // The header ----------------------------------------------------------------------------------------------------

  std::vector<std::string> next_header_line() {
    ++line_;
    const size_t end = rest_.find(line_end_);
    if (end == std::string_view::npos) fail("the file ends within its header");
    std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    std::vector<std::string> words;
    constexpr std::string_view kSpace = " \t\r";
    for (line.remove_prefix(std::min(line.find_first_not_of(kSpace), line.size())); !line.empty();
         line.remove_prefix(std::min(line.find_first_not_of(kSpace), line.size()))) {
      words.emplace_back(line.substr(0, line.find_first_of(kSpace)));
      line.remove_prefix(words.back().size());
    }
    return words;
  }

  void read_header() {
    if (next_header_line() != std::vector<std::string>{"ply"}) fail("not a PLY file: the first line is not 'ply'");
    bool format = false;
    for (std::vector<std::string> words = next_header_line(); words != std::vector<std::string>{"end_header"};
         words = next_header_line()) {
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "format" && words.size() == 3) {
        read_format(words);
        format = true;
      } else if (words[0] == "element" && words.size() == 3) {
        elements_.push_back({words[1], parse_count(words[2]), {}});
      } else if (words[0] == "property" && !elements_.empty()) {
        read_property(words);
      } else {
        fail("cannot read the header line that starts with '" + words[0] + "'");
      }
    }
    if (!format) fail("the header has no format");
    const auto is_vertex = [](const Element& element) { return element.name == "vertex"; };
    if (std::count_if(elements_.begin(), elements_.end(), is_vertex) > 1) fail("two elements are called vertex");
    binary_ = binary_body_;
    ++line_;
  }

  void read_format(const std::vector<std::string>& words) {
    const bool little = words[1] == "binary_little_endian", big = words[1] == "binary_big_endian";
    if ((!little && !big && words[1] != "ascii") || words[2] != "1.0")
      fail("unknown format '" + words[1] + " " + words[2] +
           "'; known are ascii, binary_little_endian and binary_big_endian 1.0");
    binary_body_ = little || big;
    swap_ = little != (std::endian::native == std::endian::little);
  }

  uint64_t parse_count(const std::string& word) const {
    uint64_t count = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), count);
    if (error != std::errc() || end != word.data() + word.size()) fail("'" + word + "' is no count of elements");
    return count;
  }

  const ScalarType* type_of(const std::string& word) const {
    for (const ScalarType& type : kTypes)
      if (word == type.name || word == type.old_name) return &type;
    fail("unknown type '" + word + "' of a property");
  }

  void read_property(const std::vector<std::string>& words) {
    Property property;
    if (words.size() == 3)
      property = {words[2], type_of(words[1]), nullptr};
    else if (words.size() == 5 && words[1] == "list")
      property = {words[4], type_of(words[3]), type_of(words[2])};
    else
      fail("cannot read this property");
    if (property.count_type && !property.count_type->integer) fail("the length of a list must be of an integer type");
    elements_.back().properties.push_back(property);
  }

  /// Refuses counts for which the rest of the file is too short, before anything is allocated.
  void check_count(const Element& element) const {
    size_t least = 0;  // bytes of an element
    for (const Property& p : element.properties)
      least += binary_ ? (p.count_type ? p.count_type->bytes : p.type->bytes) : 1;
    if (element.count > 0 && element.properties.empty()) fail("the element '" + element.name + "' has no properties");
    if (element.count > 0 && element.count > rest_.size() / least)
      fail("the header announces " + std::to_string(element.count) + " elements '" + element.name +
           "', more than the file can hold");
    if (element.count > std::numeric_limits<uint32_t>::max()) fail("more than 2^32 elements '" + element.name + "'");
  }

  // The body ------------------------------------------------------------------------------------------------------

  double next(const ScalarType& type) { return binary_ ? next_bytes(type) : next_word(type); }

  double next_bytes(const ScalarType& type) {
    if (rest_.size() < type.bytes) fail("the file ends too early");
    char bytes[8];
    std::memcpy(bytes, rest_.data(), type.bytes);
    if (swap_) std::reverse(bytes, bytes + type.bytes);
    rest_.remove_prefix(type.bytes);
    return type.decode(bytes);
  }

  double next_word(const ScalarType& type) {
    constexpr std::string_view kSpace = " \t\r\n";
    const std::string_view space = rest_.substr(0, rest_.find_first_not_of(kSpace));
    line_ += static_cast<uint32_t>(std::count(space.begin(), space.end(), line_end_));
    rest_.remove_prefix(space.size());
    if (rest_.empty()) fail("the file ends too early");
    const std::string_view word = rest_.substr(0, rest_.find_first_of(kSpace));
    const std::optional<double> value = number_in<double>(word);
    if (!value || (type.integer && *value != std::floor(*value)))
      fail("'" + std::string(word.substr(0, 40)) + "' is not " + (type.integer ? "an integer" : "a number"));
    rest_.remove_prefix(word.size());
    return *value;
  }

  uint64_t next_length(const Property& property) {
    const double length = next(*property.count_type);
    const size_t most = rest_.size() / (binary_ ? property.type->bytes : 1);
    if (!(length >= 0.0 && length <= static_cast<double>(most)))
      fail("a list '" + property.name + "' has an impossible length");
    return static_cast<uint64_t>(length);
  }

  void skip(const Property& property) {
    const uint64_t values = property.count_type ? next_length(property) : 1;
    for (uint64_t i = 0; i < values; ++i) next(*property.type);
  }

  void skip(const Element& element) {
    for (uint64_t i = 0; i < element.count; ++i) {
      cancellation_point();
      for (const Property& property : element.properties) skip(property);
    }
  }

  /// Which of a vertex' kSlots values each property holds, or -1.
  std::vector<int> slots_of(const Element& element) const {
    std::vector<int> slots;
    for (const Property& p : element.properties) {
      const auto known = std::find_if(kSlotNames.begin(), kSlotNames.end(),
                                      [&](const SlotName& slot) { return slot.name == p.name && !p.count_type; });
      slots.push_back(known == kSlotNames.end() ? -1 : known->slot);
    }
    return slots;
  }

  /// Do the slots from `first` to `last` stand among a vertex' properties? Once each, or all of them not.
  bool has_slots(const std::vector<int>& slots, int first, int last, const std::string& what) const {
    const auto within = [&](int slot) { return slot >= first && slot <= last; };
    if (std::none_of(slots.begin(), slots.end(), within)) return false;
    for (int slot = first; slot <= last; ++slot)
      if (std::count(slots.begin(), slots.end(), slot) != 1) fail("a vertex needs the properties " + what);
    return true;
  }

  void read_vertices(const Element& element) {
    const std::vector<int> slots = slots_of(element);
    if (!has_slots(slots, 0, 2, "x, y and z once each")) fail("a vertex needs the properties x, y and z once each");
    has_normals_ = has_slots(slots, 3, 5, "nx, ny and nz once each, or none of them");
    has_uvs_ = has_slots(slots, 6, 7, "u and v (or s and t, texture_u and texture_v) once each, or none of them");
    mesh_.positions.reserve(element.count);
    for (uint64_t i = 0; i < element.count; ++i) {
      cancellation_point();
      std::array<float, kSlots> value{};
      for (size_t p = 0; p < slots.size(); ++p) {
        if (slots[p] < 0)
          skip(element.properties[p]);
        else
          value[static_cast<size_t>(slots[p])] = static_cast<float>(next(*element.properties[p].type));
      }
      add_vertex(value);
    }
  }

  void add_vertex(const std::array<float, kSlots>& value) {
    const Vec3 position(value[0], value[1], value[2]);
    if (!is_finite(position))
      mesh_.bad_positions.emplace(static_cast<uint32_t>(mesh_.positions.size()), line_in_text());
    mesh_.positions.push_back(position);
    if (has_normals_) mesh_.normals.emplace_back(value[3], value[4], value[5]);
    if (has_uvs_) mesh_.uvs.emplace_back(value[6], value[7]);
  }

  /// Calls read_one(property, number) for the list of corners of each.
  template <class ReadOne>
  void read_faces(const Element& element, ReadOne read_one) {
    const auto is_corners = [](const Property& p) {
      return p.count_type && (p.name == "vertex_indices" || p.name == "vertex_index");
    };
    if (std::count_if(element.properties.begin(), element.properties.end(), is_corners) != 1)
      fail("the element '" + element.name + "' needs one list property vertex_indices");
    for (uint64_t i = 0; i < element.count; ++i) {
      cancellation_point();
      const size_t before = mesh_.corners.size();
      std::vector<Vec2> uvs;
      for (const Property& property : element.properties) {
        if (is_corners(property))
          read_one(property, i);
        else if (property.count_type && property.name == "texcoord")
          uvs = next_uvs(property);
        else
          skip(property);
      }
      add_uvs(uvs, before, i);
    }
  }

  /// Texture coordinates of the corners of a face, as MeshLab writes them.
  std::vector<Vec2> next_uvs(const Property& property) {
    const uint64_t length = next_length(property);
    if (length % 2 != 0) fail("a list texcoord has an odd length: two numbers make a coordinate");
    std::vector<Vec2> uvs(length / 2);
    for (Vec2& uv : uvs)
      for (int axis = 0; axis < 2; ++axis) uv[axis] = static_cast<float>(next(*property.type));
    return uvs;
  }

  void add_uvs(const std::vector<Vec2>& uvs, size_t first_corner, uint64_t face) {
    if (uvs.empty()) return;
    if (uvs.size() != mesh_.corners.size() - first_corner)
      fail("face " + std::to_string(face) + " has " + std::to_string(mesh_.corners.size() - first_corner) +
           " corners and " + std::to_string(uvs.size()) + " texture coordinates");
    for (size_t i = 0; i < uvs.size(); ++i) {
      mesh_.corners[first_corner + i].uv = static_cast<uint32_t>(uvs_of_corners_.size());
      uvs_of_corners_.push_back(uvs[i]);
    }
  }

  uint64_t next_count_of_corners(const Property& property) {
    if (!property.type->integer) fail("the list '" + property.name + "' must be of an integer type");
    return next_length(property);
  }

  void add_corner(double index) { mesh_.corners.push_back({.position = static_cast<uint32_t>(index)}); }
  void end_face() { mesh_.faces.push_back({mesh_.corners.size(), line_in_text()}); }

  void read_polygon(const Property& property, uint64_t face) {
    const uint64_t count = next_count_of_corners(property);
    for (uint64_t i = 0; i < count; ++i) {
      const double index = next(*property.type);
      if (!(index >= 0.0 && index < MeshCorner::kMissing))
        fail("face " + std::to_string(face) + " names a vertex of negative or huge number");
      add_corner(index);
    }
    end_face();
  }

  /// Strips of triangles, each of a corner and the two before it, turning left and right by turns; -1 ends a strip.
  void read_strips(const Property& property) {
    const uint64_t count = next_count_of_corners(property);
    std::array<double, 2> before{};
    uint64_t in_strip = 0;
    for (uint64_t i = 0; i < count; ++i) {
      const double index = next(*property.type);
      if (!(index < MeshCorner::kMissing)) fail("a strip of triangles names a vertex of huge number");
      if (index < 0.0) {
        in_strip = 0;
        continue;
      }
      if (++in_strip > 2) {
        for (const double corner : {before[1 - in_strip % 2], before[in_strip % 2], index}) add_corner(corner);
        end_face();
      }
      before = {before[1], index};
    }
  }

  const std::string& name_;
  std::string_view rest_;
  uint32_t line_ = 0;
  char line_end_ = '\n';  // the last character of a line
  bool binary_ = false, binary_body_ = false, swap_ = false;
  bool has_normals_ = false, has_uvs_ = false;  // of the vertices
  std::vector<Element> elements_;
  std::vector<Vec2> uvs_of_corners_;
  PolygonMesh mesh_;
};

}  // namespace

PolygonMesh parse_ply(const std::string& name, std::string_view text) { return PlyReader(name, text).read(); }

}  // namespace vpm
