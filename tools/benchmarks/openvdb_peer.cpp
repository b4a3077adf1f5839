// OpenVDB's look-ups.
#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>

#include "benchmarks/cloud.h"

namespace vpm::bench {
namespace {

openvdb::FloatGrid::Ptr make_vdb_grid() {
  openvdb::initialize();
  auto grid = openvdb::FloatGrid::create(0.0f);
  auto accessor = grid->getAccessor();
  const Vec3i count = cloud().count;
  for (int z = 0; z < count.z; ++z)
    for (int y = 0; y < count.y; ++y)
      for (int x = 0; x < count.x; ++x)
        if (const float value = cloud().value({x, y, z}); value > 0.0f) accessor.setValue({x, y, z}, value);
  return grid;
}

openvdb::FloatGrid::ConstPtr vdb_grid() {
  static const openvdb::FloatGrid::ConstPtr made = make_vdb_grid();
  return made;
}

}  // namespace

SumDensities openvdb_accessor() {
  return [grid = vdb_grid()](std::span<const Vec3> points) {
    const auto accessor = grid->getConstAccessor();
    double sum = 0.0;
    for (const Vec3& p : points)
      sum += openvdb::tools::BoxSampler::sample(accessor, grid->worldToIndex(openvdb::Vec3d(p.x, p.y, p.z)));
    return sum;
  };
}

SumDensities openvdb_grid_sampler() {
  return [grid = vdb_grid()](std::span<const Vec3> points) {
    const openvdb::tools::GridSampler<openvdb::FloatGrid, openvdb::tools::BoxSampler> sampler(*grid);
    double sum = 0.0;
    for (const Vec3& p : points) sum += sampler.wsSample(openvdb::Vec3d(p.x, p.y, p.z));
    return sum;
  };
}

}  // namespace vpm::bench
