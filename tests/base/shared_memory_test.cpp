// Memory of several processes.
#include "vpm/base/shared_memory.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <limits>
#include <system_error>

namespace vpm {
namespace {

TEST(SharedMemory, IsFoundByItsAddress) {
  SharedMemory own(10'000);
  ASSERT_EQ(own.bytes().size(), 10'000u);
  EXPECT_EQ(own.bytes()[9'999], std::byte{0});
  std::memcpy(own.data() + 9'990, "fog", 4);
  const SharedMemory found(own.address());
  ASSERT_EQ(found.bytes().size(), 10'000u);
  EXPECT_NE(found.bytes().data(), own.bytes().data());
  EXPECT_STREQ(reinterpret_cast<const char*>(found.bytes().data()) + 9'990, "fog");
  std::memcpy(own.data() + 9'990, "dew", 4);  // it is the same memory, no copy
  EXPECT_STREQ(reinterpret_cast<const char*>(found.bytes().data()) + 9'990, "dew");
}

TEST(SharedMemory, IsThatOfAnotherProcess) {
  SharedMemory own(64);
  const std::string address = own.address();
  own.data()[7] = std::byte{42};
  const pid_t child = fork();
  if (child == 0) {
    const SharedMemory found(address);
    _exit(std::to_integer<int>(found.bytes()[7]));
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 42);
}

TEST(SharedMemory, StaysForWhoFoundItAndIsGoneForOthers) {
  auto own = std::make_unique<SharedMemory>(64);
  const std::string address = own->address();
  own->data()[7] = std::byte{42};
  const SharedMemory found(address);
  own.reset();
  EXPECT_EQ(found.bytes()[7], std::byte{42});
  EXPECT_THROW(SharedMemory{address}, std::system_error);
}

TEST(SharedMemory, IsRefusedWhereThereIsNoRoom) {
  const auto count = [] {
    return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), std::filesystem::directory_iterator());
  };
  const auto open_before = count();
  EXPECT_THROW(SharedMemory(size_t{1} << 50), std::system_error);
  EXPECT_EQ(count(), open_before);
}

}  // namespace
}  // namespace vpm
