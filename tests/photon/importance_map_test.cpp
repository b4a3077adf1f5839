// Importance on a grid: lengths of tracks, where it rises, and what importons make of a room.
#include "vpm/photon/importons.h"

#include <gtest/gtest.h>

#include "support/scenes.h"
#include "vpm/medium/make_grid.h"

namespace vpm {
namespace {

const Box kImportanceBox{Vec3(-1.0f, -2.0f, 0.0f),
                         Vec3(3.0f, 0.0f, 1.0f)};  // 4 x 2 x 1 m: cubes of 1/2 m are 8 x 4 x 2

Vec3 centre(int x, int y, int z) { return kImportanceBox.lo + 0.5f * (Vec3(x, y, z) + 0.5f); }

TEST(ImportanceMap, TracksLeaveTheirLengthInEachCube) {
  ImportanceMap map(kImportanceBox, 8);
  map.add_track({centre(1, 2, 0), Vec3(1.0f, 0.0f, 0.0f)}, 1.0f, 3.0f);
  EXPECT_FLOAT_EQ(map.at(centre(1, 2, 0)), 3.0f * 0.5f);  // a quarter of a metre of half a metre
  EXPECT_FLOAT_EQ(map.at(centre(2, 2, 0)), 3.0f);
  EXPECT_FLOAT_EQ(map.at(centre(3, 2, 0)), 3.0f * 0.5f);
  EXPECT_EQ(map.at(centre(4, 2, 0)), 0.0f);
  EXPECT_EQ(map.at(centre(2, 1, 0)), 0.0f);
}

TEST(ImportanceMap, SlantedTracksLeaveAllTheirLengthInside) {
  ImportanceMap map(kImportanceBox, 8);
  const Vec3 from(-3.0f, -2.5f, 0.3f), to(4.0f, 1.0f, 0.6f);  // in by x at -1, out by y at 0
  map.add_track({from, glm::normalize(to - from)}, glm::distance(from, to), 1.0f);
  double sum = 0.0;
  for (int x = 0; x < 8; ++x)
    for (int y = 0; y < 4; ++y)
      for (int z = 0; z < 2; ++z) sum += map.at(centre(x, y, z)) * 0.5;
  const float share = 2.5f / 3.5f - 2.0f / 7.0f;  // between y = 0 and x = -1
  EXPECT_NEAR(sum, share * glm::distance(from, to), 1e-5);
}

TEST(ImportanceMap, TellsWhereImportanceRises) {
  ImportanceMap map(kImportanceBox, 8);
  map.add_track({centre(5, 1, 1), Vec3(0.0f, 1.0f, 0.0f)}, 0.1f, 10.0f);  // 2 in that cube alone
  const Ray along{centre(1, 1, 1), Vec3(1.0f, 0.0f, 0.0f)};
  const float rise = map.first_above(along, 1.0f);
  EXPECT_NEAR(rise, 1.75f, 1e-3f);
  EXPECT_GT(map.at(along.at(rise)), 1.0f);
  EXPECT_EQ(map.first_above(along, 3.0f), kInfinity);
  EXPECT_EQ(map.first_above({centre(5, 1, 1), Vec3(1.0f, 0.0f, 0.0f)}, 1.0f), kInfinity);  // from there it falls
  EXPECT_EQ(map.first_above({centre(1, 2, 1), Vec3(1.0f, 0.0f, 0.0f)}, 1.0f), kInfinity);  // passes by
}

TEST(ImportanceMap, IsPositiveEverywhereOnceFinished) {
  ImportanceMap map(kImportanceBox, 8);
  map.add_track({centre(5, 1, 1), Vec3(0.0f, 1.0f, 0.0f)}, 0.1f, 10.0f);
  map.finish();
  EXPECT_GT(map.at(centre(0, 0, 0)), 0.0f);
  EXPECT_GT(map.at(centre(5, 1, 1)), map.at(centre(6, 1, 1)));
  EXPECT_GT(map.at(centre(6, 1, 1)), 100.0f * map.at(centre(0, 0, 0)));
  ImportanceMap dark(kImportanceBox, 8);
  dark.finish();
  EXPECT_GT(dark.at(centre(0, 0, 0)), 0.0f);
}

/// In a purely absorbing fog importons fly straight on: what the camera sees at a distance is worth exp(-distance) as
/// much, and what is behind it nothing but the least.
TEST(ImportanceMap, ImportonsFadeAsLightDoes) {
  Medium fog;
  fog.sigma_t = Rgb(1.0f);
  Scene scene = boxed_medium(fog, PointLight{Vec3(0.0f, 0.9f, 0.0f), Rgb(1.0f)});
  scene.camera = make_camera(Vec3(0.0f, 0.0f, 0.95f), Vec3(0.0f), Vec3(0, 1, 0), 2.0f, {8, 8});
  scene.camera_medium = medium_at(scene, scene.camera.position);
  const auto strategy = make_distance_strategy({});
  const ImportanceMap map = trace_importons(scene, *strategy, {.importons = 20'000}, 1, 0, 100).map;
  // The beam stays within the cubes about the axis.
  const double fade = map.at(Vec3(0.01f, 0.01f, -0.5f)) / map.at(Vec3(0.01f, 0.01f, 0.5f));
  EXPECT_NEAR(fade, std::exp(-1.0), 0.03);  // 7400 importons of 20,000 are left: their share is off by 0.0034 / 0.37
  EXPECT_GT(map.at(Vec3(0.01f, 0.01f, 0.5f)), 1e3f * map.at(Vec3(0.8f, 0.8f, 0.5f)));
}

}  // namespace
}  // namespace vpm
