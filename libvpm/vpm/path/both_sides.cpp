// Fresnel's fraction decides.
#include "vpm/path/both_sides.h"

#include <algorithm>

#include "vpm/surface/shading.h"

namespace vpm {

std::optional<BothSides> both_sides(const Material& material, const Hit& hit, const Vec3& travel, float part) {
  const std::optional<float> reflected = reflected_fraction(material, hit.shading_normal, travel);
  if (!reflected || part * std::min(*reflected, 1.0f - *reflected) < kLeastBranch) return std::nullopt;
  return BothSides{sample_scatter(material, hit, travel, 0.0f, Vec2(0.0f)),
                   sample_scatter(material, hit, travel, *reflected, Vec2(0.0f)), *reflected};
}

float asks_with(float fraction, Rng& rng) {
  constexpr float kAlways = 0.5f;
  if (fraction >= kAlways) return 1.0f;
  return rng.uniform() * kAlways < fraction ? kAlways / fraction : 0.0f;
}

}  // namespace vpm
