// What the tests of grid files share: OpenVDB's samplers as the truth for values, and the message of a refusal.
#pragma once

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>
#include <string>

#include "vpm/base/error.h"
#include "vpm/base/rng.h"
#include "vpm/input/grid/grid_file.h"

namespace vpm {

/// The message with which load_grid refuses.
inline std::string refusal(const GridRequest& request) {
  try {
    load_grid(request);
  } catch (const InputError& e) {
    return e.what();
  }
  return "(accepted)";
}

/// Both interpolations of the grid in the file equal OpenVDB's samplers, at points inside and around it.
template <class Grid>
void expect_same_as_sampler(const Grid& grid, const GridRequest& request, float tolerance = 1e-5f) {
  for (const Interpolation interpolation : {Interpolation::trilinear, Interpolation::nearest}) {
    GridRequest r = request;
    r.interpolation = interpolation;
    const auto density = load_grid(r).grid;
    const auto accessor = grid.getConstAccessor();
    openvdb::CoordBBox box = static_cast<const openvdb::GridBase&>(grid).evalActiveVoxelBoundingBox();
    box.expand(3);
    Rng rng(4, 5, 6);
    for (int i = 0; i < 20000; ++i) {
      const auto between = [&](int a) { return box.min()[a] + rng.uniform_double() * (box.max()[a] - box.min()[a]); };
      const openvdb::Vec3d somewhere = grid.indexToWorld(openvdb::Vec3d(between(0), between(1), between(2)));
      const Vec3 world(somewhere.x(), somewhere.y(), somewhere.z());
      const openvdb::Vec3d index = grid.worldToIndex(openvdb::Vec3d(world.x, world.y, world.z));
      const double expected = interpolation == Interpolation::trilinear
                                  ? openvdb::tools::BoxSampler::sample(accessor, index)
                                  : openvdb::tools::PointSampler::sample(accessor, index);
      ASSERT_NEAR(density->density(world), expected, tolerance) << "at index " << index;
    }
  }
}

}  // namespace vpm
