// The first draws of photon paths are those of the sequence, all others those of the generator.
#include "vpm/photon/photon_numbers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

namespace vpm {
namespace {

constexpr uint32_t kPhotons = 1024;

TEST(PhotonNumbers, AreThoseOfTheGeneratorWhereTheSequenceIsRandom) {
  const PhotonNumbers numbers(PhotonSequence::random, 7, 3);
  PhotonNumbers::Lead lead;
  Rng rng = numbers.of(12, lead), same(7, rng_stream(RngUse::photon, 3), 12);
  for (int i = 0; i < 100; ++i) ASSERT_EQ(rng.bits(), same.bits());
}

TEST(PhotonNumbers, AreThoseOfTheGeneratorPastTheSequence) {
  const PhotonNumbers even(PhotonSequence::sobol, 7, 3), random(PhotonSequence::random, 7, 3);
  PhotonNumbers::Lead lead, none;
  const uint64_t past = uint64_t{1} << 32;
  EXPECT_EQ(even.of(past, lead).bits(), random.of(past, none).bits());
  EXPECT_NE(even.of(past - 1, lead).bits(), random.of(past - 1, none).bits());
}

/// Whatever a path draws with, each of the draws that the sequence makes falls once into each of 1024 intervals, and
/// the draws behind them do not.
TEST(PhotonNumbers, AreEvenInEachOfTheFirstDraws) {
  const PhotonNumbers numbers(PhotonSequence::sobol, 7, 3);
  constexpr size_t kDraws = PhotonNumbers::kLead + 1;
  std::vector<std::set<int>> floats(kDraws), doubles(kDraws), first(kDraws), second(kDraws);
  for (uint32_t i = 0; i < kPhotons; ++i) {
    PhotonNumbers::Lead lead;
    Rng one = numbers.of(i, lead), two = one, three = one;
    for (size_t d = 0; d < kDraws; ++d) {
      floats[d].insert(static_cast<int>(one.uniform() * kPhotons));
      doubles[d].insert(static_cast<int>(two.uniform_double() * kPhotons));
      const Vec2 pair = three.uniform2();
      first[d].insert(static_cast<int>(pair.x * kPhotons));
      second[d].insert(static_cast<int>(pair.y * kPhotons));
    }
  }
  for (size_t d = 0; d < PhotonNumbers::kLead; ++d) {
    if (d == 9) continue;  // the channel of a second flight is the generator's
    EXPECT_EQ(floats[d].size(), kPhotons) << d;
    EXPECT_EQ(doubles[d].size(), kPhotons) << d;
    EXPECT_EQ(first[d].size(), kPhotons) << d;
  }
  EXPECT_LT(floats.back().size(), 0.8 * kPhotons);
  const auto even_pairs =
      std::count_if(second.begin(), second.end(), [](const auto& x) { return x.size() == kPhotons; });
  EXPECT_EQ(even_pairs, 4);  // place and direction of emission, directions of two scatterings
}

TEST(PhotonNumbers, AreOthersInEachPass) {
  PhotonNumbers::Lead a, b;
  Rng one = PhotonNumbers(PhotonSequence::sobol, 7, 0).of(5, a),
      two = PhotonNumbers(PhotonSequence::sobol, 7, 1).of(5, b);
  for (int i = 0; i < 20; ++i) EXPECT_NE(one.bits(), two.bits());
}

}  // namespace
}  // namespace vpm
