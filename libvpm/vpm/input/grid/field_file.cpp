// Cells become voxels.
#include "vpm/input/grid/field_file.h"

#include <fmt/format.h>

#include "vpm/base/atomic_file.h"
#include "vpm/base/error.h"
#include "vpm/input/grid/vdb_write.h"

namespace vpm {
namespace {

Mat4d to_world(const CellLattice& lattice) {
  const Vec3d edges = lattice.edges(), first = Vec3d(lattice.box.lo) + 0.5 * edges;
  Mat4d map(1.0);
  for (int a = 0; a < 3; ++a) {
    map[a][a] = edges[a];
    map[3][a] = first[a];
  }
  return map;
}

/// The values at(number of the cell), those that are 0 too: so the grid's box is that of the cells.
template <class Grid, class At>
openvdb::GridBase::Ptr cells_grid(const std::string& name, const CellLattice& lattice, At&& at) {
  const auto grid = new_grid<Grid>();
  auto accessor = grid->getAccessor();
  for (Vec3i p(0); p.x < lattice.count.x; ++p.x)
    for (p.y = 0; p.y < lattice.count.y; ++p.y)
      for (p.z = 0; p.z < lattice.count.z; ++p.z) accessor.setValue({p.x, p.y, p.z}, at(lattice.number_of(p)));
  grid->setTransform(transform_of(to_world(lattice)));
  grid->setName(name);
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  return grid;
}

constexpr std::array kChannels{"_r", "_g", "_b"};

/// Calls add(name of the grid, channel): one for all channels of grey scenes.
template <class Add>
void for_channels(const std::string& name, const FluenceField& field, Add&& add) {
  for (int c = 0; c < (field.grey ? 1 : 3); ++c) add(field.grey ? name : name + kChannels[static_cast<size_t>(c)], c);
}

void add_quantity(const std::string& quantity, const FluenceField& field, const std::vector<Rgb>& values,
                  openvdb::GridPtrVec& grids) {
  for_channels(quantity, field, [&](const std::string& name, int c) {
    grids.push_back(cells_grid<openvdb::FloatGrid>(name, field.lattice, [&](size_t cell) { return values[cell][c]; }));
  });
}

void add_flux(const std::string& quantity, const FluenceField& field, const std::array<std::vector<Rgb>, 3>& along,
              openvdb::GridPtrVec& grids) {
  for_channels(quantity, field, [&](const std::string& name, int c) {
    grids.push_back(cells_grid<openvdb::Vec3SGrid>(name, field.lattice, [&](size_t cell) {
      return openvdb::Vec3s(along[0][cell][c], along[1][cell][c], along[2][cell][c]);
    }));
  });
}

openvdb::GridPtrVec grids_of(const FluenceField& field) {
  openvdb::GridPtrVec grids;
  const bool errors = field.run.passes > 1;  // else they are not known
  add_quantity("fluence", field, field.fluence, grids);
  add_quantity("absorbed", field, field.absorbed, grids);
  if (errors) {
    add_quantity("fluence_error", field, field.fluence_error, grids);
    add_quantity("absorbed_error", field, field.absorbed_error, grids);
  }
  if (!field.flux[0].empty()) {
    add_flux("flux", field, field.flux, grids);
    if (errors) add_flux("flux_error", field, field.flux_error, grids);
  }
  return grids;
}

}  // namespace

void check_field_file(const std::filesystem::path& path) {
  if (path.extension() != ".npy" && path.extension() != ".vdb")
    throw InputError(fmt::format("{}: fields are written as .npy or .vdb", path.string()));
  check_writable(path, 0);
}

void write_field(const FluenceField& field, const std::filesystem::path& path) {
  check_field_file(path);
  if (path.extension() == ".npy") return write_npy(field, path);
  write_vdb([&] { return grids_of(field); }, path.string());
}

}  // namespace vpm
