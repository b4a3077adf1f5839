// The files in tests/input/bad say themselves what is to be said about them: every line that contains "expect TEXT"
// asks for an error message with that TEXT in it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "vpm/base/error.h"

namespace vpm {

inline std::string bad_folder() { return std::string(VPM_SOURCE_DIR) + "/tests/input/bad/"; }

/// The bad files of these extensions, sorted.
inline std::vector<std::string> bad_files(const std::vector<std::string>& extensions) {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(bad_folder()))
    if (std::find(extensions.begin(), extensions.end(), entry.path().extension()) != extensions.end())
      paths.push_back(bad_folder() + entry.path().filename().string());
  std::sort(paths.begin(), paths.end());
  EXPECT_FALSE(paths.empty());
  return paths;
}

/// What the InputError says that `action` throws; "" where it throws none.
template <class Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// Checks the message, without the folder's name, against what the file expects.
inline void expect_message(const std::string& path, std::string message) {
  for (size_t at = message.find(bad_folder()); at != std::string::npos; at = message.find(bad_folder()))
    message.erase(at, bad_folder().size());
  std::ifstream file(path, std::ios::binary);
  int expectations = 0;
  for (std::string line; std::getline(file, line);) {
    const size_t at = line.find("expect ");
    if (at == std::string::npos) continue;
    ++expectations;
    const std::string text = line.substr(at + 7);
    EXPECT_NE(message.find(text), std::string::npos) << "expected: " << text << "\nmessage: " << message;
  }
  EXPECT_GT(expectations, 0) << "the file says nothing about what to expect";
}

}  // namespace vpm
