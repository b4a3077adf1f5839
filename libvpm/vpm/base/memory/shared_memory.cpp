// A file in memory, without a name: others open it by the number that its maker has it open under, and know it by the
// number that the system gives it.
#include "vpm/base/memory/shared_memory.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <cstdint>
#include <system_error>

#ifndef MADV_COLLAPSE  // Linux has it since 6.1, and the C library's headers since 2.37
#define MADV_COLLAPSE 25
#endif

namespace vpm {
namespace {

constexpr size_t kHugePage = size_t{2} << 20;
constexpr char kBeforeNumber = '#';

[[noreturn]] void fail(int error, int file, const std::string& what) {
  if (file >= 0) close(file);
  throw std::system_error(error, std::generic_category(), what);
}

ino_t number_of(int file) {
  struct stat found;
  return fstat(file, &found) == 0 ? found.st_ino : 0;
}

}  // namespace

SharedMemory::SharedMemory(size_t bytes) : file_(memfd_create("vpm", MFD_CLOEXEC)), bytes_(bytes) {
  assert(bytes > 0);
  if (file_ < 0 || ftruncate(file_, static_cast<off_t>(bytes)) != 0)
    fail(errno, file_, fmt::format("{} bytes of shared memory", bytes));
  map(PROT_READ | PROT_WRITE);
}

SharedMemory::SharedMemory(const std::string& address) {
  const size_t path_ends = address.rfind(kBeforeNumber);
  const std::string path = address.substr(0, path_ends);
  // Without O_NONBLOCK it could wait for what somebody else has there under this number.
  file_ = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file_ < 0) fail(errno, file_, path);
  if (path_ends == std::string::npos || std::to_string(number_of(file_)) != address.substr(path_ends + 1))
    fail(ENOENT, file_, path);
  bytes_ = static_cast<size_t>(lseek(file_, 0, SEEK_END));
  map(PROT_READ);
}

/// On a multiple of a huge page, without which it cannot lie on such.
void SharedMemory::map(int access) {
  const size_t room = bytes_ + kHugePage;
  void* const reserved = mmap(nullptr, room, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (reserved == MAP_FAILED) fail(errno, file_, fmt::format("{} bytes of shared memory", bytes_));
  auto* const begin = static_cast<std::byte*>(reserved);
  std::byte* const place = begin + (kHugePage - reinterpret_cast<uintptr_t>(begin) % kHugePage) % kHugePage;
  if (mmap(place, bytes_, access, MAP_SHARED | MAP_FIXED, file_, 0) == MAP_FAILED) {
    const int error = errno;
    munmap(reserved, room);
    fail(error, file_, fmt::format("{} bytes of shared memory", bytes_));
  }
  const auto page = static_cast<size_t>(sysconf(_SC_PAGESIZE));
  std::byte* const end = place + (bytes_ + page - 1) / page * page;
  if (place > begin) munmap(begin, static_cast<size_t>(place - begin));
  if (end < begin + room) munmap(end, static_cast<size_t>(begin + room - end));
  memory_ = place;
}

void SharedMemory::finish() {
  mprotect(memory_, bytes_, PROT_READ);
  madvise(memory_, bytes_ / kHugePage * kHugePage, MADV_COLLAPSE);  // if it is refused, pages are the usual ones
}

SharedMemory::~SharedMemory() {
  munmap(memory_, bytes_);
  close(file_);
}

std::string SharedMemory::address() const {
  return fmt::format("/proc/{}/fd/{}{}{}", getpid(), file_, kBeforeNumber, number_of(file_));
}

}  // namespace vpm
