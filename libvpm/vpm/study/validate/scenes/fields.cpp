// The fields and their quadratures.
#include "vpm/study/validate/scenes/fields.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "vpm/base/rng.h"
#include "vpm/medium/grid/make_grid.h"
#include "vpm/surface/mesh.h"

namespace vpm {

namespace {

constexpr int kReach = 7;  // largest index of a voxel with a value

Mat4d frame_transform() {
  const Mat4d turned =
      glm::rotate(glm::translate(Mat4d(1.0), Vec3d(0.4, -0.3, 0.2)), 0.7, glm::normalize(Vec3d(1.0, 2.0, -0.5)));
  return glm::scale(turned, Vec3d(0.125, 0.11, 0.14));
}

double random_value(int x, int y, int z) {
  const auto index = static_cast<uint64_t>((x + 50) + 100 * ((y + 50) + 100 * (z + 50)));
  return Rng(11, rng_stream(RngUse::test, 0), index).uniform_double();
}

/// Distances along the ray, inside (t0, t1), at which it passes from voxel to voxel.
std::vector<double> crossings(const DensityGrid& grid, const Ray& ray, double t0, double t1) {
  const Mat4d to_index = glm::inverse(grid.frame().index_to_world);
  const double shift = grid.frame().interpolation == Interpolation::nearest ? 0.5 : 0.0;
  const Vec3d origin = Vec3d(to_index * glm::dvec4(Vec3d(ray.origin), 1.0)) + shift;
  const Vec3d direction(to_index * glm::dvec4(Vec3d(ray.direction), 0.0));
  std::vector<double> found{t0, t1};
  for (int axis = 0; axis < 3; ++axis) {
    const double a = origin[axis] + t0 * direction[axis], b = origin[axis] + t1 * direction[axis];
    for (double plane = std::ceil(std::min(a, b)); plane <= std::max(a, b); ++plane)
      found.push_back(std::clamp((plane - origin[axis]) / direction[axis], t0, t1));
  }
  std::sort(found.begin(), found.end());
  return found;
}

double density_at(const Medium& medium, const Ray& ray, double t) {
  return medium.density(Vec3(Vec3d(ray.origin) + t * Vec3d(ray.direction)));
}

}  // namespace

std::vector<TestField> test_fields() {
  GridFrame smooth;
  smooth.index_to_world = frame_transform();
  smooth.lo = Vec3i(-kReach);
  smooth.hi = Vec3i(kReach);
  GridFrame boxes = smooth;
  boxes.interpolation = Interpolation::nearest;
  return {{"constant grid", make_grid(smooth, [](int, int, int) { return 0.8; })},
          {"ramp grid", make_grid(smooth, [](int x, int, int) { return 0.1 * (x + 8); })},
          {"checker grid", make_grid(boxes, [](int x, int y, int z) { return (x + y + z) & 1 ? 1.5 : 0.3; })},
          {"sparse grid", make_grid(smooth, [](int x, int, int) { return x == -4 || x == 5 ? 2.0 : 0.0; })},
          {"Gaussian grid",
           make_grid(smooth, [](int x, int y, int z) { return 1.2 * std::exp(-0.05 * (x * x + y * y + z * z)); })},
          {"random grid", make_grid(smooth, random_value)}};
}

TestField fine_field() {
  GridFrame frame;
  frame.index_to_world = glm::scale(frame_transform(), Vec3d(0.25));
  frame.lo = Vec3i(-4 * kReach);
  frame.hi = Vec3i(4 * kReach);
  return {"fine grid", make_grid(frame, [](int x, int y, int z) { return 0.5 + random_value(x, y, z); })};
}

Vec3 field_point(const Vec3d& index) { return Vec3(frame_transform() * glm::dvec4(index, 1.0)); }

TriangleMesh field_box() {
  TriangleMesh mesh = box_mesh(Vec3d(-kReach), Vec3d(kReach));
  for (Vec3& p : mesh.positions) p = field_point(Vec3d(p));
  return mesh;
}

double mean_density_in_box(const Medium& medium) {
  // Voxels on the box's faces have half of themselves inside, under either interpolation.
  double sum = 0.0, weights = 0.0;
  const auto share = [](int i) { return std::abs(i) == kReach ? 0.5 : 1.0; };
  for (int x = -kReach; x <= kReach; ++x)
    for (int y = -kReach; y <= kReach; ++y)
      for (int z = -kReach; z <= kReach; ++z) {
        const double weight = share(x) * share(y) * share(z);
        sum += weight * medium.density(field_point({x, y, z}));
        weights += weight;
      }
  return sum / weights;
}

double field_box_volume() {
  const Mat3d axes(2.0 * kReach * Mat3d(frame_transform()));
  return std::fabs(glm::determinant(axes));
}

double field_box_area() {
  const Mat3d axes(2.0 * kReach * Mat3d(frame_transform()));
  return 2.0 * (glm::length(glm::cross(axes[0], axes[1])) + glm::length(glm::cross(axes[1], axes[2])) +
                glm::length(glm::cross(axes[2], axes[0])));
}

Ray test_ray() {
  const Vec3 from = field_point({-10.4, 0.3, -0.5}), to = field_point({10.4, 1.1, 2.7});
  return {from, glm::normalize(to - from)};
}

Interval test_stretch() { return {0.45f, 2.15f}; }

double looked_up_integral(const Medium& medium, const Ray& ray, double t0, double t1) {
  if (medium.homogeneous()) return t1 - t0;
  // Gauss-Legendre with three nodes [Olver2010, sec. 3.5(v)]: exact up to the fifth power.
  const double node = std::sqrt(0.6);
  const std::vector<double> edges = crossings(*medium.grid, ray, t0, t1);
  double sum = 0.0;
  for (size_t i = 0; i + 1 < edges.size(); ++i) {
    const double middle = 0.5 * (edges[i] + edges[i + 1]), half = 0.5 * (edges[i + 1] - edges[i]);
    if (half == 0.0) continue;
    sum += half / 9.0 *
           (5.0 * density_at(medium, ray, middle - half * node) + 8.0 * density_at(medium, ray, middle) +
            5.0 * density_at(medium, ray, middle + half * node));
  }
  return sum;
}

double marched_integral(const Medium& medium, double t, double step) {
  const Ray ray = test_ray();
  const Interval stretch = test_stretch();
  double sum = 0.0;
  for (double from = stretch.t0; from < t; from += step) {
    const double whole = std::min(step, stretch.t1 - from);  // the last step is a short one
    sum += std::min(whole, t - from) * density_at(medium, ray, from + 0.5 * whole);
  }
  return sum;
}

}  // namespace vpm
