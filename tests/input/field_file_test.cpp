// Fields as grids, read again.
#include "vpm/input/grid/field_file.h"

#include <gtest/gtest.h>

#include <openvdb/openvdb.h>

#include "vpm/base/error.h"
#include "vpm/input/grid/grid_file.h"

namespace vpm {
namespace {

FluenceField some_field() {
  FluenceField field;
  field.lattice = {{{-1.0f, 2.0f, 0.0f}, {1.0f, 5.0f, 0.5f}}, {4, 3, 2}};
  field.run.passes = 2;
  for (size_t cell = 0; cell < field.lattice.size(); ++cell) {
    const auto value = static_cast<float>(cell);
    field.fluence.push_back(Rgb(value, 2.0f * value, 3.0f * value));
    field.absorbed.push_back(Rgb(0.5f * value));
    field.fluence_error.push_back(Rgb(0.1f * value));
    field.absorbed_error.push_back(Rgb(0.01f * value));
  }
  field.flux = {field.fluence, field.absorbed, std::vector<Rgb>(field.lattice.size(), Rgb(23.0f))};
  field.flux_error = field.flux;
  return field;
}

std::vector<std::string> names_of(const std::string& path) {
  std::vector<std::string> names;
  for (const GridSummary& grid : list_grids(path)) names.push_back(grid.name + " " + grid.value_type);
  return names;
}

void expect_values(const std::string& path, const std::string& name, const CellLattice& lattice, float factor) {
  const LoadedGrid loaded = load_grid({.path = path, .name = name, .interpolation = Interpolation::nearest});
  for (Vec3i cell(0); cell.x < lattice.count.x; ++cell.x)
    for (cell.y = 0; cell.y < lattice.count.y; ++cell.y)
      for (cell.z = 0; cell.z < lattice.count.z; ++cell.z) {
        const Vec3d center = Vec3d(lattice.box.lo) + (Vec3d(cell) + 0.5) * lattice.edges();
        EXPECT_FLOAT_EQ(loaded.grid->density(Vec3(center)), factor * static_cast<float>(lattice.number_of(cell)));
      }
}

TEST(FieldFile, HasAGridForEachChannelWhoseVoxelsAreTheCells) {
  const FluenceField field = some_field();
  const std::string path = testing::TempDir() + "field.vdb";
  write_field(field, path);
  EXPECT_EQ(names_of(path),
            (std::vector<std::string>{
                "fluence_r float", "fluence_g float", "fluence_b float", "absorbed_r float", "absorbed_g float",
                "absorbed_b float", "fluence_error_r float", "fluence_error_g float", "fluence_error_b float",
                "absorbed_error_r float", "absorbed_error_g float", "absorbed_error_b float", "flux_r vec3s",
                "flux_g vec3s", "flux_b vec3s", "flux_error_r vec3s", "flux_error_g vec3s", "flux_error_b vec3s"}));
  expect_values(path, "fluence_b", field.lattice, 3.0f);
  expect_values(path, "absorbed_error_g", field.lattice, 0.01f);
}

TEST(FieldFile, FluxIsAVectorInSpace) {
  const std::string path = testing::TempDir() + "flux.vdb";
  write_field(some_field(), path);
  openvdb::io::File file(path);
  file.open();
  const auto flux = openvdb::gridPtrCast<openvdb::Vec3SGrid>(file.readGrid("flux_g"));
  const openvdb::Vec3s value = flux->tree().getValue({3, 2, 1});  // of the last cell, whose number is 23
  EXPECT_EQ(value, openvdb::Vec3s(46.0f, 11.5f, 23.0f));
}

TEST(FieldFile, OfGreyScenesHasOneForAllChannels) {
  FluenceField field = some_field();
  field.grey = true;
  field.run.passes = 1;
  field.flux = {};
  const std::string path = testing::TempDir() + "grey.vdb";
  write_field(field, path);
  EXPECT_EQ(names_of(path), (std::vector<std::string>{"fluence float", "absorbed float"})) << "errors are not known";
  expect_values(path, "fluence", field.lattice, 1.0f);
}

TEST(FieldFile, RefusesOtherNamesAndFolders) {
  EXPECT_THROW(check_field_file("a.exr"), InputError);
  EXPECT_THROW(check_field_file("nowhere/a.vdb"), InputError);
}

}  // namespace
}  // namespace vpm
