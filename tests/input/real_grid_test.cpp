// Grids that others made, production data and awkward ones: read as OpenVDB reads them, or refused.
#include <filesystem>

#include "input/grid_expectations.h"

namespace vpm {
namespace {

class RealGrid : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kFolder)) GTEST_SKIP() << "no " << kFolder;
  }
  /// Compares a file's grid with OpenVDB's own reading of it.
  static void expect_same(const std::string& file, const std::string& name = "density", bool bounded = false) {
    GridRequest request;
    request.path = kFolder + file;
    request.name = name;
    request.has_bounding_shape = bounded;
    openvdb::initialize();
    openvdb::io::File reader(request.path);
    reader.open(false);
    const auto grid = reader.readGrid(name);
    const float scale = std::max(1.0f, load_grid(request).grid->max_density());
    if (const auto narrow = openvdb::gridPtrCast<openvdb::FloatGrid>(grid))
      expect_same_as_sampler(*narrow, request, 1e-5f * scale);
    else
      expect_same_as_sampler(*openvdb::gridPtrCast<openvdb::DoubleGrid>(grid), request, 1e-5f * scale);
  }
  static std::string refusal(const std::string& file, const std::string& name = "density") {
    GridRequest request;
    request.path = kFolder + file;
    request.name = name;
    return vpm::refusal(request);
  }

  inline static const std::string kFolder = std::string(VPM_SHARED_DIR) + "/vdb/";
};

TEST_F(RealGrid, EqualTheSampler) {
  expect_same("smoke1.vdb");
  expect_same("wdas_cloud_sixteenth.vdb");
  expect_same("usd_smoke3.vdb");
  expect_same("edge/affine_rotated_dragon.vdb");
  expect_same("edge/background_one_box.vdb", "density", true);
  expect_same("edge/double_grid.vdb");
  expect_same("edge/duplicate_names.vdb", "density[1]");
  expect_same("edge/other_name_voxel_fog_density.vdb", "voxel_fog_density");
}

/// Whatever their files say of the boxes around them.
TEST_F(RealGrid, AreVacuumWhereTheyAreEmpty) {
  for (const auto& [file, name] : {std::pair{"empty_density.vdb", "density"},
                                   {"damaged_bad-bbox-bomb_40ba.vdb", "bomb"},
                                   {"damaged_bad-bbox-huge_2258.vdb", "huge"},
                                   {"damaged_bad-bbox-inverted_3691.vdb", "inverted"}}) {
    GridRequest request;
    request.path = kFolder + "edge/" + file;
    request.name = name;
    EXPECT_EQ(load_grid(request).grid->max_density(), 0.0f) << file;
  }
}

TEST_F(RealGrid, AreRefusedWhereTheyAreNoDensities) {
  EXPECT_NE(refusal("ls_sphere.vdb", "ls_sphere").find("level set"), std::string::npos);
  EXPECT_NE(refusal("edge/background_one_box.vdb").find("background 1"), std::string::npos);
  EXPECT_NE(refusal("edge/duplicate_names.vdb").find("density[0]"), std::string::npos);
  EXPECT_NE(refusal("edge/other_name_voxel_fog_density.vdb").find("voxel_fog_density"), std::string::npos);
  EXPECT_NE(refusal("edge/vec3_only_Cd.vdb", "Cd").find("vec3s"), std::string::npos);
  EXPECT_NE(refusal("edge/pointdata_only.vdb", "points").find("ptdataidx32"), std::string::npos);
  EXPECT_NE(refusal("edge/damaged_truncated_14b0.vdb", "huge").find("truncated"), std::string::npos);
  EXPECT_NE(refusal("edge/lfs_pointer_text.vdb").find("git-lfs"), std::string::npos);
}

}  // namespace
}  // namespace vpm
