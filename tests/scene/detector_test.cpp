// Where flights pass detectors, and which bin they are counted in.
#include "vpm/scene/detector.h"

#include <gtest/gtest.h>

#include <cmath>

#include "vpm/base/rng.h"
#include "vpm/base/warp.h"

namespace vpm {
namespace {

StraightWay between(const Vec3d& from, const Vec3d& to) { return {from, to, glm::normalize(to - from), false}; }
StraightWay from_on(const Vec3d& from, const Vec3d& direction) { return {from, from, direction, true}; }

const Detector kFloor{"floor", PlaneDetector{{0.0f, 1.0f, 0.0f}, {0.0f, 1.0f, 0.0f}}, 4};

TEST(PlaneDetector, IsPassedOnceByFlightsThatMeetOnIt) {
  const Vec3d above(0.0, 3.0, 0.0), on(1.0, 1.0, 0.0), below(2.0, -1.0, 0.0);
  const int through = detections_of(kFloor, between(above, on)).count + detections_of(kFloor, between(on, below)).count;
  EXPECT_EQ(through, 1);
  const int bounced = detections_of(kFloor, between(above, on)).count + detections_of(kFloor, between(on, above)).count;
  EXPECT_EQ(bounced, 0);
}

TEST(PlaneDetector, SaysHowFarAndInWhichDirection) {
  const Detections down = detections_of(kFloor, between({0.0, 3.0, 0.0}, {0.0, -1.0, 0.0}));
  ASSERT_EQ(down.count, 1);
  EXPECT_DOUBLE_EQ(down.at[0].distance, 2.0);
  EXPECT_EQ(down.at[0].bin, kFloor.bin_of(false, {0, 0}, 0)) << "along the normal's opposite";
  const Detections slanted = detections_of(kFloor, from_on({0.0, 0.0, 0.0}, {std::sqrt(1.0 - 0.09), 0.3, 0.0}));
  ASSERT_EQ(slanted.count, 1);
  EXPECT_EQ(slanted.at[0].bin, kFloor.bin_of(true, {0, 0}, 2)) << "cosine 0.3: between 0.25 and 0.5";
  EXPECT_EQ(detections_of(kFloor, from_on({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0})).count, 0);
  EXPECT_EQ(detections_of(kFloor, from_on({0.0, 3.0, 0.0}, {0.0, 1.0, 0.0})).count, 0);
}

TEST(DiscDetector, EndsAtItsRadius) {
  const Detector disc{"disc", DiscDetector{{0.0f, 1.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, 0.5f}};
  EXPECT_EQ(detections_of(disc, between({0.49, 2.0, 0.0}, {0.49, 0.0, 0.0})).count, 1);
  EXPECT_EQ(detections_of(disc, between({0.51, 2.0, 0.0}, {0.51, 0.0, 0.0})).count, 0);
}

TEST(QuadDetector, HasCellsAlongItsEdges) {
  // Edges that are not orthogonal: place = 0.7 u + 0.9 v.
  const QuadDetector shape{{0.0f, 0.0f, 0.0f}, {2.0f, 0.0f, 0.0f}, {1.0f, 0.0f, -1.0f}, {10, 5}};
  const Detector quad{"quad", shape, 3};
  const Vec3d place = 0.72 * Vec3d(shape.edge_u) + 0.91 * Vec3d(shape.edge_v);
  const Detections up = detections_of(quad, between(place - Vec3d(0.0, 1.0, 0.0), place + Vec3d(0.0, 1.0, 0.0)));
  ASSERT_EQ(up.count, 1);
  EXPECT_EQ(up.at[0].bin, quad.bin_of(true, {7, 4}, 0)) << "edge_u x edge_v points up";
  EXPECT_EQ(quad.bins(), 2u * 10 * 5 * 3);
  EXPECT_EQ(quad.bin_of(false, {9, 4}, 2), quad.bins() - 1);
  const Vec3d beyond = 1.01 * Vec3d(shape.edge_u) + 0.5 * Vec3d(shape.edge_v);
  EXPECT_EQ(detections_of(quad, between(beyond + Vec3d(0.0, 1.0, 0.0), beyond - Vec3d(0.0, 1.0, 0.0))).count, 0);
}

// A random walk is inside a sphere as often as it has come in more often than gone out.
TEST(SphereDetector, IsPassedAsOftenAsWalksChangeSides) {
  const Detector sphere{"sphere", SphereDetector{{0.1f, 0.2f, 0.3f}, 1.0f}};
  Rng rng(5, 0, 0);
  Vec3d at(0.1, 0.2, 0.3);
  int inside = 1, passed = 0;
  for (int step = 0; step < 20'000; ++step) {
    const Vec3d to = Vec3d(0.1, 0.2, 0.3) + 2.0 * rng.uniform_double() * Vec3d(uniform_sphere(rng.uniform2()));
    const Detections found = detections_of(sphere, between(at, to));
    for (const Detection& each : found) {
      inside += each.bin == sphere.bin_of(false, {0, 0}, 0) ? 1 : -1;
      EXPECT_NEAR(glm::distance(at + each.distance * glm::normalize(to - at), Vec3d(0.1f, 0.2f, 0.3f)), 1.0, 1e-6);
    }
    passed += found.count;
    at = to;
    ASSERT_EQ(inside, glm::distance(at, Vec3d(0.1f, 0.2f, 0.3f)) < 1.0) << step;
  }
  EXPECT_GT(passed, 10'000);
}

TEST(SphereDetector, AnEndlessFlightFromOutsidePassesTwiceOrNever) {
  const Detector sphere{"sphere", SphereDetector{{0.0f, 0.0f, 0.0f}, 1.0f}};
  EXPECT_EQ(detections_of(sphere, from_on({-3.0, 0.5, 0.0}, {1.0, 0.0, 0.0})).count, 2);
  EXPECT_EQ(detections_of(sphere, from_on({-3.0, 0.5, 0.0}, {-1.0, 0.0, 0.0})).count, 0);
  EXPECT_EQ(detections_of(sphere, from_on({-3.0, 1.5, 0.0}, {1.0, 0.0, 0.0})).count, 0);
  EXPECT_EQ(detections_of(sphere, from_on({0.5, 0.0, 0.0}, {1.0, 0.0, 0.0})).count, 1);
}

}  // namespace
}  // namespace vpm
