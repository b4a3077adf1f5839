// Reading the table of contents of a .vdb file.
#include "vpm/input/grid/vdb_layout.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "vpm/base/error.h"
#include "vpm/base/letters.h"

namespace vpm {
namespace {

constexpr std::string_view kHalfSuffix = "_HalfFloat";
constexpr char kNumberMark = '\x1e';  // stands between a name and its number where the name repeats
constexpr uint32_t kOldest = 222;     // node masks are compressed as they still are
constexpr uint32_t kNewest = 225;     // adds a grid type; the layout of the others is unchanged

/// Control characters, which a terminal might obey, become question marks.
std::string printable(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return text;
}

/// "name\x1e2" becomes "name[2]".
std::string readable_name(const std::string& stored) {
  const size_t mark = stored.find(kNumberMark);
  if (mark == std::string::npos) return printable(stored);
  return printable(stored.substr(0, mark)) + "[" + printable(stored.substr(mark + 1)) + "]";
}

std::string base_name(const std::string& name) {
  const size_t bracket = name.find('[');
  return bracket == std::string::npos || name.back() != ']' ? name : name.substr(0, bracket);
}

void check_magic(VdbCursor& cursor) {
  constexpr std::string_view kMagic(" BDV\0\0\0\0", 8);
  constexpr std::string_view kLfs = "version https://git-lfs";
  std::array<char, kLfs.size()> start{};
  const uint64_t count = std::min<uint64_t>(start.size(), cursor.size());
  cursor.read_bytes(start.data(), count);
  const std::string_view text(start.data(), count);
  if (text == kLfs)
    throw InputError(
        fmt::format("{}: is not a .vdb file but a git-lfs pointer to one; fetch the file itself with 'git lfs pull'",
                    cursor.path()));
  if (count == 0) throw InputError(fmt::format("{}: is empty; a .vdb file is needed", cursor.path()));
  if (text.starts_with("NanoVDB"))
    throw InputError(
        fmt::format("{}: is a NanoVDB file, which is not read; nanovdb_convert makes a .vdb of it", cursor.path()));
  if (!text.starts_with(kMagic)) throw InputError(fmt::format("{}: is not a .vdb file", cursor.path()));
  cursor.seek(kMagic.size());
}

/// Skips all metadata fields except the grid's class and number of active voxels.
void read_metadata(VdbCursor& cursor, VdbGridEntry& entry) {
  const auto count = cursor.read<uint32_t>();
  for (uint32_t i = 0; i < count; ++i) {
    const std::string name = cursor.read_string();
    const std::string type = cursor.read_string();
    if (name == "class" && type == "string") {
      entry.grid_class = printable(cursor.read_string());
    } else if (name == "file_voxel_count" && type == "int64") {
      cursor.skip(sizeof(uint32_t));
      entry.stated_voxels = cursor.read<uint64_t>();
    } else {
      cursor.skip(cursor.read<uint32_t>());
    }
  }
}

/// Reads one descriptor and what it points at; returns the position of the next one.
uint64_t read_grid_entry(VdbCursor& cursor, bool has_offsets, VdbGridEntry& entry) {
  entry.name = readable_name(cursor.read_string());
  entry.type = printable(cursor.read_string());
  if (entry.type.ends_with(kHalfSuffix)) {
    entry.stored_half = true;
    entry.type.resize(entry.type.size() - kHalfSuffix.size());
  }
  entry.tree_of = readable_name(cursor.read_string());
  const auto begin = cursor.read<uint64_t>();
  cursor.skip(sizeof(uint64_t));  // where the leaf blocks begin: they follow the tree
  const auto end = cursor.read<uint64_t>();
  if (has_offsets) {
    if (begin < cursor.position() || end < begin)
      cursor.damaged(fmt::format("grid '{}' lies at bytes {} to {}", entry.name, begin, end));
    if (end > cursor.size())
      throw InputError(fmt::format("{}: truncated: grid '{}' ends at byte {}, the file at byte {}", cursor.path(),
                                   entry.name, end, cursor.size()));
    cursor.seek(begin);
  }
  entry.compression = cursor.read<uint32_t>();
  if (entry.compression > 7) cursor.damaged(fmt::format("unknown compression {:#x}", entry.compression));
  read_metadata(cursor, entry);
  entry.transform_position = cursor.position();
  entry.map_type = printable(cursor.read_string());
  return end;
}

}  // namespace

std::string VdbGridEntry::value_type() const {
  std::string_view text = type;
  if (text.starts_with("Tree_")) text.remove_prefix(5);
  if (text.ends_with("_5_4_3")) text.remove_suffix(6);
  return std::string(text) + (stored_half ? " stored as half" : "");
}

uint64_t VdbGridEntry::value_bytes() const {
  constexpr std::array<std::pair<std::string_view, uint64_t>, 6> kTypes = {{{"Tree_float_5_4_3", 4},
                                                                            {"Tree_double_5_4_3", 8},
                                                                            {"Tree_int32_5_4_3", 4},
                                                                            {"Tree_int64_5_4_3", 8},
                                                                            {"Tree_bool_5_4_3", 1},
                                                                            {"Tree_mask_5_4_3", 1}}};
  for (const auto& [kind, bytes] : kTypes)
    if (type == kind) return bytes;
  return 0;
}

bool VdbGridEntry::affine() const {
  constexpr std::array<std::string_view, 7> kAffine = {
      "AffineMap", "ScaleMap", "UniformScaleMap", "TranslationMap", "ScaleTranslateMap", "UniformScaleTranslateMap",
      "UnitaryMap"};
  return std::find(kAffine.begin(), kAffine.end(), map_type) != kAffine.end();
}

const VdbGridEntry* VdbLayout::find(const std::string& name) const {
  const auto entry = std::find_if(grids.begin(), grids.end(), [&](const VdbGridEntry& e) { return e.name == name; });
  if (entry != grids.end()) return &*entry;
  const auto only_one = [this](const std::string& sought, auto name_of) -> const VdbGridEntry* {
    const VdbGridEntry* found = nullptr;
    for (const VdbGridEntry& e : grids) {
      if (name_of(e) != sought) continue;
      if (found) return nullptr;
      found = &e;
    }
    return found;
  };
  if (const auto* found = only_one(name, [](const VdbGridEntry& e) { return base_name(e.name); })) return found;
  return only_one(small_letters(name), [](const VdbGridEntry& e) { return small_letters(e.name); });
}

std::string VdbLayout::listing() const {
  if (grids.empty()) return "the file holds no grids";
  std::string text = "the file holds: ";
  for (size_t i = 0; i < grids.size(); ++i)
    text += fmt::format("{}{} ({}, {})", i ? ", " : "", grids[i].name, grids[i].value_type(),
                        grids[i].grid_class == "unknown" ? "class unknown" : grids[i].grid_class);
  return text;
}

VdbLayout read_vdb_layout(VdbCursor& cursor) {
  check_magic(cursor);
  VdbLayout layout;
  layout.file_version = cursor.read<uint32_t>();
  if (layout.file_version < kOldest || layout.file_version > kNewest)
    throw InputError(
        fmt::format("{}: has file format {}; formats {} to {} can be read: save it anew with a current OpenVDB",
                    cursor.path(), layout.file_version, kOldest, kNewest));
  layout.library_major = cursor.read<uint32_t>();
  layout.library_minor = cursor.read<uint32_t>();
  const bool has_offsets = cursor.read<uint8_t>() != 0;
  cursor.skip(36);  // a unique number, in text
  VdbGridEntry whole_file;
  read_metadata(cursor, whole_file);
  const auto count = cursor.read<int32_t>();
  if (count < 0) cursor.damaged(fmt::format("{} grids", count));
  if (!has_offsets && count > 1)
    throw InputError(fmt::format("{}: holds {} grids but not where each begins; save it with openvdb::io::File",
                                 cursor.path(), count));
  for (int32_t i = 0; i < count; ++i) {
    VdbGridEntry entry;
    const uint64_t next = read_grid_entry(cursor, has_offsets, entry);
    layout.grids.push_back(std::move(entry));
    if (has_offsets) cursor.seek(next);
  }
  return layout;
}

}  // namespace vpm
