// Splitting in the coordinate plane that shows most of the polygon, where its corners stay what they are.
#include "vpm/input/mesh/split_polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "vpm/base/cancel.h"

namespace vpm {
namespace {

using Vec2d = glm::dvec2;

/// Across the polygon's plane: twice its area vector, or, where parts of it cancel, that of a part.
Vec3d across(std::span<const Vec3> corners) {
  const Vec3d first(corners[0]);
  Vec3d sum(0.0), part(0.0);
  for (size_t i = 2; i < corners.size(); ++i) {
    const Vec3d triangle = glm::cross(Vec3d(corners[i - 1]) - first, Vec3d(corners[i]) - first);
    if (triangle != Vec3d(0.0)) part = triangle;
    sum += triangle;
  }
  return sum != Vec3d(0.0) ? sum : part;
}

bool is_flat(std::span<const Vec3> corners, const Vec3d& normal) {
  constexpr double kTolerance = 0.01;
  const Vec3d first(corners[0]);
  double extent2 = 0.0, least = 0.0, most = 0.0;
  for (const Vec3& corner : corners) {
    const Vec3d from = Vec3d(corner) - first;
    extent2 = std::max(extent2, glm::dot(from, from));
    least = std::min(least, glm::dot(from, normal));
    most = std::max(most, glm::dot(from, normal));
  }
  return most - least <= kTolerance * std::sqrt(extent2);
}

/// The corners in a coordinate plane, seen so that the polygon turns to the left.
std::vector<Vec2d> in_plane(std::span<const Vec3> corners, const Vec3d& normal) {
  const Vec3d size = glm::abs(normal);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const double side = normal[axis] < 0.0 ? -1.0 : 1.0;
  std::vector<Vec2d> places;
  for (const Vec3& corner : corners) places.emplace_back(side * corner[(axis + 1) % 3], corner[(axis + 2) % 3]);
  return places;
}

/// Twice the area of a triangle, negative where it turns to the right.
double turn(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
}

/// Do all triangles of the fan turn to the left, but for what rounding turns?
bool is_fan(const std::vector<Vec2d>& places) {
  constexpr double kRounding = 1e-6, kOfFloats = 0x1p-23;  // the sine of an angle; of coordinates, relative
  double largest = 0.0;
  for (const Vec2d& p : places) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  for (size_t i = 2; i < places.size(); ++i) {
    const double before = glm::distance(places[0], places[i - 1]), edge = glm::distance(places[0], places[i]);
    const double rounding = kRounding * before * edge + kOfFloats * largest * (before + edge);
    if (turn(places[0], places[i - 1], places[i]) < -rounding) return false;
  }
  return true;
}

/// What a triangle's turn() may be off by because its corners are rounded to floats, of which the largest is given.
double slack(const Vec2d& a, const Vec2d& b, const Vec2d& c, double largest) {
  constexpr double kOfFloats = 0x1p-22;
  return kOfFloats * largest * (glm::distance(a, b) + glm::distance(b, c) + glm::distance(c, a));
}

/// Do two edges cross, by more than rounding makes them?
bool crosses_itself(const std::vector<Vec2d>& places) {
  double largest = 0.0;
  for (const Vec2d& p : places) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  const auto apart = [&](const Vec2d& a, const Vec2d& b, const Vec2d& p, const Vec2d& q) {
    const double one = turn(a, b, p), other = turn(a, b, q);
    return one * other < 0.0 && std::abs(one) > slack(a, b, p, largest) && std::abs(other) > slack(a, b, q, largest);
  };
  const size_t count = places.size();
  for (size_t i = 0; i + 2 < count; ++i) {
    cancellation_point();
    const Vec2d &a = places[i], &b = places[i + 1];
    for (size_t j = i + 2; j < count; ++j) {
      const Vec2d &c = places[j], &d = places[(j + 1) % count];
      if (apart(a, b, c, d) && apart(c, d, a, b)) return true;
    }
  }
  return false;
}

/// Cuts off one ear after the other [Meisters1975]. What a corner is found not to be it is taken not to be until one of
/// its neighbours goes.
class EarClipper {
 public:
  EarClipper(const std::vector<Vec2d>& places, PolygonSplit& split)
      : places_(places), split_(split), next_(places.size()), previous_(places.size()) {
    const auto count = static_cast<uint32_t>(places.size());
    for (uint32_t i = 0; i < count; ++i) {
      next_[i] = (i + 1) % count;
      previous_[next_[i]] = i;
      largest_ = std::max({largest_, std::abs(places[i].x), std::abs(places[i].y)});
    }
    for (std::vector<char>& kind : is_not_) kind.resize(count);
  }

