// Grids from .vdb files: what they become, what is refused. OpenVDB writes the files; its samplers are the truth.
#include "vpm/input/grid/grid_file.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>

#include "input/grid_expectations.h"
#include "input/grid_folder.h"

namespace vpm {
namespace {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::DoubleGrid;
using openvdb::FloatGrid;
using openvdb::math::Transform;

TEST_F(GridFile, EqualsTheSamplerUnderAnyAffineTransform) {
  using openvdb::math::Mat4d;
  const auto rotated = [] {
    auto t = Transform::createLinearTransform(0.25);
    t->postRotate(0.7, openvdb::math::X_AXIS);
    t->postRotate(-1.1, openvdb::math::Z_AXIS);
    t->postTranslate({3, -2, 1});
    return t;
  };
  const auto stretched = [] {
    auto t = Transform::createLinearTransform(1.0);
    t->preScale({0.1, 0.35, 0.2});
    return t;
  };
  const auto mirrored = [] {
    return Transform::createLinearTransform(Mat4d(-0.5, 0., 0., 0., 0., 0.5, 0., 0., 0., 0., 0.5, 0., 7., 8., 9., 1.));
  };
  const auto sheared = [] {
    return Transform::createLinearTransform(
        Mat4d(0.5, 0.1, 0., 0., 0., 0.4, 0.2, 0., -0.3, 0., 0.6, 0., 1., 2., 3., 1.));
  };
  const std::vector<Transform::Ptr> transforms = {Transform::createLinearTransform(1.0), rotated(), stretched(),
                                                  mirrored(), sheared()};
  for (const auto& transform : transforms) {
    auto grid = random_grid<FloatGrid>(Coord(-13, -9, -20), Coord(5, 11, -2));
    grid->setTransform(transform);
    write({grid});
    expect_same_as_sampler(*grid, request());
  }
}

TEST_F(GridFile, ReadsDoubleHalfAndUnclassedGrids) {
  auto wide = random_grid<DoubleGrid>(Coord(-3), Coord(12));
  write({wide});
  expect_same_as_sampler(*wide, request());
  wide->tree().addTile(1, Coord(16, 0, 0), 0.5, true);
  wide->tree().addTile(1, Coord(0, 16, 0), 0.25, false);
  write({wide});
  EXPECT_EQ(list_grids(path_)[0].active_tiles, 1u);
  expect_same_as_sampler(*wide, request());
  auto half = random_grid<FloatGrid>(Coord(-3), Coord(12));
  half->setSaveFloatAsHalf(true);
  half->setGridClass(openvdb::GRID_UNKNOWN);
  write({half});
  expect_same_as_sampler(*half, request(), 5e-4f);  // half of 2^-10, the spacing of half floats near 1
  EXPECT_EQ(list_grids(path_)[0].value_type, "float stored as half");
}

TEST_F(GridFile, ReadsTilesAndPrunedGrids) {
  auto grid = new_grid<openvdb::FloatGrid>();
  grid->setName("density");
  grid->fill(CoordBBox(Coord(-16, -8, 0), Coord(31, 39, 15)), 0.5f);
  grid->fill(CoordBBox(Coord(40, 3, 5), Coord(44, 11, 9)), 0.25f);
  grid->pruneGrid();
  ASSERT_GT(static_cast<const openvdb::GridBase&>(*grid).activeVoxelCount(), 0u);
  write({grid});
  ASSERT_GT(list_grids(path_)[0].active_tiles, 0u);
  expect_same_as_sampler(*grid, request());
}

TEST_F(GridFile, InactiveValuesCountInsideTheBoxAndNotOutside) {
  auto grid = new_grid<openvdb::FloatGrid>();
  grid->setName("density");
  grid->fill(CoordBBox(Coord(0), Coord(4)), 1.0f);
  grid->tree().setValueOff(Coord(2, 2, 2), 0.5f);
  grid->tree().setValueOff(Coord(6, 2, 2), 0.5f);
  write({grid});
  const auto density = load_grid(request()).grid;
  EXPECT_FLOAT_EQ(density->density(Vec3(2, 2, 2)), 0.5f);
  EXPECT_FLOAT_EQ(density->density(Vec3(6, 2, 2)), 0.0f);
}

TEST_F(GridFile, AnInactiveTileCountsWhereTheBoxCrossesIt) {
  auto grid = new_grid<openvdb::FloatGrid>();
  grid->setName("density");
  grid->tree().addTile(2, Coord(0), 0.5f, false);  // 128^3 voxels
  grid->tree().setValue(Coord(-1, 0, 0), 1.0f);
  grid->tree().setValue(Coord(60, 130, 0), 1.0f);
  write({grid});
  const auto density = load_grid(request()).grid;
  EXPECT_FLOAT_EQ(density->density(Vec3(20, 20, 0)), 0.5f);
  EXPECT_FLOAT_EQ(density->density(Vec3(20, 20, 1)), 0.0f);
  EXPECT_FLOAT_EQ(density->density(Vec3(60, 20, 0)), 0.5f);
  EXPECT_FLOAT_EQ(density->density(Vec3(61, 20, 0)), 0.0f);
}

TEST_F(GridFile, AppliesTheObjectTransformAfterTheGridsOwn) {
  auto grid = random_grid<FloatGrid>(Coord(0), Coord(9));
  grid->setTransform(Transform::createLinearTransform(0.5));
  write({grid});
  GridRequest r = request();
  r.object_to_world =
      Mat4d(0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 10, 20, 30, 1);  // a quarter turn about z, twice as large, moved
  const auto moved = load_grid(r).grid;
  const auto plain = load_grid(request()).grid;
  EXPECT_FLOAT_EQ(moved->voxel_size(), 1.0f);
  Rng rng(7, 8, 9);
  for (int i = 0; i < 100; ++i) {
    const Vec3 p(5 * rng.uniform(), 5 * rng.uniform(), 5 * rng.uniform());
    EXPECT_NEAR(moved->density(Vec3(10 - 2 * p.y, 20 + 2 * p.x, 30 + 2 * p.z)), plain->density(p), 2e-5f);
  }
}

TEST_F(GridFile, FindsGridsByNameAndRepeatedOnesByNumber) {
  openvdb::GridPtrVec grids;
  for (const float value : {1.0f, 2.0f, 3.0f}) {
    auto grid = new_grid<openvdb::FloatGrid>();
    grid->setName(value == 3.0f ? "heat" : "density");
    grid->fill(CoordBBox(Coord(0), Coord(3)), value);
    grids.push_back(grid);
  }
  write(grids);
  EXPECT_FLOAT_EQ(load_grid(request("density[0]")).grid->max_density(), 1.0f);
  EXPECT_FLOAT_EQ(load_grid(request("density[1]")).grid->max_density(), 2.0f);
  for (const char* name : {"heat", "Heat"}) EXPECT_FLOAT_EQ(load_grid(request(name)).grid->max_density(), 3.0f);
  for (const std::string name : {"density", "density[2]", "heats", ""}) {
    const std::string message = refusal(request(name));
    EXPECT_NE(message.find("density[0] (float, class unknown), density[1] (float, class unknown), heat (float"),
              std::string::npos)
        << message;
  }
}

TEST_F(GridFile, OneGridNeedsNoName) {
  const auto named = [](const std::string& name, float value) {
    auto grid = new_grid<openvdb::FloatGrid>();
    grid->setName(name);
    grid->fill(CoordBBox(Coord(0), Coord(3)), value);
    return grid;
  };
  write({named("fog", 1.0f)});
  EXPECT_FLOAT_EQ(load_grid(request("")).grid->max_density(), 1.0f);
  write({named("fog", 1.0f), named("density", 2.0f)});
  EXPECT_FLOAT_EQ(load_grid(request("")).grid->max_density(), 2.0f);
  write({named("fog", 1.0f), named("ash", 2.0f)});
  const std::string message = refusal(request(""));
  EXPECT_NE(
      message.find("has no single grid named 'density': name another one with grid = \"...\"; the file holds: fog "
                   "(float, class unknown), ash (float"),
      std::string::npos)
      << message;
}

TEST_F(GridFile, SharesTreesBetweenInstances) {
  auto first = random_grid<FloatGrid>(Coord(0), Coord(9));
  auto second = first->copy();
  second->setName("copy");
  second->setTransform(Transform::createLinearTransform(2.0));
  write({first, second});
  expect_same_as_sampler(*second, request("copy"));
}

TEST_F(GridFile, RefusesLevelSetsUnlessAskedToConvertThem) {
  auto sphere = openvdb::tools::createLevelSetSphere<FloatGrid>(2.0f, {0, 0, 0}, 0.1f);
  sphere->setName("density");
  write({sphere});
  EXPECT_NE(refusal(request()).find("from_level_set"), std::string::npos);
  GridRequest r = request();
  r.from_level_set = true;
  const auto fog = load_grid(r).grid;
  EXPECT_FLOAT_EQ(fog->density(Vec3(0.0f)), 1.0f);
  EXPECT_FLOAT_EQ(fog->density(Vec3(2.15f, 0.0f, 0.0f)), 0.0f);
  EXPECT_NEAR(fog->density(Vec3(0.0f, 1.85f, 0.0f)), 0.5f, 0.01f);  // the ramp is 3 voxels deep
  auto dense = random_grid<FloatGrid>(Coord(0), Coord(9));
  write({dense});
  EXPECT_NE(refusal(r).find("fog volume already"), std::string::npos);
}

/// Of leaves and of tiles; bool and mask grids are 0 and 1.
TEST_F(GridFile, WholeNumbersAreDensities) {
  const auto expect_as_floats = [&]<class Grid>(const typename Grid::Ptr& whole) {
    using Value = typename Grid::ValueType;
    auto floats = new_grid<FloatGrid>();
    Rng rng(3, rng_stream(RngUse::test, 0), 0);
    for (int i = 0; i < 500; ++i) {
      const Coord at(static_cast<int>(20.0f * rng.uniform()), static_cast<int>(9.0f * rng.uniform()), i % 11);
      const auto value = static_cast<Value>(9.0f * rng.uniform());
      whole->tree().setValue(at, value);
      floats->tree().setValue(at, static_cast<float>(value));
    }
    whole->tree().addTile(1, Coord(24, 0, 0), Value(1), true);
    floats->tree().addTile(1, Coord(24, 0, 0), 1.0f, true);
    whole->setName("density");
    write({whole});
    expect_same_as_sampler(*floats, request());
    EXPECT_TRUE(list_grids(path_)[0].numbers);
  };
  expect_as_floats.operator()<openvdb::Int32Grid>(openvdb::Int32Grid::create());
  expect_as_floats.operator()<openvdb::Int64Grid>(openvdb::Int64Grid::create());
  expect_as_floats.operator()<openvdb::BoolGrid>(openvdb::BoolGrid::create());
}

TEST_F(GridFile, MasksAreDensities) {
  auto mask = openvdb::MaskGrid::create();
  auto floats = new_grid<FloatGrid>();
  for (int i = 0; i < 30; ++i) {
    mask->tree().setValueOn(Coord(i % 7, i % 5, i));
    floats->tree().setValue(Coord(i % 7, i % 5, i), 1.0f);
  }
  mask->setName("density");
  write({mask});
  expect_same_as_sampler(*floats, request());
}

TEST_F(GridFile, EmptyGridsAreVacuum) {
  auto empty = new_grid<openvdb::FloatGrid>();
  empty->setName("density");
  write({empty});
  const LoadedGrid loaded = load_grid(request());
  EXPECT_EQ(loaded.grid->max_density(), 0.0f);
  ASSERT_EQ(loaded.notes.size(), 1u);
  EXPECT_NE(loaded.notes[0].find("no active voxels"), std::string::npos);
}

TEST_F(GridFile, RefusesOtherTypesAndNonlinearTransforms) {
  auto vectors = new_grid<openvdb::Vec3SGrid>();
  vectors->setName("density");
  vectors->fill(CoordBBox(Coord(0), Coord(3)), openvdb::Vec3f(1.0f));
  write({vectors});
  EXPECT_NE(refusal(request()).find("holds vec3s values"), std::string::npos);
  EXPECT_NE(refusal(request()).find("the file holds: density (vec3s, "), std::string::npos);
  EXPECT_EQ(list_grids(path_)[0].active_voxels, 64u);
  auto bent = random_grid<FloatGrid>(Coord(0), Coord(9));
  bent->setTransform(Transform::createFrustumTransform(openvdb::BBoxd({0, 0, 0}, {10, 10, 10}), 0.5, 1.0));
  write({bent});
  EXPECT_NE(refusal(request()).find("not affine"), std::string::npos);
  EXPECT_FALSE(list_grids(path_)[0].index_to_world.has_value());
}

TEST_F(GridFile, RefusesValuesThatAreNotNumbersAndSaysWhere) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    auto grid = random_grid<FloatGrid>(Coord(0), Coord(9));
    grid->setTransform(Transform::createLinearTransform(0.5));
    grid->tree().setValue(Coord(3, 4, 5), bad);
    grid->tree().setValueOff(Coord(9, 9, 9), bad);
    write({grid});
    GridRequest r = request();
    r.clamp_negative = true;
    EXPECT_NE(refusal(r).find("has 2 NaN or infinite values, the first"), std::string::npos) << refusal(r);
    EXPECT_NE(refusal(r).find("voxel (3, 4, 5), world position (1.5, 2, 2.5) m"), std::string::npos) << refusal(r);
  }
  auto wide = random_grid<DoubleGrid>(Coord(0), Coord(9));
  wide->tree().setValue(Coord(1, 1, 1), 1e39);
  write({wide});
  EXPECT_NE(refusal(request()).find("(1e+39) at voxel (1, 1, 1)"), std::string::npos) << refusal(request());
  wide->tree().setValue(Coord(1, 1, 1), -1e-60);
  write({wide});
  EXPECT_NE(refusal(request()).find("has 1 negative value"), std::string::npos) << refusal(request());
}

