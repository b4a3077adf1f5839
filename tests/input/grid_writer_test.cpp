// Procedural fields in .vdb files: the values that were asked for, where they belong.
#include "vpm/input/grid/grid_writer.h"

#include <gtest/gtest.h>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "vpm/base/error.h"
#include "vpm/input/grid/grid_file.h"
#include "vpm/medium/grid/procedural.h"

namespace vpm {
namespace {

class GridWriter : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const {
    return (std::filesystem::path(::testing::TempDir()) /
            ("grid_writer_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + "_" +
             name + ".vdb"))
        .string();
  }
  static std::string bytes(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
  static LoadedGrid load(const std::string& file, const std::string& name = "") {
    GridRequest request;
    request.path = file;
    request.name = name;
    return load_grid(request);
  }
};

TEST_F(GridWriter, VoxelsHoldTheFieldAtTheirPositions) {
  constexpr int kResolution = 24;
  for (const ProceduralField& field : procedural_fields()) {
    const std::string file = path(std::string(field.name));
    write_media_grid(std::string(field.name), kResolution, file);
    const auto grid = load(file, std::string(field.grid)).grid;
    const Vec3 size = field.world_size;
    const double spacing = std::max(size.x, std::max(size.y, size.z)) / (kResolution - 1);
    EXPECT_NEAR(grid->voxel_size(), spacing, 1e-6 * spacing) << field.name;
    const Box bounds = grid->bounds();
    EXPECT_GT(bounds.lo.y, -1.01 * spacing) << field.name;  // reaches one voxel beyond the box
    EXPECT_LT(bounds.hi.y, size.y + 1.01 * spacing) << field.name;
    for (const Vec3i& voxel : {grid->frame().lo, grid->frame().hi, (grid->frame().lo + grid->frame().hi) / 2}) {
      const Vec3 world(grid->frame().index_to_world * glm::dvec4(Vec3d(voxel), 1.0));
      const Vec3 unit = world / size + Vec3(0.5f, 0.0f, 0.5f);
      const float tolerance = field.name == "checker" ? 1.0f : field.grid == "temperature" ? 4.0f : 2e-3f;
      EXPECT_NEAR(grid->density(world), field.value(unit), tolerance) << field.name << ", " << field.grid;
    }
    std::filesystem::remove(file);
  }
}

TEST_F(GridWriter, FillsTheBoxAroundTheOrigin) {
  const std::string file = path("constant");
  write_media_grid("constant", 11, file);
  const GridSummary summary = list_grids(file).at(0);
  EXPECT_EQ(summary.name, "density");
  EXPECT_EQ(summary.grid_class, "fog volume");
  EXPECT_EQ(summary.value_type, "float");
  EXPECT_EQ(summary.active_voxels, 1331u);
  EXPECT_LT(glm::length(summary.world_box.lo - Vec3(-0.5f, 0.0f, -0.5f)), 1e-6f);
  EXPECT_LT(glm::length(summary.world_box.hi - Vec3(0.5f, 1.0f, 0.5f)), 1e-6f);
  EXPECT_DOUBLE_EQ(summary.values->mean, 1.0);
  std::filesystem::remove(file);
}

TEST_F(GridWriter, LeavesOutZeros) {
  const std::string file = path("smoke");
  write_media_grid("smoke", 40, file);
  const GridSummary summary = list_grids(file).at(0);
  EXPECT_GT(summary.values->min, 0.0);
  EXPECT_LT(summary.active_voxels, 40u * 28u * 28u / 4u);
  std::filesystem::remove(file);
}

TEST_F(GridWriter, TheSameRequestGivesTheSameBytes) {
  write_media_grid("cloud", 30, path("a"));
  write_media_grid("cloud", 30, path("b"));
  write_media_grid("cloud", 31, path("c"));
  EXPECT_EQ(bytes(path("a")), bytes(path("b")));
  EXPECT_NE(bytes(path("a")).substr(21, 36), bytes(path("c")).substr(21, 36));  // their unique numbers
  for (const char* name : {"a", "b", "c"}) std::filesystem::remove(path(name));
}

TEST_F(GridWriter, RefusesUnknownNamesResolutionsAndPlaces) {
  const auto refusal = [](const std::string& name, int resolution, const std::string& file) -> std::string {
    try {
      write_media_grid(name, resolution, file);
    } catch (const InputError& e) {
      return e.what();
    }
    return "(accepted)";
  };
  EXPECT_NE(refusal("fog", 16, path("x")).find("smoke, cloud, fire, constant"), std::string::npos);
  for (const int resolution : {-1, 0, 1, 2049})
    EXPECT_NE(refusal("ramp", resolution, path("x")).find("between 2 and 2048"), std::string::npos);
  EXPECT_NE(refusal("ramp", 16, "/no/such/folder/x.vdb").find("/no/such/folder"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(path("x")));
}

}  // namespace
}  // namespace vpm
