// Files of one test alone: tests run side by side, each in a process of its own, and must not share any.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

namespace vpm {

/// The path of a file of that name in a folder that only the running test uses.
inline std::string test_file(const std::string& name) {
  const ::testing::TestInfo& test = *::testing::UnitTest::GetInstance()->current_test_info();
  std::string folder = std::string(test.test_suite_name()) + "_" + test.name();
  std::replace(folder.begin(), folder.end(), '/', '_');
  const std::filesystem::path path = std::filesystem::path(::testing::TempDir()) / folder / name;
  std::filesystem::create_directories(path.parent_path());
  return path.string();
}

}  // namespace vpm
