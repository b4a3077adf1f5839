// Bad input, a table a reader: tests/input/bad_scenes.txt, bad_ply.txt and bad_obj.txt. A row begins with "== NAME" and
// goes on with the text of a file of that name, which says itself what is to be said about it: every line that contains
// "expect TEXT" asks for an error message with that TEXT in it. In place of a line "<scene>" there are a camera and a
// light, nine lines; in place of "<bytes 0f80>" those bytes, without an end of the line.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "support/test_file.h"
#include "vpm/base/error.h"

namespace vpm {

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

/// The rows of all tables as files in a folder, beside the folder of textures; some name each other.
class BadInput : public ::testing::Test {
 protected:
  struct Row {
    std::string path, text;
  };

  BadInput() {
    namespace fs = std::filesystem;
    const fs::path folder = fs::path(test_file("bad/scene.toml")).parent_path();
    fs::copy(source_ + "textures", folder.parent_path() / "textures",
             fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    folder_ = folder.string() + "/";
    for (const char* table : {"scenes", "ply", "obj"}) read(table);
  }

  /// The rows of one kind.
  std::vector<Row> rows(const std::string& extension) const {
    std::vector<Row> found;
    for (const Row& row : rows_)
      if (row.path.ends_with(extension)) found.push_back(row);
    EXPECT_FALSE(found.empty());
    return found;
  }

  /// Checks the message, without the folder's name, against what the row expects.
  void expect_message(const Row& row, std::string message) const {
    for (size_t at = message.find(folder_); at != std::string::npos; at = message.find(folder_))
      message.erase(at, folder_.size());
    std::istringstream lines(row.text);
    int expectations = 0;
    for (std::string line; std::getline(lines, line);) {
      const size_t at = line.find("expect ");
      if (at == std::string::npos) continue;
      ++expectations;
      const std::string text = line.substr(at + 7);
      EXPECT_NE(message.find(text), std::string::npos) << "expected: " << text << "\nmessage: " << message;
    }
    EXPECT_GT(expectations, 0) << "the row says nothing about what to expect";
  }

 private:
  static constexpr const char* kScene =
      "[camera]\nposition = [0, 0, 3]\ntarget = [0, 0, 0]\n\n"
      "[[lights]]\ntype = \"point\"\nposition = [0, 2, 0]\npower = 1\n";

  static std::string bytes(const std::string& digits) {
    std::string all;
    for (size_t i = 0; i + 1 < digits.size(); i += 2)
      all += static_cast<char>(std::stoi(digits.substr(i, 2), nullptr, 16));
    return all;
  }

  void read(const std::string& table) {
    std::ifstream file(source_ + "bad_" + table + ".txt");
    EXPECT_TRUE(file) << table;
    for (std::string line; std::getline(file, line);) {
      if (line.starts_with("== "))
        rows_.push_back({folder_ + line.substr(3), ""});
      else if (line == "<scene>")
        rows_.back().text += kScene;
      else if (line.starts_with("<bytes "))
        rows_.back().text += bytes(line.substr(7, line.size() - 8));
      else
        rows_.back().text += line + '\n';
    }
    for (const Row& row : rows_) std::ofstream(row.path, std::ios::binary) << row.text;
  }

  const std::string source_ = std::string(VPM_SOURCE_DIR) + "/tests/input/";
  std::string folder_;
  std::vector<Row> rows_;
};

}  // namespace vpm
