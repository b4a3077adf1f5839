// Warps and frames for any numbers, intervals and boxes.
#include "vpm/base/warp.h"

#include "support/properties.h"
#include "vpm/medium/grid/density_grid.h"

namespace vpm {
namespace {

bool is_unit(const Vec3& d) { return std::abs(glm::length(Vec3d(d)) - 1.0) < 5e-7; }

RC_GTEST_PROP(WarpProperty, StaysInItsRange, ()) {
  const Vec2 u = *uniform_pair();
  const Vec3 axis = *unit_vector();
  RC_ASSERT(is_unit(uniform_sphere(u)));
  RC_ASSERT(glm::length(uniform_disc(u)) <= 1.0f + 1e-6f);
  const Vec3 up = cosine_hemisphere(axis, u);
  RC_ASSERT(is_unit(up));
  RC_ASSERT(glm::dot(up, axis) > 0.0f);
  const auto away = static_cast<float>(*magnitude(1e-12, 2.0));
  const Vec3 in_cone = uniform_cone(axis, away, u);
  RC_ASSERT(is_unit(in_cone));
  const double angle = std::acos(1.0 - double(away)), apart = glm::length(Vec3d(in_cone) - Vec3d(axis));
  RC_ASSERT(2.0 * std::asin(std::min(1.0, 0.5 * apart)) <= angle + 1e-6 || away > 1.99f);
}

/// Azimuths are as exact as directions: less so near the poles.
RC_GTEST_PROP(WarpProperty, NumbersOfASphereAreFoundAgain, ()) {
  const Vec2 u = *uniform_pair();
  const Vec3 direction = uniform_sphere(u);
  const Vec2 found = uniform_sphere_numbers(direction);
  const float turns = std::abs(found.y - u.y), sine = std::hypot(direction.x, direction.y);
  RC_ASSERT(std::abs(found.x - u.x) < 1e-6f);
  RC_ASSERT(std::min(turns, 1.0f - turns) * sine < 1e-6f);
  RC_ASSERT(found.y >= 0.0f && found.y <= 1.0f);
}

RC_GTEST_PROP(WarpProperty, DirectionsAboutAnAxisHaveTheirAngle, ()) {
  const Vec3 axis = *unit_vector();
  const double away = *magnitude(1e-12, 2.0), phi = *number(0.0, 2.0 * kPiD);
  const Vec3 d = direction_about(axis, static_cast<float>(away), static_cast<float>(phi));
  RC_ASSERT(is_unit(d));
  const Vec3d apart = Vec3d(d) - Vec3d(axis);
  const double found = 0.5 * glm::dot(apart, apart);  // 1 - cos, whose square root is off by a rounding
  RC_ASSERT(std::abs(std::sqrt(found) - std::sqrt(away)) < 3e-7);
}

RC_GTEST_PROP(FrameProperty, IsOrthonormalAndRightHanded, ()) {
  const Vec3 n = *unit_vector();
  Vec3 s, t;
  make_frame(n, s, t);
  RC_ASSERT(is_unit(s) && is_unit(t));
  RC_ASSERT(std::abs(glm::dot(s, t)) < 5e-7f && std::abs(glm::dot(s, n)) < 5e-7f && std::abs(glm::dot(t, n)) < 5e-7f);
  RC_ASSERT(glm::distance(glm::cross(s, t), n) < 1e-6f);
}

RC_GTEST_PROP(ClipProperty, PointsInsideTheBoxAreKeptAndOthersCut, ()) {
  const Vec3d a(*vector_in(-3, 3)), b(*vector_in(-3, 3)), lo = glm::min(a, b), hi = glm::max(a, b);
  const Vec3d origin(*vector_in(-4, 4)), direction(*unit_vector());
  double t0 = *number(0.0, 3.0), t1 = t0 + *number(0.0, 9.0);
  const double from = t0, to = t1, t = *number(from, to);
  clip_to_box(origin, direction, lo, hi, t0, t1);
  RC_ASSERT(t0 >= t1 || (t0 >= from && t1 <= to));
  const Vec3d p = origin + t * direction;
  constexpr double kHair = 1e-9;
  const bool well_inside = glm::all(glm::greaterThan(p, lo + kHair)) && glm::all(glm::lessThan(p, hi - kHair));
  const bool well_outside = glm::any(glm::lessThan(p, lo - kHair)) || glm::any(glm::greaterThan(p, hi + kHair));
  RC_ASSERT(!well_inside || (t0 <= t && t <= t1));
  RC_ASSERT(!well_outside || !(t0 < t1 && t0 <= t && t <= t1));
}

RC_GTEST_PROP(BoxProperty, HoldsWhatWasAdded, ()) {
  Box box;
  RC_ASSERT(box.empty() && box.diagonal() == 0.0f);
  std::vector<Vec3> points;
  const int count = *rc::gen::inRange(1, 20);
  for (int i = 0; i < count; ++i) box.add(points.emplace_back(*vector_in(-1e6, 1e6)));
  RC_ASSERT(!box.empty());
  for (const Vec3& p : points) RC_ASSERT(box.contains(p));
  Box larger = box;
  larger.add(Vec3(2e6f));
  box.add(larger);
  RC_ASSERT(box.hi == Vec3(2e6f) && box.contains(points[0]));
}

}  // namespace
}  // namespace vpm
