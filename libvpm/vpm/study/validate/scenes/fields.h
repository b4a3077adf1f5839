// Density fields whose free flights are tested, and their density integrals by quadrature of look-ups at points:
// nothing of the walk along rays is used.
#pragma once

#include <string>
#include <vector>

#include "vpm/medium/medium.h"
#include "vpm/surface/geometry.h"

namespace vpm {

struct TestField {
  std::string name;
  std::shared_ptr<const DensityGrid> grid;
};

/// Constant, ramp, checker, sparse, Gaussian and random fields of 15^3 voxels about the origin, index -7 to 7, in a
/// turned frame of unequal voxels (about 1/8 m). The first two depend on the x index alone.
std::vector<TestField> test_fields();

/// The same box in voxels a quarter as long, 57^3, of random values from 1/2 to 1 1/2: bricks inside it hold no empty
/// voxel, so that there is a least density.
TestField fine_field();

/// The point of the world at an index of these fields.
Vec3 field_point(const Vec3d& index);
/// The box of index -7 to 7, turned as the fields are, and the mean density in it; 1 without a grid.
TriangleMesh field_box();
double mean_density_in_box(const Medium& medium);
/// Its volume, m^3, and surface, m^2.
double field_box_volume();
double field_box_area();

/// A ray through all of these fields, oblique to their voxels, and its segment inside all of them, where the ramp is a
/// straight line.
Ray test_ray();
Interval test_stretch();

/// The density integral along [t0, t1], m: Gauss's rule on the ray's part in each voxel, where the density is a cubic.
double looked_up_integral(const Medium& medium, const Ray& ray, double t0, double t1);

/// The density integral along the test's ray, from the start of test_stretch() to `t` (m), by the midpoint rule in
/// steps of `step` m, as a march computes it. It serves to state the bias of a march.
double marched_integral(const Medium& medium, double t, double step);

}  // namespace vpm
