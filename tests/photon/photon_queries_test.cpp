// Many points at once, against one after the other by brute force: exact.
#include "vpm/estimate/photon_queries.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "vpm/base/rng.h"
#include "vpm/base/warp.h"

namespace vpm {
namespace {

std::vector<Vec3> points_in_cube(size_t count, uint64_t stream) {
  std::vector<Vec3> points;
  for (size_t i = 0; i < count; ++i) {
    Rng rng(9, rng_stream(RngUse::test, stream), i);
    const float x = rng.uniform(), y = rng.uniform();
    points.emplace_back(x, y, rng.uniform());
  }
  return points;
}

std::vector<Photon> photons_at(const std::vector<Vec3>& positions) {
  std::vector<Photon> photons;
  for (const Vec3& position : positions)
    photons.push_back({position, PackedDirection(Vec3(0.0f, 0.0f, 1.0f)), Rgb(0.5f, 1.0f, 2.0f)});
  return photons;
}

/// The numbers of the photons nearer than the radius, in rising order.
std::vector<uint32_t> brute_force(const std::vector<Vec3>& positions, const Vec3& point, float radius) {
  std::vector<uint32_t> near;
  for (uint32_t i = 0; i < positions.size(); ++i) {
    const Vec3 offset = positions[i] - point;
    if (offset.x * offset.x + offset.y * offset.y + offset.z * offset.z < radius * radius) near.push_back(i);
  }
  return near;
}

TEST(PhotonQueries, FindWhatBruteForceFinds) {
  const std::vector<Vec3> positions = points_in_cube(1500, 30), points = points_in_cube(600, 31);
  const PhotonQueries queries(photons_at(positions));
  for (const float radius : {0.02f, 0.13f, 2.0f}) {
    const std::vector<uint32_t> counts = queries.count_within(points, radius);
    const NearLists lists = queries.within(points, radius);
    ASSERT_EQ(lists.first.size(), points.size() + 1);
    for (size_t i = 0; i < points.size(); ++i) {
      const std::vector<uint32_t> near = brute_force(positions, points[i], radius);
      ASSERT_EQ(counts[i], near.size());
      ASSERT_EQ(std::vector<uint32_t>(&lists.numbers[0] + lists.first[i], &lists.numbers[0] + lists.first[i + 1]),
                near);
    }
  }
}

TEST(PhotonQueries, TheNearestComeFirst) {
  const std::vector<Vec3> positions = points_in_cube(1500, 30), points = points_in_cube(50, 32);
  const NearestLists lists = PhotonQueries(photons_at(positions)).nearest(points, 20);
  for (size_t i = 0; i < points.size(); ++i)
    for (size_t k = 0; k < 20; ++k) {
      const float distance = lists.distances[20 * i + k];
      ASSERT_FLOAT_EQ(distance, glm::distance(positions[lists.numbers[20 * i + k]], points[i]));
      ASSERT_EQ(brute_force(positions, points[i], distance * (1.0f + 1e-5f)).size(), k + 1);
    }
}

TEST(PhotonQueries, AnswerWithoutPhotons) {
  const PhotonQueries none({});
  const std::vector<Vec3> points{Vec3(0.0f), Vec3(1.0f)};
  EXPECT_EQ(none.count_within(points, 1.0f), (std::vector<uint32_t>{0, 0}));
  EXPECT_EQ(none.nearest(points, 1).numbers, (std::vector<uint32_t>{NearestLists::kNone, NearestLists::kNone}));
  EXPECT_EQ(none.estimate(points, 1.0f, KernelKind::cone, {})[1], Rgb(0.0f));
  EXPECT_TRUE(PhotonQueries(photons_at({Vec3(0.0f)})).count_within({}, 1.0f).empty());
}

/// One photon, by hand.
TEST(PhotonQueries, EstimatesArePowersTimesKernels) {
  const PhotonQueries one(photons_at({Vec3(0.0f)}));
  const std::vector<Vec3> points{Vec3(0.1f, 0.0f, 0.0f)}, up{Vec3(0.0f, 0.0f, 1.0f)}, down{Vec3(0.0f, 0.0f, -1.0f)};
  const auto estimate = [&](const EstimateOf& of) { return one.estimate(points, 0.2f, KernelKind::constant, of)[0]; };
  const float ball = 4.0f / 3.0f * kPi * 0.008f, disc = kPi * 0.04f;
  EXPECT_NEAR(estimate({}).g, 1.0f / ball, 1e-4f);
  EXPECT_NEAR(estimate({.normals = down}).b, 2.0f / disc, 1e-4f);
  EXPECT_EQ(estimate({.normals = up}), Rgb(0.0f)) << "it arrives on the other side";
  EXPECT_NEAR(estimate({.directions = up, .g = 0.5f}).g, 0.75f / (4.0f * kPi * 0.125f) / ball, 1e-3f);
}

}  // namespace
}  // namespace vpm
