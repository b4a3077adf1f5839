// What queries find, unpacked side by side, against one photon after the other.
#include "vpm/photon/map/photon_batch.h"

#include <gtest/gtest.h>

#include <numeric>

#include "support/photons.h"

namespace vpm {
namespace {

struct Table {
  explicit Table(size_t count) : photons(vpm::photons(Layout::spread, count)) {
    std::vector<uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    table = PhotonTable(photons, order, 1.0f);
  }
  std::vector<Photon> photons;
  PhotonTable table;
};

TEST(PhotonBatch, HoldsThePhotonsAndFillsUpWithNoPower) {
  const Table all(1000);
  for (const size_t count : {size_t{1}, size_t{15}, size_t{16}, size_t{17}, PhotonBatch::kMost}) {
    std::vector<uint32_t> numbers(count);
    std::vector<float> distances2(count);
    for (size_t i = 0; i < count; ++i) {
      numbers[i] = static_cast<uint32_t>((7 * i + 3) % all.photons.size());
      distances2[i] = static_cast<float>(i);
    }
    const PhotonBatch batch(all.table, numbers.data(), distances2.data(), count);
    EXPECT_EQ(batch.number(), count);
    EXPECT_EQ(batch.size(), (count + 15) / 16 * 16);
    for (size_t i = 0; i < batch.size(); ++i) {
      const PhotonTable::Payload& one = all.table.payload(numbers[i < count ? i : 0]);
      EXPECT_EQ(batch.travel(i), one.travel.unpack());
      EXPECT_EQ(batch.power(i), i < count ? one.power.unpack() : Rgb(0.0f));
      EXPECT_EQ(batch.distance2(i), i < count ? distances2[i] : 0.0f);
    }
  }
}

TEST(PhotonBatch, SumsValuesTimesWeights) {
  const Table all(PhotonBatch::kMost);
  std::vector<uint32_t> numbers(PhotonBatch::kMost - 5);
  std::iota(numbers.begin(), numbers.end(), 0u);
  const std::vector<float> distances2(numbers.size(), 0.25f);
  const PhotonBatch batch(all.table, numbers.data(), distances2.data(), numbers.size());
  const KernelPair<Rgbd> sum = sum_photons(
      batch, [](size_t i) { return KernelPair<Rgb>(Rgb(1.0f, 2.0f, static_cast<float>(i)), Rgb(-3.0f)); },
      [](const Vec3& travel, const Rgb& power) { return power * (2.0f + travel.x); });
  KernelPair<Rgbd> expected;
  for (const uint32_t i : numbers) {
    const PhotonTable::Payload& one = all.table.payload(i);
    const Rgbd value = Rgbd(one.power.unpack()) * (2.0 + one.travel.unpack().x);
    expected += {value * Rgbd(1.0, 2.0, i), value * -3.0};
  }
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(sum.value[c], expected.value[c], 3e-6 * expected.value[c]);
    EXPECT_NEAR(sum.correction[c], expected.correction[c], -3e-6 * expected.correction[c]);
  }
}

TEST(NearPhotons, HandsOnWhatIsNearInItsOrderAndDropsWhatIsNotAccepted) {
  const Table all(20'000);
  const Vec3 point = all.photons[0].position;
  std::vector<uint32_t> found, expected;
  const auto accept = [](const PackedDirection& travel, const Vec3& offset) {
    return (offset.x > 0.0f) & (travel.on_octahedron().y > 0.0f);
  };
  const auto use = [&](NearPhotons& near) {
    near.keep(all.table, point, accept);
    found.insert(found.end(), near.photons(), near.photons() + near.size());
  };
  NearPhotons near;
  all.table.for_each_block(0, all.photons.size(), point, [&](const float* distances2, uint32_t number, uint32_t first) {
    near.add(distances2, number, first, 0.5f, use);
  });
  near.take(use);
  for (uint32_t i = 0; i < all.photons.size(); ++i) {
    const Vec3 offset = all.photons[i].position - point;
    if (glm::dot(offset, offset) < 0.5f && accept(all.photons[i].travel, offset)) expected.push_back(i);
  }
  EXPECT_GT(expected.size(), PhotonBatch::kMost / 2);
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace vpm
