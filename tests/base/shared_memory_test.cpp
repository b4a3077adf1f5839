// Memory of several processes.
#include "vpm/base/shared_memory.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string>
#include <system_error>
#include <utility>

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
    try {
      _exit(std::to_integer<int>(SharedMemory(address).bytes()[7]));
    } catch (const std::exception&) {
      _exit(1);
    }
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

TEST(SharedMemory, OfAnotherMakerIsNotTakenForIt) {
  const SharedMemory own(64), other(64);
  const std::string address = own.address(), there = other.address();
  const std::string mixed = there.substr(0, there.find('#')) + address.substr(address.find('#'));
  EXPECT_THROW(SharedMemory{mixed}, std::system_error);
  EXPECT_THROW(SharedMemory{there.substr(0, there.find('#'))}, std::system_error);
  EXPECT_THROW(SharedMemory{"/proc/self/cmdline#1"}, std::system_error);
}

TEST(SharedMemory, LiesOnWholeHugePagesAndKeepsWhatIsInItOnceItIsFinished) {
  constexpr size_t kMega = size_t{1} << 20;
  SharedMemory own(5 * kMega);
  for (size_t i = 0; i < own.bytes().size(); ++i) own.data()[i] = static_cast<std::byte>(i % 251);
  own.finish();
  const SharedMemory found(own.address());
  for (const SharedMemory* memory : {&std::as_const(own), &found}) {
    EXPECT_EQ(reinterpret_cast<uintptr_t>(memory->bytes().data()) % (2 * kMega), 0u);
    for (size_t i = 0; i < memory->bytes().size(); ++i) ASSERT_EQ(memory->bytes()[i], static_cast<std::byte>(i % 251));
  }
}

TEST(SharedMemory, IsRefusedWhereTheSystemRefusesIt) {
  const auto count = [] {
    return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), std::filesystem::directory_iterator());
  };
  const auto open_before = count();
  EXPECT_THROW(SharedMemory(size_t{1} << 50), std::system_error);
  EXPECT_EQ(count(), open_before);
}

}  // namespace
}  // namespace vpm
