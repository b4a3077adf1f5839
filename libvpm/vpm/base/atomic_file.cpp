// Writing a file so that nothing is lost: the system calls.
#include "vpm/base/atomic_file.h"

#include <fcntl.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <fstream>
#include <string>
#include <system_error>

#include "vpm/base/error.h"

namespace vpm {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& target, const std::string& why) {
  throw InputError("cannot write '" + target.string() + "': " + why);
}

std::string system_message() { return std::generic_category().message(errno); }

/// The plain file that writing to `target` makes or replaces, links followed.
fs::path resolve(const fs::path& target) {
  if (target.empty()) refuse(target, "the name is empty");
  std::error_code error;
  const fs::path file = fs::weakly_canonical(fs::absolute(target), error);
  if (error) refuse(target, error.message());
  const fs::file_status status = fs::status(file, error);
  if (fs::is_directory(status) || !file.has_filename()) refuse(target, "it is a folder; name a file in it");
  if (fs::exists(status) && !fs::is_regular_file(status)) refuse(target, "it is a device; name a plain file");
  const fs::path folder = file.parent_path();
  if (!fs::is_directory(folder, error)) refuse(target, "there is no folder '" + folder.string() + "'; make it first");
  if (fs::exists(status) && access(file.c_str(), W_OK) != 0) refuse(target, "the existing file is write-protected");
  return file;
}

/// Makes an empty file with a name of its own in `folder`. Not mkstemp: the permissions shall be the user's usual ones.
fs::path make_sibling(const fs::path& folder, const fs::path& target) {
  static std::atomic<unsigned> number{0};
  while (true) {
    const std::string name = ".vpm-" + std::to_string(getpid()) + "-" + std::to_string(number++) + ".tmp";
    const int file = open((folder / name).c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file >= 0) {
      close(file);
      return folder / name;
    }
    if (errno != EEXIST) refuse(target, "no file can be made in '" + folder.string() + "': " + system_message());
  }
}

/// Forces a file, or the entries of a folder, to the disk; false with errno set where that fails.
bool synchronise(const fs::path& path, int flags) {
  const int file = open(path.c_str(), flags | O_CLOEXEC);
  if (file < 0) return false;
  const bool done = fsync(file) == 0;
  const int reason = errno;
  const bool closed = close(file) == 0;
  if (!done) errno = reason;
  return done && closed;
}

}  // namespace

TemporaryFile::TemporaryFile(const fs::path& target)
    : target_(resolve(target)), path_(make_sibling(target_.parent_path(), target)) {}

TemporaryFile::~TemporaryFile() {
  std::error_code ignored;  // a destructor cannot report it
  if (!committed_) fs::remove(path_, ignored);
}

void TemporaryFile::commit() {
  if (!synchronise(path_, O_WRONLY)) refuse(target_, system_message());
  if (std::rename(path_.c_str(), target_.c_str()) != 0) refuse(target_, system_message());
  committed_ = true;
  // Some file systems cannot synchronise a folder and say so by EINVAL; there the rename is as safe as it gets.
  if (!synchronise(target_.parent_path(), O_RDONLY | O_DIRECTORY) && errno != EINVAL) refuse(target_, system_message());
}

void check_writable(const fs::path& target, uint64_t bytes) {
  const TemporaryFile probe(target);
  struct statvfs disk {};
  if (statvfs(probe.path().c_str(), &disk) != 0) refuse(target, system_message());
  const uint64_t free_bytes = static_cast<uint64_t>(disk.f_bavail) * disk.f_frsize;
  if (free_bytes < bytes) {
    refuse(target, "the disk has " + std::to_string(free_bytes >> 20) + " MiB free, " +
                       std::to_string((bytes >> 20) + 1) + " MiB are needed");
  }
}

void write_text(const std::filesystem::path& target, const std::string& text) {
  TemporaryFile file(target);
  std::ofstream stream(file.path(), std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) throw InputError("cannot write '" + target.string() + "': is the disk full?");
  file.commit();
}

}  // namespace vpm
