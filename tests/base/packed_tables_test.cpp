// Tables in one piece of memory.
#include "vpm/base/packed_tables.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "support/aligned_bytes.h"

namespace vpm {
namespace {

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

}  // namespace
}  // namespace vpm
