// Which stretches a ray is made of, and what ends it.
#include "vpm/path/segments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/scenes.h"

namespace vpm {
namespace {

/// Along x: a box of medium 0 in [0, 1], one of medium 1 in [1, 3], vacuum, and a wall at 4. Shapes 0, 1 and 2.
Scene boxes_before_a_wall() {
  Scene scene;
  scene.media.push_back(make_medium(nullptr, Rgb(1.0f)));
  scene.media.push_back(make_medium(nullptr, Rgb(2.0f)));
  const Interface first{0, kVacuum}, second{1, kVacuum};
  add_shape(scene, box_mesh(Vec3d(0, -1, -1), Vec3d(1, 1, 1)), Boundary{}, &first);
  add_shape(scene, box_mesh(Vec3d(1, -1, -1), Vec3d(3, 1, 1)), Boundary{}, &second);
  add_shape(scene, quad_mesh(Vec3d(4, -1, -1), Vec3d(0, 2, 0), Vec3d(0, 0, 2)), Lambertian{});
  scene.geometry.commit();
  return scene;
}

/// Notes the stretches of a ray, of which it passes `most`.
struct Notes {
  Ray ray{Vec3(-0.5f, 0.2f, 0.1f), Vec3(1, 0, 0)};
  MediumId medium = kVacuum;
  size_t most = 100;
  std::vector<float> lengths{};
  std::vector<MediumId> media{};
  std::vector<int> shapes{};  // that end them, the first of several; -1: none

  bool pass(float length, const Encounter& met) {
    lengths.push_back(length);
    media.push_back(medium);
    shapes.push_back(met ? static_cast<int>(met.hits[0].shape) : -1);
    return lengths.size() < most;
  }
};

template <class Visitor>
std::optional<Hit> along(const Scene& scene, float limit, WalkCounters& counters, Visitor& notes) {
  return each_segment(scene, notes.ray, notes.medium, limit, counters, notes);
}

void expect_lengths(const std::vector<float>& lengths, const std::vector<float>& expected) {
  ASSERT_EQ(lengths.size(), expected.size());
  for (size_t i = 0; i < lengths.size(); ++i) EXPECT_NEAR(lengths[i], expected[i], 1e-5f) << i;
}

TEST(Stretches, LeadThroughAllMediaToTheSurface) {
  const Scene scene = boxes_before_a_wall();
  WalkCounters counters;
  Notes notes;
  const std::optional<Hit> wall = along(scene, kInfinity, counters, notes);
  ASSERT_TRUE(wall);
  EXPECT_EQ(wall->shape, 2u);
  EXPECT_NEAR(wall->t, 1.0f, 1e-5f);  // from where the last stretch begins
  EXPECT_EQ(notes.media, (std::vector<MediumId>{kVacuum, 0, 1, kVacuum}));
  expect_lengths(notes.lengths, {0.5f, 1.0f, 2.0f, 1.0f});
  EXPECT_EQ(notes.shapes[0], 0);
  EXPECT_EQ(notes.shapes[2], 1);
  EXPECT_EQ(notes.shapes[3], 2);
  EXPECT_EQ(counters.crossings, 4u);  // two of them where the boxes touch
  EXPECT_EQ(counters.medium_mismatches, 0u);
  EXPECT_NEAR(notes.ray.origin.x, 3.0f, 1e-5f);
  EXPECT_EQ(notes.medium, kVacuum);
}

TEST(Stretches, EndAtTheLimit) {
  const Scene scene = boxes_before_a_wall();
  WalkCounters counters;
  Notes notes;
  EXPECT_FALSE(along(scene, 2.25f, counters, notes));
  EXPECT_EQ(notes.media, (std::vector<MediumId>{kVacuum, 0, 1}));
  expect_lengths(notes.lengths, {0.5f, 1.0f, 0.75f});
  EXPECT_EQ(notes.shapes.back(), -1);
}

TEST(Stretches, EndWithTheScene) {
  const Scene scene = boxes_before_a_wall();
  WalkCounters counters;
  Notes notes;
  notes.ray.direction = Vec3(-1, 0, 0);
  EXPECT_FALSE(along(scene, kInfinity, counters, notes));
  EXPECT_EQ(notes.lengths, std::vector<float>{kInfinity});
  EXPECT_EQ(notes.shapes, std::vector<int>{-1});
}

TEST(Stretches, EndWhereTheVisitorSaysSo) {
  const Scene scene = boxes_before_a_wall();
  for (const size_t most : {1u, 2u, 4u}) {
    WalkCounters counters;
    Notes notes{.most = most};
    EXPECT_FALSE(along(scene, kInfinity, counters, notes)) << most;
    EXPECT_EQ(notes.lengths.size(), most);
    const float stands[] = {-0.5f, 0.0f, 1.0f, 3.0f};  // nothing is crossed after
    EXPECT_NEAR(notes.ray.origin.x, stands[most - 1], 1e-5f) << most;
    EXPECT_EQ(notes.medium, notes.media.back()) << most;
  }
}

/// Measures what is left to a place, as shadow rays do.
struct ToPlace : Notes {
  float place = 0.0f;  // m, along x
  float left(const Ray& behind) const { return place - behind.origin.x; }
};

TEST(Stretches, WhatIsLeftIsWhatTheVisitorSays) {
  const Scene scene = boxes_before_a_wall();
  WalkCounters counters;
  ToPlace into_second;
  into_second.place = 1.75f;
  EXPECT_FALSE(along(scene, 9.0f, counters, into_second));  // the limit holds up to the first boundary
  EXPECT_EQ(into_second.media, (std::vector<MediumId>{kVacuum, 0, 1}));
  EXPECT_EQ(into_second.lengths.back(), 1.75f - into_second.ray.origin.x);
  ToPlace behind;
  behind.place = std::nextafter(1.0f, 2.0f);  // passed with the boundary: no stretch is left
  EXPECT_FALSE(along(scene, 9.0f, counters, behind));
  EXPECT_EQ(behind.media, (std::vector<MediumId>{kVacuum, 0}));
  EXPECT_EQ(behind.medium, 1);
}

}  // namespace
}  // namespace vpm
