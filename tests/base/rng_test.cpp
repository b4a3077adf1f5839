// Random numbers: known answers, and independence of addresses.
#include "vpm/base/rng.h"

#include <gtest/gtest.h>

#include <set>

#include "support/statistics.h"

namespace vpm {
namespace {

// From the generator's definition [ONeill2014], worked out in integers of unlimited length.
TEST(Rng, KnownAnswers) {
  struct Known {
    uint64_t seed, stream, index, bits[3];
  };
  const uint64_t most = ~uint64_t{0};
  const Known known[] = {
      {1, 0, 0, {0xe31e8e0287961ad0, 0x98f875ebff170a7b, 0x0b43f7e675448dec}},
      {7, rng_stream(RngUse::test, 3), 12345, {0x8c7fd8bd282d4d05, 0x9d66207167c15b96, 0xa02d2053b9259c89}},
      {most, most, most, {0xb269d141e09088e5, 0xbedc089061b123fd, 0x3205cfac077d4e00}}};
  for (const Known& k : known) {
    Rng rng(k.seed, k.stream, k.index);
    for (const uint64_t bits : k.bits) EXPECT_EQ(rng.bits(), bits);
  }
}

TEST(Rng, EveryPartOfTheAddressMatters) {
  std::set<uint64_t> first;
  for (uint64_t seed = 0; seed < 10; ++seed)
    for (uint64_t stream = 0; stream < 10; ++stream)
      for (uint64_t index = 0; index < 10; ++index) first.insert(Rng(seed, stream, index).bits());
  EXPECT_EQ(first.size(), 1000u);
}

// The first numbers of neighbouring addresses are as uniform as those of one sequence. False-alarm rate 1e-6 each.
TEST(Rng, UniformWithinAndAcrossSequences) {
  constexpr int kDraws = 64000, kCells = 64;
  std::vector<double> within(kCells), across(kCells), pairs(kCells);
  Rng one(3, 0, 0);
  for (int i = 0; i < kDraws; ++i) {
    Rng other(3, 0, static_cast<uint64_t>(i));
    ++within[static_cast<size_t>(one.uniform() * kCells)];
    ++across[static_cast<size_t>(other.uniform_double() * kCells)];
    const Vec2 u = other.uniform2();
    ++pairs[static_cast<size_t>(u.x * 8) * 8 + static_cast<size_t>(u.y * 8)];
  }
  const std::vector<double> uniform(kCells, 1.0 / kCells);
  expect_distribution(within, uniform, 1e-6, "one sequence");
  expect_distribution(across, uniform, 1e-6, "first numbers");
  expect_distribution(pairs, uniform, 1e-6, "pairs");
}

}  // namespace
}  // namespace vpm
