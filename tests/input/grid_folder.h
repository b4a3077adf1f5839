// Grids that tests write with OpenVDB, and a folder for their file.
#pragma once

#include <gtest/gtest.h>
#include <filesystem>
#include <string>

#include "vpm/base/rng.h"
#include "vpm/input/grid/grid_file.h"
#include "vpm/input/grid/vdb_grid.h"

namespace vpm {

class GridFile : public ::testing::Test {
 protected:
  GridFile() {
    openvdb::initialize();
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(::testing::TempDir()) / ("grid_file_" + std::string(test->name()));
    std::filesystem::create_directories(folder_);
    path_ = (folder_ / "grid.vdb").string();
  }
  ~GridFile() override { std::filesystem::remove_all(folder_); }

  void write(const openvdb::GridPtrVec& grids) const { openvdb::io::File(path_).write(grids); }
  GridRequest request(const std::string& name = "density") const {
    GridRequest r;
    r.path = path_;
    r.name = name;
    return r;
  }

  std::filesystem::path folder_;
  std::string path_;
};

/// Random values in a box of voxels, some of them left empty.
template <class Grid>
typename Grid::Ptr random_grid(const openvdb::Coord& lo, const openvdb::Coord& hi, float background = 0.0f) {
  auto grid = new_grid<Grid>();
  grid->tree().root().setBackground(background, true);
  grid->setName("density");
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  Rng rng(1, 2, 3);
  auto accessor = grid->getAccessor();
  for (const openvdb::Coord& c : openvdb::CoordBBox(lo, hi))
    if (rng.uniform() < 0.7f) accessor.setValue(c, rng.uniform());
  return grid;
}

}  // namespace vpm
