// Writing grids with OpenVDB.
#include "vpm/input/grid/grid_writer.h"

#include <fmt/format.h>
#include <openvdb/tools/Prune.h>
#include <algorithm>

#include "vpm/base/error.h"
#include "vpm/base/parallel.h"
#include "vpm/input/grid/vdb_grid.h"
#include "vpm/input/grid/vdb_write.h"
#include "vpm/medium/grid/procedural.h"

namespace vpm {
namespace {

void check_field(const std::string& name) {
  if (find_procedural_field(name)) return;
  std::string names;
  for (const ProceduralField& field : procedural_fields())
    if (field.grid == "density") names += fmt::format("{}{}", names.empty() ? "" : ", ", field.name);
  throw InputError(fmt::format("there is no medium '{}' to make; there are: {}", name, names));
}

/// Where the voxels of a sampled field lie.
struct Lattice {
  const ProceduralField& field;
  double voxel_size;  // m
  Vec3i count;        // voxels along each edge

  Lattice(const ProceduralField& sampled, int resolution) : field(sampled) {
    const Vec3d size(field.world_size);
    voxel_size = std::max(size.x, std::max(size.y, size.z)) / (resolution - 1);
    count = Vec3i(glm::floor(size / voxel_size + 1e-6)) + 1;
  }
  /// World position of voxel (0, 0, 0), m.
  Vec3d corner() const {
    return {-0.5 * (count.x - 1) * voxel_size, 0.5 * (field.world_size.y - (count.y - 1) * voxel_size),
            -0.5 * (count.z - 1) * voxel_size};
  }
  float value(const Vec3i& voxel) const {
    const Vec3d unit = 0.5 + (Vec3d(voxel) - 0.5 * Vec3d(count - 1)) * voxel_size / Vec3d(field.world_size);
    return field.value(Vec3(unit));
  }
};

/// Samples the field, a slab of leaves at a time.
openvdb::FloatGrid::Ptr sample(const Lattice& lattice) {
  constexpr int kSlab = 8;
  const auto grid = new_grid<openvdb::FloatGrid>();
  auto accessor = grid->getAccessor();
  const Vec3i& count = lattice.count;
  std::vector<float> slab(static_cast<size_t>(kSlab) * count.x * count.y);
  for (int z0 = 0; z0 < count.z; z0 += kSlab) {
    const int layers = std::min(kSlab, count.z - z0);
    parallel_for_chunks(static_cast<size_t>(layers) * count.y, count.y, [&](size_t begin, size_t end, size_t layer) {
      float* value = slab.data() + begin * count.x;
      for (int y = 0; y < static_cast<int>(end - begin); ++y)
        for (int x = 0; x < count.x; ++x) *value++ = lattice.value({x, y, z0 + static_cast<int>(layer)});
    });
    for (int row = 0; row < layers * count.y; ++row)
      for (int x = 0; x < count.x; ++x)
        if (const float value = slab[static_cast<size_t>(row) * count.x + x]; value > 0.0f)
          accessor.setValue({x, row % count.y, z0 + row / count.y}, value);
  }
  openvdb::tools::prune(grid->tree());
  const Vec3d corner = lattice.corner();
  grid->setTransform(openvdb::math::Transform::createLinearTransform(lattice.voxel_size));
  grid->transform().postTranslate({corner.x, corner.y, corner.z});
  grid->setName(std::string(lattice.field.grid));
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  return grid;
}

openvdb::GridPtrVec sample_all(const std::string& name, int resolution) {
  openvdb::GridPtrVec grids;
  for (const ProceduralField& field : procedural_fields())
    if (field.name == name) grids.push_back(sample(Lattice(field, resolution)));
  return grids;
}

/// The values other than 0.
openvdb::FloatGrid::Ptr sparse_grid(const GridValues& values) {
  const auto grid = new_grid<openvdb::FloatGrid>();
  auto accessor = grid->getAccessor();
  for (Vec3i p(0); p.x < values.count.x; ++p.x)
    for (p.y = 0; p.y < values.count.y; ++p.y)
      for (p.z = 0; p.z < values.count.z; ++p.z)
        if (const float value = values.at(p); value != 0.0f) accessor.setValue({p.x, p.y, p.z}, value);
  openvdb::tools::prune(grid->tree());
  grid->setTransform(transform_of(values.index_to_world));
  grid->setName("density");
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  return grid;
}

}  // namespace

void write_media_grid(const std::string& name, int resolution, const std::string& path) {
  check_field(name);
  if (resolution < 2 || resolution > 2048)
    throw InputError(fmt::format("resolution {}: must lie between 2 and 2048", resolution));
  write_vdb([&] { return sample_all(name, resolution); }, path);
}

void write_grid(const GridValues& values, const std::string& path) {
  write_vdb([&] { return openvdb::GridPtrVec{sparse_grid(values)}; }, path);
}

}  // namespace vpm
