// Memory on huge pages, tables in one piece of memory, and memory of several processes.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "support/aligned_bytes.h"
#include "vpm/base/memory/huge_pages.h"
#include "vpm/base/memory/packed_tables.h"
#include "vpm/base/memory/shared_memory.h"

namespace vpm {
namespace {

constexpr size_t kMega = size_t{1} << 20;

/// The system's flags of the mapping that holds an address: its line "VmFlags:" in /proc/self/smaps.
std::string flags_of(const void* address) {
  const auto wanted = reinterpret_cast<uintptr_t>(address);
  std::ifstream maps("/proc/self/smaps");
  bool inside = false;
  for (std::string line; std::getline(maps, line);) {
    std::istringstream words(line);
    uintptr_t from = 0, to = 0;
    char dash = 0;
    if (words >> std::hex >> from >> dash >> to && dash == '-') inside = from <= wanted && wanted < to;
    if (inside && line.rfind("VmFlags:", 0) == 0) return line + " ";
  }
  return {};
}

TEST(HugePages, AreAskedForByLargeTablesAlone) {
  std::ifstream known("/sys/kernel/mm/transparent_hugepage/enabled");
  if (!known) GTEST_SKIP() << "this system has none";
  const LargeTable<float> large(kMega), small(kMega - 1);  // 4 MiB, and less
  EXPECT_EQ(reinterpret_cast<uintptr_t>(large.data()) % (2 * kMega), 0u);
  EXPECT_NE(flags_of(large.data()).find(" hg "), std::string::npos);
  EXPECT_NE(flags_of(large.data() + large.size() - 1).find(" hg "), std::string::npos);
  EXPECT_EQ(flags_of(small.data()).find(" hg "), std::string::npos);
}

TEST(HugePages, TablesGrowAcrossTheLimit) {
  LargeTable<uint32_t> table;
  for (uint32_t i = 0; i < 3 * kMega; ++i) table.push_back(i);
  const LargeTable<uint32_t> copy = table;
  table.shrink_to_fit();
  ASSERT_EQ(table.size(), 3 * kMega);
  for (uint32_t i = 0; i < table.size(); ++i) ASSERT_EQ(table[i], i);
  EXPECT_EQ(copy, table);
}

struct alignas(64) Wide {
  uint8_t bytes[64] = {};
};

void pack(TablePacker& packer) {
  const std::vector<float> floats{1.0f, 2.5f, -3.0f};
  const std::vector<Wide> wide(2, Wide{{7}});
  packer.add(std::span(floats));
  packer.add_one(true);
  packer.add(std::span<const double>());
  packer.add(std::span(wide));
  packer.add_one(-9);
}

TEST(PackedTables, AreReadWhereTheyLie) {
  TablePacker counter(nullptr);
  pack(counter);
  AlignedBytes memory(counter.bytes());
  ASSERT_EQ(memory.bytes().size(), counter.bytes());
  TablePacker packer(memory.data());
  pack(packer);
  EXPECT_EQ(packer.bytes(), counter.bytes());

  TableUnpacker packed(memory.bytes());
  const std::span<const float> floats = packed.take<float>();
  ASSERT_EQ(floats.size(), 3u);
  EXPECT_EQ(floats[1], 2.5f);
  EXPECT_EQ(floats[2], -3.0f);
  EXPECT_GT(std::as_bytes(floats).data(), memory.data());
  EXPECT_LT(std::as_bytes(floats).data(), memory.data() + counter.bytes());
  EXPECT_TRUE(packed.take_one<bool>());
  EXPECT_TRUE(packed.take<double>().empty());
  const std::span<const Wide> wide = packed.take<Wide>();
  ASSERT_EQ(wide.size(), 2u);
  EXPECT_EQ(reinterpret_cast<uintptr_t>(wide.data()) % alignof(Wide), 0u);
  EXPECT_EQ(wide[1].bytes[0], 7);
  EXPECT_EQ(packed.take_one<int>(), -9);
}

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
  constexpr size_t kMegabyte = size_t{1} << 20;
  SharedMemory own(5 * kMegabyte);
  for (size_t i = 0; i < own.bytes().size(); ++i) own.data()[i] = static_cast<std::byte>(i % 251);
  own.finish();
  const SharedMemory found(own.address());
  for (const SharedMemory* memory : {&std::as_const(own), &found}) {
    EXPECT_EQ(reinterpret_cast<uintptr_t>(memory->bytes().data()) % (2 * kMegabyte), 0u);
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
