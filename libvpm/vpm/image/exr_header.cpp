// A look at an OpenEXR file's headers before OpenEXR gets it: a walk from attribute to attribute.
#include "vpm/image/exr_header.h"

#include <cstdint>
#include <fstream>
#include <map>
#include <string>

#include "vpm/base/error.h"

namespace vpm {
namespace {

using std::filesystem::path;

constexpr uint32_t kMagic = 20000630;
constexpr uint32_t kManyParts = 0x1000;  // bit of the version word: headers follow each other up to an empty one

/// Types of one size, in bytes. OpenEXR reads these by type: where their size field differs, the rest is out of step.
const std::map<std::string, uint32_t> kFixedSizes = {{"box2f", 16},
                                                     {"box2i", 16},
                                                     {"chromaticities", 32},
                                                     {"compression", 1},
                                                     {"deepImageState", 1},
                                                     {"double", 8},
                                                     {"envmap", 1},
                                                     {"float", 4},
                                                     {"int", 4},
                                                     {"keycode", 28},
                                                     {"lineOrder", 1},
                                                     {"m33d", 72},
                                                     {"m33f", 36},
                                                     {"m44d", 128},
                                                     {"m44f", 64},
                                                     {"rational", 8},
                                                     {"tiledesc", 9},
                                                     {"timecode", 8},
                                                     {"v2d", 16},
                                                     {"v2f", 8},
                                                     {"v2i", 8},
                                                     {"v3d", 24},
                                                     {"v3f", 12},
                                                     {"v3i", 12}};

/// The bytes of a file from its beginning.
struct Reader {
  const path& file;
  std::ifstream in{file, std::ios::binary};
  uint64_t left = std::filesystem::file_size(file);

  [[noreturn]] void refuse(const std::string& why) const {
    throw InputError("cannot read '" + file.string() + "': " + why);
  }
  unsigned char byte() {
    const int c = in.get();
    if (c == EOF) refuse("it ends within its header");
    --left;
    return static_cast<unsigned char>(c);
  }
  /// A little-endian number.
  uint32_t word() {
    uint32_t value = 0;
    for (unsigned shift = 0; shift < 32; shift += 8) value |= uint32_t{byte()} << shift;
    return value;
  }
  /// A text of at most 255 bytes that ends with a zero byte.
  std::string text() {
    std::string result;
    while (const char c = static_cast<char>(byte())) {
      if (result.size() == 255) refuse("a name in its header is too long");
      result += c;
    }
    return result;
  }
  void skip(uint64_t bytes) {
    if (bytes > left) refuse("it ends within its header");
    in.seekg(static_cast<std::streamoff>(bytes), std::ios::cur);
    left -= bytes;
  }
};

/// The list of channels must end where its size says.
void check_channels(Reader& reader, uint32_t size) {
  const uint64_t end = reader.left - size;
  while (!reader.text().empty()) reader.skip(16);  // type, linearity, sampling
  if (reader.left != end) reader.refuse("the channel list in its header is damaged");
}

/// One attribute behind its name.
void check_attribute(Reader& reader, const std::string& name) {
  const std::string type = reader.text();
  const uint32_t size = reader.word();
  if (size > reader.left) reader.refuse("the attribute '" + name + "' of its header is longer than the file");
  const auto fixed = kFixedSizes.find(type);
  const bool fits = fixed != kFixedSizes.end() ? size == fixed->second : type != "floatvector" || size % 4 == 0;
  if (!fits) reader.refuse("the attribute '" + name + "' of its header has not the size of a " + type);
  if (type == "chlist") {
    check_channels(reader, size);
  } else {
    reader.skip(size);
  }
}

}  // namespace

void check_exr_header(const path& file) {
  Reader reader{file};
  if (reader.word() != kMagic) reader.refuse("it is no OpenEXR file");
  const bool many_parts = (reader.word() & kManyParts) != 0;
  std::string name = reader.text();
  do {
    for (; !name.empty(); name = reader.text()) check_attribute(reader, name);
    if (many_parts) name = reader.text();
  } while (!name.empty());
}

}  // namespace vpm
