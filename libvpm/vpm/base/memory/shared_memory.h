// Memory that processes of one machine share. It is gone with the last of them, however they end.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace vpm {

class SharedMemory {
 public:
  /// So many bytes, one at least, all 0, from a multiple of 2 MiB on. Pages are taken from the system as they are
  /// written to: where it has none left then, it ends the process. Throws std::system_error where it refuses so many in
  /// advance, because of limits of this process's files, say.
  explicit SharedMemory(size_t bytes);
  /// What a process of the same user has made and still holds, which may be this one. Throws std::system_error where
  /// nothing of that address is to be had.
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
