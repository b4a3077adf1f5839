// The program as its users meet it: a folder of its own for each test, and the binary run in it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/process.h"

namespace vpm {

/// Bytes of address space for runs that must make do with little, the program's own included; 0: any number, as the
/// address sanitizer reserves terabytes.
#ifdef __SANITIZE_ADDRESS__
inline constexpr uint64_t kAddressSpace = 0;
#else
inline constexpr uint64_t kAddressSpace = uint64_t{1} << 30;
#endif

class VpmBinary : public ::testing::Test {
 protected:
  VpmBinary() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(test->test_suite_name()) + "_" + test->name();
    std::replace(name.begin(), name.end(), '/', '_');
    folder_ = std::filesystem::absolute(std::filesystem::path(::testing::TempDir()) / name);
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~VpmBinary() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
  }
  std::string read(const std::string& name) const {
    std::ifstream file(path(name), std::ios::binary);
    EXPECT_TRUE(file) << "there is no file " << name;
    return {std::istreambuf_iterator<char>(file), {}};
  }
  nlohmann::json report(const std::string& name) const { return nlohmann::json::parse(read(name)); }

  /// The names of all files in the folder, sorted.
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }

  /// The files of these names that `make` makes in the folder: by the first test of the process that asks, for all.
  template <class Make>
  void made_once(const std::vector<std::string>& names, Make make) const {
    static std::map<std::vector<std::string>, std::vector<std::string>> made;
    std::vector<std::string>& contents = made[names];
    if (contents.empty()) {
      make();
      for (const std::string& name : names) contents.push_back(read(name));
    } else {
      for (size_t i = 0; i < names.size(); ++i) write(names[i], contents[i]);
    }
  }

  static std::vector<std::string> command(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), VPM_BINARY);
    return arguments;
  }
  /// Runs vpm in the folder.
  ProcessResult vpm(const std::vector<std::string>& arguments, double seconds = 120.0,
                    uint64_t address_space = 0) const {
    return run_program(command(arguments), {seconds, address_space, folder_.string()});
  }
  /// Runs vpm, which must succeed.
  ProcessResult vpm_succeeds(const std::vector<std::string>& arguments, double seconds = 120.0) const {
    const ProcessResult result = vpm(arguments, seconds);
    EXPECT_EQ(result.status, 0) << result.err;
    return result;
  }
  /// Runs vpm, which must refuse within 10 s: exit status 2, nothing on stdout, each of `words` on stderr, no file
  /// made.
  void vpm_refuses(const std::vector<std::string>& arguments, const std::vector<std::string>& words,
                   uint64_t address_space = 0) const {
    const std::vector<std::string> before = files();
    const ProcessResult result = vpm(arguments, 10.0, address_space);
    const ::testing::ScopedTrace trace(__FILE__, __LINE__, "vpm " + ::testing::PrintToString(arguments));
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.out, "");
    for (const std::string& word : words)
      EXPECT_NE(result.err.find(word), std::string::npos) << "expected: " << word << "\n" << result.err;
    EXPECT_EQ(files(), before);
    EXPECT_LT(result.peak_memory, uint64_t{1} << 30);
  }

  std::filesystem::path folder_;
};

}  // namespace vpm
