// Writing a file so that nothing is lost: first a temporary sibling, then one rename onto the target.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace vpm {

/// An empty file in the target's folder, made by the constructor. Write to `path()`, close it, then `commit()`. What
/// was not committed is removed, so the target is always either the old file or the whole new one. A link is followed:
/// the file it points at is replaced.
class TemporaryFile {
 public:
  /// Throws InputError where `target` cannot be written: no such folder, no permission, a folder, a device, a
  /// write-protected file.
  explicit TemporaryFile(const std::filesystem::path& target);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Forces the bytes to the disk and renames the file onto the target. Throws InputError where the system refuses.
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path path_;
  bool committed_ = false;
};

/// Throws InputError where a file of `bytes` bytes could not be written to `target` now: what TemporaryFile refuses,
/// and a disk with too little space. The target itself is not touched.
void check_writable(const std::filesystem::path& target, uint64_t bytes);

/// Writes a file of that text. Throws InputError where that fails; the target is then what it was.
void write_text(const std::filesystem::path& target, const std::string& text);

}  // namespace vpm
