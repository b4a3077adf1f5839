// Reading a .vdb file byte by byte, never past its end.
#include "vpm/input/grid/vdb_cursor.h"

#include <fmt/format.h>
#include <filesystem>

#include "vpm/base/cancel.h"
#include "vpm/base/error.h"

namespace vpm {

VdbCursor::VdbCursor(const std::string& path) : path_(path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw InputError(fmt::format("{}: no such file", path));
  if (!std::filesystem::is_regular_file(status))
    throw InputError(fmt::format("{}: is not a file; a .vdb file is needed", path));
  size_ = std::filesystem::file_size(path, error);
  file_.open(path, std::ios::binary);
  if (!file_ || error) throw InputError(fmt::format("{}: cannot be read (is it permitted?)", path));
  file_.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
}

std::string VdbCursor::read_string(uint32_t longest) {
  const auto length = read<uint32_t>();
  if (length > longest) damaged(fmt::format("a name of {} bytes", length));
  std::string text(length, '\0');
  read_bytes(text.data(), length);
  return text;
}

void VdbCursor::read_bytes(void* to, uint64_t count) {
  need(count);
  file_.read(static_cast<char*>(to), static_cast<std::streamsize>(count));
  position_ += count;
}

void VdbCursor::skip(uint64_t count) {
  need(count);
  file_.ignore(static_cast<std::streamsize>(count));
  position_ += count;
}

void VdbCursor::seek(uint64_t position) {
  if (position > size_) damaged(fmt::format("it points at byte {} of {}", position, size_));
  file_.seekg(static_cast<std::streamoff>(position));
  position_ = position;
}

void VdbCursor::need(uint64_t count) const {
  cancellation_point();
  if (count > remaining())
    throw InputError(
        fmt::format("{}: damaged or truncated: {} more bytes are needed at byte {}, the file ends at byte {}", path_,
                    count, position_, size_));
}

void VdbCursor::damaged(const std::string& what) const {
  throw InputError(fmt::format("{}: damaged at byte {}: {}", path_, position_, what));
}

}  // namespace vpm
