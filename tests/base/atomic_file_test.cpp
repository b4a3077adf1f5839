// A target is always the old file or the whole new one, and what cannot be written is refused beforehand.
#include "vpm/base/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <string>

#include "vpm/base/error.h"

namespace vpm {
namespace {

namespace fs = std::filesystem;

void put(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

std::string get(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// What the InputError of `action` says; "" where it throws none.
template <typename Action>
std::string complaint(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

class AtomicFile : public testing::Test {
 protected:
  AtomicFile() { fs::create_directory(folder_); }
  ~AtomicFile() override { fs::remove_all(folder_); }

  size_t files() const { return static_cast<size_t>(std::distance(fs::directory_iterator(folder_), {})); }

  const fs::path folder_ = fs::path(testing::TempDir()) / ("vpm-atomic-file-" + std::to_string(getpid()));
  const fs::path target_ = folder_ / "out.txt";
};

TEST_F(AtomicFile, CommitReplacesTheTarget) {
  put(target_, "old");
  {
    TemporaryFile file(target_);
    EXPECT_EQ(file.path().parent_path(), fs::canonical(folder_));
    put(file.path(), "new");
    EXPECT_EQ(get(target_), "old");
    file.commit();
  }
  EXPECT_EQ(get(target_), "new");
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFile, WithoutCommitTheOldFileStays) {
  put(target_, "old");
  {
    TemporaryFile file(target_);
    put(file.path(), "half of the n");
  }
  EXPECT_EQ(get(target_), "old");
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFile, FailedCommitLeavesNoTemporary) {
  {
    TemporaryFile file(target_);
    fs::create_directory(target_);  // somebody was faster
    EXPECT_NE(complaint([&] { file.commit(); }), "");
  }
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFile, PermissionsAreTheUsualOnes) {
  const mode_t mask = umask(022);
  TemporaryFile file(target_);
  file.commit();
  umask(mask);
  EXPECT_EQ(static_cast<unsigned>(fs::status(target_).permissions()), 0644u);
}

TEST_F(AtomicFile, SeveralAtOnceDoNotCollide) {
  TemporaryFile one(target_), two(target_);
  EXPECT_NE(one.path(), two.path());
}

TEST_F(AtomicFile, LinkIsFollowed) {
  put(target_, "old");
  fs::create_symlink("out.txt", folder_ / "link");
  TemporaryFile file(folder_ / "link");
  put(file.path(), "new");
  file.commit();
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(get(target_), "new");
}

TEST_F(AtomicFile, RefusesWhatCannotBeWritten) {
  const auto complaint_about = [](const fs::path& target) { return complaint([&] { check_writable(target, 1); }); };
  EXPECT_NE(complaint_about(folder_ / "missing" / "out.txt").find("missing'; make it first"), std::string::npos);
  EXPECT_NE(complaint_about(folder_).find("it is a folder"), std::string::npos);
  EXPECT_NE(complaint_about(folder_ / "").find("it is a folder"), std::string::npos);
  EXPECT_NE(complaint_about("").find("the name is empty"), std::string::npos);
  EXPECT_NE(complaint_about("/dev/null").find("it is a device"), std::string::npos);
  EXPECT_NE(complaint_about("/proc/out.txt").find("no file can be made in '/proc'"), std::string::npos);
  put(target_, "old");
  EXPECT_NE(complaint_about(target_ / "out.txt").find("make it first"), std::string::npos);
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFile, RefusesProtectedFileAndFolder) {
  if (geteuid() == 0) GTEST_SKIP() << "nothing is protected from root";
  put(target_, "old");
  fs::permissions(target_, fs::perms::owner_read);
  EXPECT_NE(complaint([&] { check_writable(target_, 1); }).find("write-protected"), std::string::npos);
  fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_NE(complaint([&] { check_writable(folder_ / "new", 1); }).find("no file can be made"), std::string::npos);
  fs::permissions(folder_, fs::perms::owner_all);
}

TEST_F(AtomicFile, RefusesFullDiskAndTouchesNothing) {
  put(target_, "old");
  EXPECT_NO_THROW(check_writable(target_, 1));
  EXPECT_NE(complaint([&] { check_writable(target_, uint64_t{1} << 60); }).find("MiB are needed"), std::string::npos);
  EXPECT_EQ(get(target_), "old");
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFile, RelativeNamesWork) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  EXPECT_NO_THROW(check_writable("out.txt", 1));
  TemporaryFile file("out.txt");
  file.commit();
  fs::current_path(before);
  EXPECT_TRUE(fs::exists(target_));
}

}  // namespace
}  // namespace vpm
