// Random values for property tests. Each is drawn from a lattice that holds the awkward ones: ends of ranges, zeros,
// axes.
#pragma once

#include <gtest/gtest.h>

#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "vpm/base/vec.h"

namespace glm {

/// How failing properties print vectors.
inline void showValue(const vec3& v, std::ostream& out) { out << "(" << v.x << ", " << v.y << ", " << v.z << ")"; }
inline void showValue(const vec2& v, std::ostream& out) { out << "(" << v.x << ", " << v.y << ")"; }

}  // namespace glm

namespace vpm {

/// A number in [lo, hi], both included.
inline rc::Gen<double> number(double lo, double hi) {
  constexpr int64_t kSteps = 1 << 20;
  return rc::gen::map(rc::gen::inRange<int64_t>(0, kSteps + 1),
                      [=](int64_t i) { return i == kSteps ? hi : lo + (hi - lo) * static_cast<double>(i) / kSteps; });
}

/// A number whose logarithm is even over [lo, hi], 0 < lo.
inline rc::Gen<double> magnitude(double lo, double hi) {
  return rc::gen::map(number(std::log(lo), std::log(hi)), [](double x) { return std::exp(x); });
}

/// A pair as Rng::uniform2() gives it: multiples of 2^-24 in [0, 1), the ends more often than by chance.
inline rc::Gen<Vec2> uniform_pair() {
  const auto one = rc::gen::map(
      rc::gen::oneOf(rc::gen::inRange(0, 1 << 24), rc::gen::element(0, 1, (1 << 23) - 1, 1 << 23, (1 << 24) - 1)),
      [](int i) { return static_cast<float>(i) * 0x1p-24f; });
  return rc::gen::map(rc::gen::pair(one, one),
                      [](const std::pair<float, float>& p) { return Vec2(p.first, p.second); });
}

/// A vector with components in [lo, hi].
inline rc::Gen<Vec3> vector_in(double lo, double hi) {
  return rc::gen::map(rc::gen::tuple(number(lo, hi), number(lo, hi), number(lo, hi)),
                      [](const auto& t) { return Vec3(Vec3d(std::get<0>(t), std::get<1>(t), std::get<2>(t))); });
}

/// A unit vector: any, or one with components of 0 or next to it.
inline rc::Gen<Vec3> unit_vector() {
  const auto component = rc::gen::oneOf(number(-1.0, 1.0), rc::gen::element(0.0, -0.0, 1.0, -1.0, 1e-30, -1e-7));
  const auto any = rc::gen::map(rc::gen::tuple(component, component, component),
                                [](const auto& t) { return Vec3d(std::get<0>(t), std::get<1>(t), std::get<2>(t)); });
  return rc::gen::map(rc::gen::suchThat(any, [](const Vec3d& d) { return glm::length(d) > 1e-3; }),
                      [](const Vec3d& d) { return Vec3(glm::normalize(d)); });
}

}  // namespace vpm