TEST_F(GridFile, ClampsNegativeValuesOnlyOnRequestAndCountsThem) {
  auto grid = random_grid<FloatGrid>(Coord(0), Coord(20));
  grid->tree().setValue(Coord(3, 4, 5), -0.5f);
  grid->tree().addTile(1, Coord(8, 8, 8), -0.25f, true);
  write({grid});
  EXPECT_NE(refusal(request()).find("has 513 negative values"), std::string::npos) << refusal(request());
  GridRequest r = request();
  r.clamp_negative = true;
  const LoadedGrid loaded = load_grid(r);
  EXPECT_EQ(loaded.clamped_values, 513u);
  EXPECT_FLOAT_EQ(loaded.grid->density(Vec3(3, 4, 5)), 0.0f);
  EXPECT_FLOAT_EQ(loaded.grid->density(Vec3(11, 12, 13)), 0.0f);
  auto clean = random_grid<FloatGrid>(Coord(0), Coord(9));
  write({clean});
  EXPECT_EQ(load_grid(r).clamped_values, 0u);
}

TEST_F(GridFile, ABackgroundNeedsABoundingShape) {
  auto grid = random_grid<FloatGrid>(Coord(0), Coord(9), 0.75f);
  write({grid});
  EXPECT_NE(refusal(request()).find("background 0.75"), std::string::npos);
  GridRequest r = request();
  r.has_bounding_shape = true;
  EXPECT_FLOAT_EQ(load_grid(r).grid->density(Vec3(500.0f, 0.0f, 0.0f)), 0.75f);
  expect_same_as_sampler(*grid, r);
}

