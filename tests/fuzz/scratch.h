// What the fuzz targets share: a folder for their files, and what counts as a right answer to any bytes at all.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "vpm/base/error.h"

namespace vpm {

/// A folder of this process alone, below TMPDIR. It goes when the process ends.
class ScratchFolder {
 public:
  ScratchFolder() { std::filesystem::create_directories(folder_); }
  ~ScratchFolder() { std::filesystem::remove_all(folder_); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::string path(const std::string& name) const { return folder_ / name; }

  /// Writes a file, over the last one of that name; returns its path.
  std::string put(const std::string& name, const uint8_t* data, size_t size) const {
    std::ofstream file(path(name), std::ios::binary);
    file.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    return path(name);
  }

 private:
  std::filesystem::path folder_ = std::filesystem::temp_directory_path() / ("vpm-fuzz-" + std::to_string(getpid()));
};

/// Reads something. To refuse it is as right as to accept it; whatever else is thrown ends the process.
template <class Read>
void read_or_refuse(Read read) {
  try {
    read();
  } catch (const InputError&) {
  }
}

}  // namespace vpm
