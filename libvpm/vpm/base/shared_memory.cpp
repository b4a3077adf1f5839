// A file in memory, without a name: others open it by the number that its maker has it open under.
#include "vpm/base/shared_memory.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <system_error>

#include "vpm/base/huge_pages.h"

namespace vpm {
namespace {

[[noreturn]] void fail(int error, int file) {
  if (file >= 0) close(file);
  throw std::system_error(error, std::generic_category());
}

}  // namespace

SharedMemory::SharedMemory(size_t bytes) : file_(memfd_create("vpm", MFD_CLOEXEC)), bytes_(bytes) {
  assert(bytes > 0);
  if (file_ < 0) fail(errno, file_);
  // It takes memory as it is written to, as what is allocated does.
  if (ftruncate(file_, static_cast<off_t>(bytes)) != 0) fail(errno, file_);
  map(PROT_READ | PROT_WRITE);
}

SharedMemory::SharedMemory(const std::string& address) : file_(open(address.c_str(), O_RDONLY | O_CLOEXEC)) {
  struct stat opened;
  if (file_ < 0 || fstat(file_, &opened) != 0) fail(errno, file_);
  bytes_ = static_cast<size_t>(opened.st_size);
  map(PROT_READ);
}

void SharedMemory::map(int access) {
  void* const memory = mmap(nullptr, bytes_, access, MAP_SHARED, file_, 0);
  if (memory == MAP_FAILED) fail(errno, file_);
  memory_ = static_cast<std::byte*>(memory);
  ask_for_huge_pages(memory_, bytes_);
}

SharedMemory::~SharedMemory() {
  munmap(memory_, bytes_);
  close(file_);
}

std::string SharedMemory::address() const { return fmt::format("/proc/{}/fd/{}", getpid(), file_); }

}  // namespace vpm
