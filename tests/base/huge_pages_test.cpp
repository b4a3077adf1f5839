// Memory on huge pages: what is asked of the system, and that tables in it are tables.
#include "vpm/base/huge_pages.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>

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

}  // namespace
}  // namespace vpm