  void clip_all() {
    uint32_t at = 0;
    for (size_t left = places_.size(); left > 3; --left) {
      cancellation_point();
      if (!find_next(at, left)) {
        split_.crosses_itself = true;
        return;
      }
      split_.triangles.push_back({previous_[at], at, next_[at]});
      next_[previous_[at]] = next_[at];
      previous_[next_[at]] = previous_[at];
      for (std::vector<char>& kind : is_not_) kind[previous_[at]] = kind[next_[at]] = 0;
      at = next_[next_[at]];  // neighbours of ears become slivers if they go next
    }
    split_.triangles.push_back({previous_[at], at, next_[at]});
    split_.crosses_itself = turn_at(at) < -slack_at(at);
  }

 private:
  enum Kind { spur, ear, straight, touched_ear, kKinds };

  /// Goes on to the corner to be cut off next; false where there is none. Spurs go first, as they hide ears. Polygons
  /// that touch themselves may have no ears but such that others touch, or that are straight but for rounding.
  bool find_next(uint32_t& at, size_t left) {
    return find(at, left, spur) || find(at, left, ear) || find(at, left, straight) || find(at, left, touched_ear);
  }

  /// Goes on to a corner of that kind; false after a whole round.
  bool find(uint32_t& at, size_t left, Kind kind) {
    for (size_t i = 0; i < left; ++i, at = next_[at]) {
      if (is_not_[kind][at]) continue;
      if (is(at, kind)) return true;
      is_not_[kind][at] = 1;
    }
    return false;
  }

  bool is(uint32_t i, Kind kind) const {
    if (kind == spur) return is_spur(i);
    if (kind == straight) return std::abs(turn_at(i)) <= slack_at(i);
    return is_ear(i, kind == ear);
  }

  double turn_at(uint32_t i) const { return turn(places_[previous_[i]], places_[i], places_[next_[i]]); }
  double slack_at(uint32_t i) const { return slack(places_[previous_[i]], places_[i], places_[next_[i]], largest_); }

  /// Does the polygon turn back here, or stand still?
  bool is_spur(uint32_t i) const {
    const Vec2d &a = places_[previous_[i]], &b = places_[i], &c = places_[next_[i]];
    return turn(a, b, c) == 0.0 && glm::dot(a - b, c - b) >= 0.0;
  }

  /// Does the polygon turn to the left here, and lies no other corner in the triangle? Nor on its edges, where they
  /// count: one there may be the inner corner of a notch, through which the cut would go. Those at the triangle's own
  /// corners stay out.
  bool is_ear(uint32_t i, bool edges_count) const {
    if (!(turn_at(i) > 0.0)) return false;
    const Vec2d &a = places_[previous_[i]], &b = places_[i], &c = places_[next_[i]];
    const double depth = edges_count ? 0.0 : slack(a, b, c, largest_);
    for (uint32_t j = next_[next_[i]]; j != previous_[i]; j = next_[j]) {
      const Vec2d& p = places_[j];
      if (p == a || p == b || p == c) continue;
      const double nearest = std::min({turn(a, b, p), turn(b, c, p), turn(c, a, p)});
      if (edges_count ? nearest >= 0.0 : nearest > depth) return false;
    }
    return true;
  }

  const std::vector<Vec2d>& places_;
  PolygonSplit& split_;
  std::vector<uint32_t> next_, previous_;         // of the corners that are left
  std::array<std::vector<char>, kKinds> is_not_;  // what each corner was found not to be
  double largest_ = 0.0;                          // coordinate
};

}  // namespace

void split_polygon(std::span<const Vec3> corners, PolygonSplit& split) {
  split.triangles.clear();
  split.flat = true;
  split.crosses_itself = false;
  const auto fan = [&] {
    for (uint32_t i = 2; i < corners.size(); ++i) split.triangles.push_back({0, i - 1, i});
  };
  if (corners.size() == 3) return fan();
  const Vec3d normal = across(corners);
  if (normal == Vec3d(0.0)) return fan();
  split.flat = is_flat(corners, glm::normalize(normal));
  const std::vector<Vec2d> places = in_plane(corners, normal);
  if (is_fan(places)) return fan();
  split.crosses_itself = crosses_itself(places);
  if (!split.crosses_itself) EarClipper(places, split).clip_all();
}

}  // namespace vpm
