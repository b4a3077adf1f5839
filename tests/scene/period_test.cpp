// Sides of a period, and the ways from one to the other.
#include "vpm/scene/period.h"

#include <gtest/gtest.h>

namespace vpm {
namespace {

const Box kBox{{10.0f, 0.0f, -4.0f}, {20.0f, 3.0f, 4.0f}};

TEST(Period, TakesRaysFromOneSideToTheOther) {
  const Period period(kBox, {true, false, true});
  Ray ray{{15.0f, 1.0f, 0.0f}, glm::normalize(Vec3(3.0f, 0.0f, 1.0f))};
  const float far = period.to_side(ray);
  EXPECT_NEAR(far, 5.0f * std::sqrt(10.0f) / 3.0f, 1e-3f);
  ray.origin = ray.at(far);
  period.cross(ray);
  EXPECT_EQ(ray.origin.x, period.box().lo.x);
  EXPECT_NEAR(ray.origin.z, 5.0f / 3.0f, 1e-4f);
  EXPECT_GT(period.to_side(ray), 5.0f) << "away from the side where it stands";
}

TEST(Period, LiesInsideItsBox) {
  const Period period(kBox, {true, false, true});
  EXPECT_GT(period.box().lo.x, kBox.lo.x);
  EXPECT_LT(period.box().hi.z, kBox.hi.z);
  EXPECT_EQ(period.box().hi.y, kBox.hi.y) << "an axis that does not repeat itself";
}

TEST(Period, LetsGoWhatLeavesAlongAnotherAxis) {
  const Period period(kBox, {true, false, true});
  const Vec3 rising = glm::normalize(Vec3(1.0f, 1.0f, 0.0f));
  EXPECT_EQ(period.to_side({{15.0f, 3.5f, 0.0f}, rising}), kInfinity);
  EXPECT_EQ(period.to_side({{15.0f, -0.5f, 0.0f}, -rising}), kInfinity);
  EXPECT_LT(period.to_side({{15.0f, 3.5f, 0.0f}, -rising}), 8.0f) << "it comes back";
  EXPECT_LT(period.to_side({{15.0f, 1.0f, 0.0f}, rising}), 8.0f) << "it is still inside";
}

TEST(Period, StartsBeyondASideAreTakenAcross) {
  const Period period(kBox, {true, false, false});
  Ray ray{{kBox.hi.x, 1.0f, 0.0f}, {1.0f, 0.0f, 0.0f}};
  const float far = period.to_side(ray);
  EXPECT_GT(far, 0.0f);
  EXPECT_LT(far, 1e-20f);
  period.cross(ray);
  EXPECT_EQ(ray.origin.x, period.box().lo.x);
}

TEST(Period, LightEntersThroughTheFaceThatItComesTo) {
  const Period period(kBox, {true, false, true});
  const Box above = period.entrance({0.6f, -0.8f, 0.0f}), below = period.entrance({0.6f, 0.8f, 0.0f});
  EXPECT_EQ(above.lo.y, kBox.hi.y);
  EXPECT_EQ(above.hi.y, kBox.hi.y);
  EXPECT_EQ(below.lo.y, kBox.lo.y);
  EXPECT_EQ(below.hi.y, kBox.lo.y);
  EXPECT_EQ(above.lo.x, period.box().lo.x);
}

}  // namespace
}  // namespace vpm
