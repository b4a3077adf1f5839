// Locks of flock(), which end with the process.
#include "vpm/base/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "vpm/base/error.h"

namespace vpm {
namespace {

/// Whether the path still leads to the open file: whoever held the lock before may have removed it.
bool is_at(const std::filesystem::path& path, int file) {
  struct stat opened, found;
  return fstat(file, &opened) == 0 && stat(path.c_str(), &found) == 0 && opened.st_dev == found.st_dev &&
         opened.st_ino == found.st_ino;
}

}  // namespace

FileLock::FileLock(const std::filesystem::path& path) : path_(path) {
  const auto refuse = [&](int error) {
    if (file_ >= 0) close(file_);
    if (error == EWOULDBLOCK) throw InputError("'" + path.string() + "' is locked: another run writes the same files");
    throw InputError("cannot lock '" + path.string() + "': " + std::generic_category().message(error));
  };
  for (;;) {
    file_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file_ < 0 || flock(file_, LOCK_EX | LOCK_NB) != 0) refuse(errno);
    if (is_at(path, file_)) return;
    close(file_);
  }
}

FileLock::~FileLock() {
  unlink(path_.c_str());
  close(file_);
}

}  // namespace vpm
