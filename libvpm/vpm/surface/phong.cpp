// Phong's material, made to conserve energy: a diffuse and a glossy lobe, one of which each path is sent into by
// chance.
#include "vpm/base/warp.h"
#include "vpm/surface/kinds.h"

namespace vpm {

namespace {

/// The probability of the glossy lobe.
float glossy_choice(const Phong& m) {
  const float diffuse = max_channel(m.diffuse), glossy = max_channel(m.glossy);
  return glossy > 0.0f ? glossy / (diffuse + glossy) : 0.0f;
}

}  // namespace

/// Russian roulette between the lobes [Lafortune1994; Jensen2001, ch. 5]. The density is that of both lobes
/// together, so the weight does not tell which one was chosen.
Scatter sample(const Phong& m, const Vec3& normal, const Vec3& travel, float u_choice, const Vec2& u) {
  const Incidence in(normal, travel);
  Vec3 direction;
  if (u_choice < glossy_choice(m)) {
    // The cosine to the axis is u^(1 / (exponent + 1)).
    const auto away = static_cast<float>(-std::expm1(std::log1p(-double{u.x}) / (m.exponent + 1.0)));
    direction = direction_about(mirrored(in, travel), away, 2.0f * kPi * u.y);
  } else {
    direction = cosine_hemisphere(in.normal, u);
  }
  if (!(glm::dot(in.normal, direction) > 0.0f)) return absorbed(in);
  direction = on_side(direction, in.normal);
  return scattered(direction, value(m, normal, travel, direction), false);
}

/// diffuse/pi + glossy (n + 2)/(2 pi) cos^n [Lafortune1994]; the densities of the lobes are cos/pi and
/// (n + 1)/(2 pi) cos^n.
ScatterValue value(const Phong& m, const Vec3& normal, const Vec3& travel, const Vec3& direction) {
  const Incidence in(normal, travel);
  const float cosine = glm::dot(in.normal, direction);
  if (!(cosine > 0.0f)) return {};
  const Vec3 apart = direction - mirrored(in, travel);
  const float away = 0.5f * glm::dot(apart, apart);  // 1 - cosine to the axis, exact in narrow lobes
  const double power = away < 1.0f ? std::exp(m.exponent * std::log1p(-double{away})) : 0.0;
  const auto lobe = static_cast<float>(power / (2.0 * kPiD));
  const float glossy = glossy_choice(m);
  return {(m.diffuse / kPi + m.glossy * ((m.exponent + 2.0f) * lobe)) * cosine,
          (1.0f - glossy) * cosine / kPi + glossy * (m.exponent + 1.0f) * lobe};
}

}  // namespace vpm
