// The lines of README.md and of tools/README.md, as a newcomer types them: each succeeds, and none writes over what
// another has made. The scenes that the lines name are the project's own, made small; the lines are as they are, but
// for their times and errors.
#include <map>
#include <regex>
#include <sstream>

#include "tools/vpm_binary.h"

namespace vpm {
namespace {

namespace fs = std::filesystem;

/// Lines that are not run, by what they begin with, and why.
const std::map<std::string, std::string> kLeftOut{
    {"build/release/vpm validate", "it takes minutes and has a test of its own"},
    {"tools/bench radius", "it builds another program, with libraries that tests do without"},
    {"tools/bench renders", "it makes references, which takes long"}};

std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The commands of the section's blocks of shell, with their comments.
std::vector<std::string> lines_of(const char* file, const char* section) {
  const std::string page = contents(fs::path(VPM_SOURCE_DIR) / file);
  const size_t begin = page.find(section), end = page.find("\n## ", begin + 1);
  EXPECT_LT(end, page.size());
  std::istringstream text(page.substr(begin, end - begin));
  std::vector<std::string> lines;
  bool shell = false;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("```"))
      shell = line == "```sh";
    else if (shell && !line.empty())
      lines.push_back(line);
  }
  return lines;
}

/// What makes files of the project small: the pattern, which must be there, and what stands in its place.
struct Change {
  std::string file, pattern, small;
};
const std::vector<Change> kChanges{
    {"scenes/smoke.toml", "width = \\d+\nheight = \\d+", "width = 32\nheight = 32"},
    {"scenes/smoke.toml", "emitted = [\\d_]+", "emitted = 50_000"},
    {"scenes/smoke.toml", "passes = \\d+", "passes = 4"},
    {"scenes/cornell.toml", "passes = \\d+", "passes = 2"},
    {"scenes/experiments/fog-exact.toml", "budgets = .*", "budgets = [0.02, 0.05]"},
    {"scenes/experiments/fog-exact.toml", "repetitions = \\d+", "repetitions = 3"},
    {"scenes/experiments/fog-exact.toml", "film.width = \\d+\nfilm.height = \\d+", "film.width = 8\nfilm.height = 8"}};

class SlowVpmTour : public VpmBinary {
 protected:
  void SetUp() override {
    fs::copy(fs::path(VPM_SOURCE_DIR) / "scenes", folder_ / "scenes", fs::copy_options::recursive);
    for (const Change& change : kChanges) {
      const std::string text = read(change.file);
      const std::regex pattern(change.pattern);
      ASSERT_TRUE(std::regex_search(text, pattern)) << change.file << " lacks " << change.pattern;
      write(change.file, std::regex_replace(text, pattern, change.small));
    }
    fs::create_directories(folder_ / "build/release");
    fs::create_directories(folder_ / "build/media");
    fs::create_symlink(VPM_BINARY, folder_ / "build/release/vpm");
    vpm_succeeds({"media", "smoke", "--resolution", "16", "-o", "build/media/smoke.vdb"});
  }

  std::map<fs::path, fs::file_time_type> times() const {
    std::map<fs::path, fs::file_time_type> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder_))
      if (entry.is_regular_file()) all[entry.path()] = entry.last_write_time();
    return all;
  }

  /// The line with two passes for its seconds, which is quicker and the same on busy machines, and ten times its error.
  static std::string hurried(const std::string& line) {
    std::smatch found;
    std::string quick = std::regex_replace(line, std::regex("--time \\d+"), "--passes 2");
    if (std::regex_search(quick, found, std::regex("--error ([\\d.]+)")))
      quick.replace(found.position(1), found.length(1), std::to_string(std::stod(found[1]) * 10.0));
    return quick;
  }

  void run(const std::string& line) const {
    const auto before = times();
    Process process({"/bin/sh", "-c", hurried(line)}, {300.0, 0, folder_.string()});
    const ProcessResult result = process.wait();
    EXPECT_EQ(result.status, 0) << result.out << result.err;
    const auto after = times();
    for (const auto& [file, time] : before) {
      ASSERT_EQ(after.count(file), 1u) << file;
      EXPECT_EQ(after.at(file), time) << "it writes over " << file;
    }
    std::printf("%6.1f s  %s\n", result.seconds, line.c_str());
  }
};

TEST_F(SlowVpmTour, FirstStepsRun) {
  const std::vector<std::string> lines = lines_of("README.md", "## First steps");
  EXPECT_EQ(lines.size(), 7u);
  for (const std::string& line : lines) {
    const testing::ScopedTrace trace(__FILE__, __LINE__, line);
    run(line);
  }
}

TEST_F(SlowVpmTour, RunsLineByLine) {
  std::map<std::string, std::string> left_out = kLeftOut;
  size_t count = 0;
  for (const std::string& line : lines_of("tools/README.md", "## A short tour")) {
    const testing::ScopedTrace trace(__FILE__, __LINE__, line);
    const auto why = std::find_if(left_out.begin(), left_out.end(),
                                  [&](const auto& entry) { return line.starts_with(entry.first); });
    if (why != left_out.end()) {
      std::printf(" skipped  %s\n          %s\n", line.c_str(), why->second.c_str());
      left_out.erase(why);
    } else {
      run(line);
      ++count;
    }
  }
  EXPECT_TRUE(left_out.empty()) << "the tour has no line " << left_out.begin()->first;
  EXPECT_GT(count, 10u);
}

}  // namespace
}  // namespace vpm
