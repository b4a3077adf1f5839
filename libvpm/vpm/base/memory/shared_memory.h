// Memory that processes of one machine share. It is gone with the last of them, however they end.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace vpm {

class SharedMemory {
 public:
  /// `bytes` (at least 1) bytes of 0, aligned to 2 MiB. The system provides pages only as they are written to, and ends
  /// the process if it has none left by then. Throws std::system_error if it refuses the size in advance, say for a
  /// limit on the size of this process's files.
  explicit SharedMemory(size_t bytes);
  /// Memory that a process of the same user has made and still holds; this process may be that one. Throws
  /// std::system_error if there is none of that address.
  explicit SharedMemory(const std::string& address);
  ~SharedMemory();
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  /// By which other processes of this machine find it.
  std::string address() const;
  std::span<const std::byte> bytes() const { return {memory_, bytes_}; }

  /// Where its maker writes, until it has finished.
  std::byte* data() { return memory_; }
  /// From now on nobody can write to it. It moves to pages of 2 MiB where the system knows how (Linux 6.1): see
  /// base/memory/huge_pages.h.
  void finish();

 private:
  void map(int access);

  int file_ = -1;
  size_t bytes_ = 0;
  std::byte* memory_ = nullptr;
};

}  // namespace vpm
