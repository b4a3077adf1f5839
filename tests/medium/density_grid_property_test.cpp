// Grids of any shape and transform: density integrals add up, are the same from both ends, follow the transform; and
// any piece of density is inverted.
#include "support/grids.h"
#include "support/properties.h"
#include "vpm/base/rng.h"

namespace vpm {
namespace {

Mat4d any_transform() {
  Mat4d m = glm::translate(Mat4d(1.0), Vec3d(*vector_in(-5, 5)));
  m = glm::rotate(m, *number(-3.2, 3.2), Vec3d(*unit_vector()));
  const Vec3d size(*magnitude(0.02, 2.0), *magnitude(0.02, 2.0), *magnitude(0.02, 2.0));
  const Vec3 side = *rc::gen::element(Vec3(1, 1, 1), Vec3(-1, 1, 1), Vec3(1, -1, -1));
  m = glm::scale(m, size * Vec3d(side));
  m[1][0] += *rc::gen::element(0.0, 0.01);  // shear
  return m;
}

/// Random voxels, some of them zeros, in a box of any place and size.
std::shared_ptr<const DensityGrid> any_grid(GridFrame& frame) {
  frame.index_to_world = any_transform();
  for (int a = 0; a < 3; ++a) {
    frame.lo[a] = *rc::gen::inRange(-20, 20);
    frame.hi[a] = frame.lo[a] + *rc::gen::inRange(0, 20);
  }
  frame.interpolation = *rc::gen::element(Interpolation::trilinear, Interpolation::nearest);
  frame.background = *rc::gen::element(0.0f, 0.0f, 0.7f);
  const double empty = *number(0.0, 1.0);
  return make_grid(frame, [=](int x, int y, int z) {
    const double v = lattice_noise(x, y, z);
    return v < empty ? 0.0 : 2.0 * v;
  });
}

/// A ray that starts near the grid and goes to a point near it, or along an axis of its lattice, and the distance.
Ray any_ray(const GridFrame& frame, float& length) {
  const auto near = [&] {
    const Vec3d share(*vector_in(-0.5, 1.5));
    const Vec3d index = glm::mix(Vec3d(frame.lo), Vec3d(frame.hi), share);
    const bool on_lattice = *rc::gen::arbitrary<bool>();
    return Vec3(frame.index_to_world * glm::dvec4(on_lattice ? glm::round(index) : index, 1.0));
  };
  const Vec3 from = near(), to = near();
  length = glm::distance(from, to);
  if (length == 0.0f) return {from, Vec3(1, 0, 0)};
  return {from, glm::normalize(to - from)};
}

RC_GTEST_PROP(DensityGridProperty, DensityIntegralsAddUpOverAnySplit, ()) {
  GridFrame frame;
  const Medium medium = make_medium(any_grid(frame), Rgb(1.0f));
  float length = 0.0f;
  const Ray ray = any_ray(frame, length);
  const auto split = static_cast<float>(*number(0.0, 1.0)) * length;
  const double whole = density_integral(medium, ray, {0.0f, length}).value;
  const double parts =
      density_integral(medium, ray, {0.0f, split}).value + density_integral(medium, ray, {split, length}).value;
  RC_ASSERT(whole >= -1e-12 && std::isfinite(whole));
  RC_ASSERT(whole <= medium.max_density() * length * 1.00001 + frame.background * length);
  RC_ASSERT(std::abs(whole - parts) <= 1e-6 * medium.max_density() * length);
}

RC_GTEST_PROP(DensityGridProperty, DensityIntegralsAreTheSameFromBothEnds, ()) {
  GridFrame frame;
  const Medium medium = make_medium(any_grid(frame), Rgb(1.0f));
  float length = 0.0f;
  const Ray ray = any_ray(frame, length);
  // Voxels end abruptly in nearest fields: a ray in a plane of the lattice may lie on either side of it.
  RC_PRE(frame.interpolation == Interpolation::trilinear);
  const double there = density_integral(medium, ray, {0.0f, length}).value;
  const double back = density_integral(medium, {ray.at(length), -ray.direction}, {0.0f, length}).value;
  // The far end is rounded: a displacement by a rounding of the coordinates, times the steepest slope, 2 a voxel.
  const double rounding = 2e-7 * (glm::length(Vec3d(ray.origin)) + length);
  RC_ASSERT(std::abs(there - back) <= 1e-5 * there + rounding * (2.0 + 4.0 * length / medium.voxel_size()));
}

RC_GTEST_PROP(DensityGridProperty, PiecesAreTheDensityAlongTheRay, ()) {
  GridFrame frame;
  const auto grid = any_grid(frame);
  RC_PRE(frame.interpolation == Interpolation::trilinear);
  float length = 0.0f;
  const Ray ray = any_ray(frame, length);
  const double rounding = 1e-6 * (1.0 + (glm::length(Vec3d(ray.origin)) + length) / grid->voxel_size());
  double end = 0.0;
  grid->visit_pieces(ray, {0.0f, length}, [&](const DensityPiece& piece) {
    RC_ASSERT(piece.t0 >= end - 1e-9 && piece.t1 >= piece.t0);
    end = piece.t1;
    const double s = 0.5 * piece.length();
    RC_ASSERT(std::abs(piece.density(s) - grid->density(ray.at(static_cast<float>(piece.t0 + s)))) < 8.0 * rounding);
    return true;
  });
}

RC_GTEST_PROP(DensityGridProperty, FollowsItsTransform, ()) {
  GridFrame frame;
  const auto field = any_grid(frame);
  RC_PRE(frame.interpolation == Interpolation::trilinear);
  // The same voxels under the identity: the density at a point is that of its place in the lattice.
  GridFrame plain = frame;
  plain.index_to_world = Mat4d(1.0);
  const auto lattice = std::make_shared<const DensityGrid>(plain, [&](const Vec3i& origin, float* values) {
    for (int z = 0, n = 0; z < DensityGrid::kValues; ++z)
      for (int y = 0; y < DensityGrid::kValues; ++y)
        for (int x = 0; x < DensityGrid::kValues; ++x, ++n)
          values[n] = field->density(Vec3(frame.index_to_world * glm::dvec4(Vec3d(origin + Vec3i(x, y, z)), 1.0)));
    return DensityGrid::Filled::all;
  });
  const Vec3 index = Vec3(frame.lo) - 1.0f + *vector_in(0.0, 1.0) * Vec3(frame.hi - frame.lo + 2);
  const Vec3 world(frame.index_to_world * glm::dvec4(Vec3d(index), 1.0));
  const double voxels_off = 4e-7 * (glm::length(Vec3d(world)) + 10.0) / field->voxel_size();
  RC_ASSERT(std::abs(field->density(world) - lattice->density(index)) < 1e-5 + 8.0 * voxels_off);
}

RC_GTEST_PROP(DensityPieceProperty, InvertsItsDensityIntegral, ()) {
  // Four values at equal distances make any cubic; those that dip below zero are lifted, as densities are not negative.
  const double scale = *magnitude(1e-30, 1e30), length = *magnitude(1e-6, 1e9);
  const double a = *number(0, 1), b = *number(0, 1), c = *number(0, 1), d = *number(0, 1);
  DensityPiece piece{*number(-1e3, 1e3), 0.0, 0.0, 0.0, 0.0, 0.0};
  piece.t1 = piece.t0 + length;
  const double h = piece.length();
  piece.c0 = a * scale;
  piece.c1 = (-5.5 * a + 9 * b - 4.5 * c + d) * scale / h;
  piece.c2 = (9 * a - 22.5 * b + 18 * c - 4.5 * d) * scale / (h * h);
  piece.c3 = (-4.5 * a + 13.5 * b - 13.5 * c + 4.5 * d) * scale / (h * h * h);
  double least = 0.0;
  for (int i = 0; i <= 1000; ++i) least = std::min(least, piece.density(h * i / 1000.0));
  piece.c0 -= 1.001 * least;
  const double whole = piece.integral();
  RC_PRE(whole > 0.0);
  const double s = *number(0.0, 1.0) * h;
  const double target = std::clamp(piece.integral(s), 0.0, whole);
  const double found = piece.invert(target);
  RC_ASSERT(found >= 0.0 && found <= h);
  RC_ASSERT(std::abs(piece.integral(found) - target) <= 1e-10 * whole);
  RC_ASSERT(std::abs(found - s) * piece.density(s) <= 1e-6 * whole || piece.density(s) < 1e-2 * scale);
}

}  // namespace
}  // namespace vpm
