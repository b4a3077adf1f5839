// Scenes in memory: arrays in the place of files give the same scene, and what is wrong with them is said.
#include "vpm/input/given_parts.h"

#include <gtest/gtest.h>

#include "input/expectations.h"
#include "input/scene_text.h"
#include "vpm/base/rng.h"
#include "vpm/input/grid/grid_writer.h"
#include "vpm/input/mesh/mesh_writer.h"

namespace vpm {
namespace {

const std::string kSmoke = "[media.smoke]\ntype = \"grid\"\nalbedo = 0.5\n";

/// Densities of an array with empty borders, stored with the first index fastest.
struct Array {
  Vec3i count{9, 5, 12};
  std::vector<float> values = std::vector<float>(static_cast<size_t>(count.x) * count.y * count.z);

  Array() {
    Rng rng(1, 0, 0);
    for (Vec3i p(1, 0, 2); p.x < count.x; ++p.x)
      for (p.y = 0; p.y < count.y - 1; ++p.y)
        for (p.z = 2; p.z < count.z; ++p.z) at(p) = rng.uniform();
  }
  float& at(const Vec3i& p) {
    return values[static_cast<size_t>(p.x) + static_cast<size_t>(count.x * (p.y + count.y * p.z))];
  }
  GridValues given() const {
    GridValues grid{values.data(), count, {1, count.x, count.x * count.y}};
    grid.index_to_world[0] = {0.1, 0.02, 0.0, 0.0};
    grid.index_to_world[1] = {-0.03, 0.2, 0.0, 0.0};
    grid.index_to_world[2] = {0.0, 0.0, 0.15, 0.0};
    grid.index_to_world[3] = {-0.5, -0.4, -0.9, 1.0};
    return grid;
  }
};

RenderJob load_text(const std::string& text, const GivenParts& given) {
  return load_scene(SceneText{"memory", kCamera + kLight + text, given});
}

std::string message_of_grid(const GridValues& grid, const std::string& keys = "") {
  return message_of([&] { load_text(kSmoke + keys + "grid = \"an array\"\n", {{{{"smoke", "density"}, grid}}, {}}); });
}

TEST(GivenParts, AnArrayIsTheGridThatItsFileIs) {
  Array array;
  const std::string path = test_file("array.vdb");
  write_grid(array.given(), path);
  const Scene scene = load_text(kSmoke + "grid = \"an array\"\n", {{{{"smoke", "density"}, array.given()}}, {}}).scene;
  const Scene of_file = load_with(kSmoke + "path = \"" + path + "\"\n").scene;
  const DensityGrid &grid = *scene.media[0].grid, &other = *of_file.media[0].grid;
  EXPECT_EQ(grid.frame().lo, Vec3i(1, 0, 2));
  EXPECT_EQ(grid.frame().hi, Vec3i(8, 3, 11));
  EXPECT_EQ(grid.frame().lo, other.frame().lo);
  EXPECT_EQ(grid.frame().hi, other.frame().hi);
  EXPECT_EQ(grid.frame().index_to_world, other.frame().index_to_world);
  EXPECT_EQ(grid.mean_density(), other.mean_density());
  for (Vec3i p(0); p.x < array.count.x; ++p.x)
    for (p.y = 0; p.y < array.count.y; ++p.y)
      for (p.z = 0; p.z < array.count.z; ++p.z) {
        const Vec3 world(array.given().index_to_world * glm::dvec4(Vec3d(p), 1.0));
        EXPECT_NEAR(grid.density(world), array.at(p), 1e-4f);
        EXPECT_EQ(grid.density(world), other.density(world));
      }
}

TEST(GivenParts, AMeshIsTheOneThatItsFileIs) {
  const TriangleMesh mesh = box_mesh(Vec3d(-1.0), Vec3d(1.0));
  const std::string path = test_file("box.ply"), shape = kGrey + "[[shapes]]\ntype = \"mesh\"\nmaterial = \"grey\"\n";
  write_ply(mesh, path);
  const Scene scene = load_text(shape + "mesh = \"a box\"\n", {{}, {{0, mesh}}}).scene;
  const Scene of_file = load_with(shape + "path = \"" + path + "\"\n").scene;
  EXPECT_EQ(scene.geometry.triangle_count(0), 12u);
  EXPECT_EQ(scene.geometry.area(0), of_file.geometry.area(0));
  EXPECT_EQ(normal_below(scene, 0.1f, 0.2f), Vec3(0, 1, 0));
  TriangleMesh wrong = mesh;
  wrong.triangles[3].y = 8;
  const std::string told = message_of([&] { load_text(shape + "mesh = \"a box\"\n", {{}, {{0, wrong}}}); });
  EXPECT_NE(told.find("a box: a face names vertex 8 (counted from 0), but there are only 8"), std::string::npos)
      << told;
  EXPECT_NE(told.find("memory:14:8"), std::string::npos) << told;
}

TEST(GivenParts, ArraysThatAreNoDensityAreRefusedAtTheirLine) {
  Array array;
  EXPECT_EQ(message_of_grid(array.given()), "");
  EXPECT_NE(message_of_grid(array.given(), "path = \"a.vdb\"\n").find("unknown key 'path'"), std::string::npos);
  GridValues flat = array.given();
  flat.index_to_world[1] = flat.index_to_world[0];
  EXPECT_NE(message_of_grid(flat).find("flattens space"), std::string::npos);
  GridValues perspective = array.given();
  perspective.index_to_world[0][3] = 0.1;
  EXPECT_NE(message_of_grid(perspective).find("the last row"), std::string::npos);
  array.at({2, 1, 3}) = array.at({4, 0, 0}) = -0.5f;
  const std::string negative = message_of_grid(array.given());
  EXPECT_NE(negative.find("2 negative values, the first (-0.5) at [2, 1, 3]"), std::string::npos) << negative;
  EXPECT_NE(negative.find("grid = \"an array\""), std::string::npos) << negative;
  EXPECT_EQ(message_of_grid(array.given(), "clamp_negative = true\n"), "");
  array.at({8, 4, 11}) = kInfinity;
  EXPECT_NE(message_of_grid(array.given()).find("1 NaN or infinite value, the first (inf) at [8, 4, 11]"),
            std::string::npos);
  array.values.assign(array.values.size(), 0.0f);
  EXPECT_NE(message_of_grid(array.given()).find("no value other than 0"), std::string::npos);
}

TEST(GivenParts, TheirValuesTellScenesApart) {
  Array array;
  const auto hash = [&] {
    return load_text(kSmoke + "grid = \"an array\"\n", {{{{"smoke", "density"}, array.given()}}, {}}).hash;
  };
  const std::string before = hash();
  EXPECT_EQ(hash(), before);
  array.at({3, 2, 4}) += 1.0f;
  EXPECT_NE(hash(), before);
}

}  // namespace
}  // namespace vpm
