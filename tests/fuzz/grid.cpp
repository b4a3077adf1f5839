// Any bytes as a .vdb file: what it holds, then each of its grids as a density.
#include "vpm/input/grid/grid_file.h"

#include "fuzz/scratch.h"

namespace vpm {
namespace {

/// Does the grid span many voxels, though not too many to be loaded? Such grids are right and slow.
bool is_slow(const GridSummary& summary) {
  constexpr double kMany = 1 << 22, kTooMany = 1.2e10;
  const Vec3d edges = Vec3d(summary.hi) - Vec3d(summary.lo) + 1.0;
  const double voxels = edges.x * edges.y * edges.z;
  return voxels > kMany && voxels < kTooMany;
}

/// A request that accepts as much as possible of a grid.
GridRequest tolerant_request(const std::string& path, const GridSummary& summary) {
  GridRequest request;
  request.path = path;
  request.name = summary.name;
  request.from_level_set = summary.grid_class == "level set";
  request.clamp_negative = true;
  request.has_bounding_shape = true;
  return request;
}

}  // namespace
}  // namespace vpm

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const vpm::ScratchFolder folder;
  const std::string path = folder.put("grid.vdb", data, size);
  std::vector<vpm::GridSummary> grids;
  vpm::read_or_refuse([&] { grids = vpm::list_grids(path); });
  for (const vpm::GridSummary& grid : grids)
    if (!vpm::is_slow(grid)) vpm::read_or_refuse([&] { vpm::load_grid(vpm::tolerant_request(path, grid)); });
  return 0;
}
