// That one process at a time writes a file which is written again and again.
#pragma once

#include <filesystem>

namespace vpm {

/// A lock that the system lets go of when the process ends, however it ends. It is held on a file of its own, which the
/// destructor removes; a process that was killed leaves it, and the next one takes it over.
class FileLock {
 public:
  /// Throws InputError where another process holds the lock, and where no file can be made at `path`.
  explicit FileLock(const std::filesystem::path& path);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  std::filesystem::path path_;
  int file_ = -1;
};

}  // namespace vpm