TEST_F(GridFile, ReadsTheFewVoxelsOfAWideBox) {
  auto grid = random_grid<FloatGrid>(Coord(-13, -9, -20), Coord(5, 11, -2));
  grid->tree().setValue(Coord(1'000'000'000, 5, -1'000'000'000), 3.0f);
  grid->tree().addTile(1, Coord(800'000, 80, 80), 2.0f, true);
  grid->tree().addTile(1, Coord(800'000, 8, 80), 4.0f, false);  // no voxel is active, but they have that value
  write({grid});
  const auto density = load_grid(request()).grid;
  EXPECT_LT(density->memory_bytes(), 1u << 20);
  EXPECT_EQ(density->max_density(), 4.0f);
  EXPECT_EQ(density->density(Vec3(1e9f, 5.0f, -1e9f)), 3.0f);
  EXPECT_EQ(density->density(Vec3(800'004.0f, 84.0f, 84.0f)), 2.0f);
  EXPECT_EQ(density->density(Vec3(800'004.0f, 12.0f, 84.0f)), 4.0f);
  EXPECT_EQ(density->density(Vec3(800'004.0f, 44.0f, 84.0f)), 0.0f);
  for (const Coord& at : {Coord(-12, 3, -7), Coord(0), Coord(4, 10, -3)})
    EXPECT_EQ(density->density(Vec3(at.x(), at.y(), at.z())), grid->tree().getValue(at));
}

/// One table could hold its bricks, of which rays would cross 125,000 to come from one end to the other.
TEST_F(GridFile, StoresWhatASparseGridHoldsWhereATableWouldBeNearlyEmpty) {
  auto grid = random_grid<FloatGrid>(Coord(-13, -9, -20), Coord(5, 11, -2));
  grid->tree().setValue(Coord(1'000'000, 5, -7), 3.0f);
  write({grid});
  const auto density = load_grid(request()).grid;
  EXPECT_LT(density->memory_bytes(), 1u << 20);
  EXPECT_EQ(density->density(Vec3(1e6f, 5.0f, -7.0f)), 3.0f);
  const Ray along{Vec3(-100.0f, 5.0f, -7.0f), Vec3(1.0f, 0.0f, 0.0f)};
  EXPECT_LT(density->visit_majorants(along, {}, [](const DensityStretch&) { return true; }), 100u);
}

TEST_F(GridFile, RefusesBoxesThatWouldNotFitInMemory) {
  auto grid = new_grid<openvdb::FloatGrid>();
  grid->setName("density");
  grid->sparseFill(openvdb::CoordBBox(Coord(0), Coord(5 * 4096 - 1)), 1.0f);
  write({grid});
  EXPECT_NE(refusal(request()).find("too large"), std::string::npos) << refusal(request());
  grid->clear();
  grid->tree().setValue(Coord(1500000000), 1.0f);
  grid->tree().setValue(Coord(-1500000000), 1.0f);
  write({grid});
  EXPECT_NE(refusal(request()).find("beyond"), std::string::npos) << refusal(request());
}

TEST_F(GridFile, SummarizesGrids) {
  auto grid = new_grid<openvdb::FloatGrid>();
  grid->setName("density");
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  grid->setTransform(Transform::createLinearTransform(0.5));
  grid->transform().postTranslate({1, 2, 3});
  grid->tree().addTile(1, Coord(8, 0, 0), 2.0f, true);
  grid->tree().setValue(Coord(-1, 0, 0), 5.0f);
  write({grid});
  const GridSummary s = list_grids(path_).at(0);
  EXPECT_EQ(s.grid_class, "fog volume");
  EXPECT_EQ(s.value_type, "float");
  EXPECT_TRUE(s.problem.empty());
  EXPECT_TRUE(s.axis_aligned);
  EXPECT_EQ(s.active_voxels, 513u);
  EXPECT_EQ(s.active_tiles, 1u);
  EXPECT_EQ(s.lo, Vec3i(-1, 0, 0));
  EXPECT_EQ(s.hi, Vec3i(15, 7, 7));
  EXPECT_EQ(s.world_box.lo, Vec3(0.5f, 2.0f, 3.0f));
  EXPECT_EQ(s.world_box.hi, Vec3(8.5f, 5.5f, 6.5f));
  ASSERT_TRUE(s.values.has_value());
  EXPECT_DOUBLE_EQ(s.values->min, 2.0);
  EXPECT_DOUBLE_EQ(s.values->max, 5.0);
  EXPECT_DOUBLE_EQ(s.values->mean, (512 * 2.0 + 5.0) / 513);
  EXPECT_GT(s.memory_bytes, 2048u);
}

TEST_F(GridFile, SummarizesWhatIsNotANumber) {
  auto grid = new_grid<openvdb::FloatGrid>();
  const float values[] = {2.0f, std::numeric_limits<float>::quiet_NaN(), 3.0f};
  for (int x = 0; x < 3; ++x) grid->tree().setValue(Coord(x, 0, 0), values[x]);
  write({grid});
  const GridSummary s = list_grids(path_).at(0);
  EXPECT_EQ(s.values->min, 2.0);
  EXPECT_EQ(s.values->max, 3.0);
  EXPECT_TRUE(std::isnan(s.values->mean));
}

}  // namespace
}  // namespace vpm
