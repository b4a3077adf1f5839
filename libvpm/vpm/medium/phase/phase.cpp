// Sampling of the phase functions.
#include "vpm/medium/phase/phase.h"

#include "vpm/base/warp.h"

namespace vpm {

Vec3 Isotropic::sample(const Vec3&, const Vec2& u) const { return uniform_sphere(u); }

Vec3 HenyeyGreenstein::sample(const Vec3& travel, const Vec2& u) const {
  // Inversion of the cumulative distribution [Henyey1941]. With a = |g| and s = 1 - a + 2 a u, in a form that does not
  // cancel for a near 1 and needs no special case at a = 0: 1 - cos = 2 (1 - u) (1 + a u) ((1 - a) / s)^2.
  const float a = std::abs(g);
  const float ratio = (1.0f - a) / (1.0f - a + 2.0f * a * u.x);
  const float away = 2.0f * (1.0f - u.x) * (1.0f + a * u.x) * ratio * ratio;
  return direction_about(g < 0.0f ? -travel : travel, away, 2.0f * kPi * u.y);
}

Vec3 Rayleigh::sample(const Vec3& travel, const Vec2& u) const {
  // The cumulative distribution is a cubic, cos^3 + 3 cos + 4 - 8 u = 0, with one real root by Cardano's formula.
  const double q = 4.0 * u.x - 2.0;
  const double c = std::cbrt(q + std::sqrt(q * q + 1.0));
  return direction_about(travel, static_cast<float>(1.0 - c + 1.0 / c), 2.0f * kPi * u.y);
}

}  // namespace vpm
