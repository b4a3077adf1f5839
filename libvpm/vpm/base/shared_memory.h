// Memory that processes of one machine share. It is gone with the last of them, however they end.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace vpm {

class SharedMemory {
 public:
  /// So many bytes, one at least, all 0, on whole pages. Throws std::system_error where there is no room for them.
  explicit SharedMemory(size_t bytes);
  /// What another process, or this one, has made and still holds; it can be read only. Throws std::system_error where
  /// that is gone, or belongs to another user.
  explicit SharedMemory(const std::string& address);
  ~SharedMemory();
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  /// By which other processes of this machine find it while this process holds it.
  std::string address() const;
  /// Where its maker writes.
  std::byte* data() { return memory_; }
  std::span<const std::byte> bytes() const { return {memory_, bytes_}; }

 private:
  void map(int access);

  int file_ = -1;
  size_t bytes_ = 0;
  std::byte* memory_ = nullptr;
};

}  // namespace vpm
