// Planes around rays, through the point that they have in common.
#include "vpm/photon/map/ray_bundle.h"

#include <algorithm>

namespace vpm {
namespace {

/// The directions seen on a plane across their mean, at the distance 1.
struct Seen {
  Vec3 right, up, ahead;
  Vec2 lo{kInfinity}, hi{-kInfinity};
  float least_ahead = 1.0f;  // of all cosines with the mean
};

Seen see(std::span<const Vec3> directions) {
  Vec3 sum(0.0f);
  for (const Vec3& direction : directions) sum += direction;
  Seen seen;
  seen.ahead = glm::length(sum) > 0.0f ? glm::normalize(sum) : directions.front();
  make_frame(seen.ahead, seen.right, seen.up);
  for (const Vec3& direction : directions) {
    const float ahead = glm::dot(direction, seen.ahead);
    const Vec2 place(glm::dot(direction, seen.right) / ahead, glm::dot(direction, seen.up) / ahead);
    seen.least_ahead = std::min(seen.least_ahead, ahead);
    seen.lo = glm::min(seen.lo, place);
    seen.hi = glm::max(seen.hi, place);
  }
  return seen;
}

}  // namespace

RayBundle::RayBundle(const Vec3& apex, std::span<const Vec3> directions, float farthest) : apex_(apex) {
  constexpr float kSlack = 1e-6f;  // of the distance: rounding
  const Seen seen = see(directions);
  const auto add = [&](const Vec3& across, float least) {
    region_.add(glm::normalize(across - (least - kSlack) * seen.ahead), 0.0f);
  };
  add(seen.right, seen.lo.x);
  add(-seen.right, -seen.hi.x);
  add(seen.up, seen.lo.y);
  add(-seen.up, -seen.hi.y);
  region_.add(seen.ahead, 0.0f);
  region_.add(-seen.ahead, -farthest);
}

float spread_of(std::span<const Vec3> directions) {
  constexpr float kLeast = 0.7f;  // of the cosines with the mean
  const Seen seen = see(directions);
  return seen.least_ahead < kLeast ? kInfinity : glm::distance(seen.lo, seen.hi);
}

bool is_narrow(std::span<const Vec3> directions, const Interval& reach, float free_path, float width) {
  const float middle = std::min(0.5f * (reach.t0 + reach.t1), reach.t0 + free_path);
  return middle * spread_of(directions) <= width;
}

}  // namespace vpm
