// A bounds-checked reading position in a .vdb file: nothing is read, skipped or allocated beyond what the file holds.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>

namespace vpm {

class VdbCursor {
 public:
  /// Opens the file. Throws InputError where it cannot be read.
  explicit VdbCursor(const std::string& path);

  /// The next value, as stored (little endian). Throws InputError at the end of the file, as all of these do.
  template <class T>
  T read() {
    T value;
    read_bytes(&value, sizeof(T));
    return value;
  }
  /// A string that follows its length in four bytes; more than `longest` bytes count as damage.
  std::string read_string(uint32_t longest = 4096);
  void read_bytes(void* to, uint64_t count);
  void skip(uint64_t count);
  void seek(uint64_t position);
  uint64_t position() const { return position_; }
  uint64_t remaining() const { return size_ - position_; }
  uint64_t size() const { return size_; }
  const std::string& path() const { return path_; }
  /// The stream itself, at position(); it throws std::ios_base::failure at the end of the file.
  std::istream& stream() { return file_; }

  /// Throws InputError: "<path>: damaged at byte N: <what>".
  [[noreturn]] void damaged(const std::string& what) const;

 private:
  void need(uint64_t count) const;

  std::string path_;
  std::ifstream file_;
  uint64_t size_ = 0;
  uint64_t position_ = 0;
};

}  // namespace vpm
