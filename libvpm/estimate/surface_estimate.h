// The surface radiance estimate [Jarosz2008, eq. 7.5, corrected], for any photon map.
#pragma once

#include "estimate/kernel_sum.h"

namespace vpm {

/// How far photons may lie off the plane through the point, over the radius: photons of other surfaces are left out.
inline constexpr float kFlatness = 0.1f;

/// Irradiance, W/m^2, on the side of a surface that `normal` (unit) points to: sum_p Phi_p K_r over the discs of photons that
/// arrive at that side. A Lambertian surface of that reflectance sends out reflectance/pi times it. `Photons` are a PhotonMap, or a plain list for the brute-force twin.
template <class... Photons>
Rgb surface_irradiance(const Vec3& point, const Vec3& normal, float radius, const Photons&... photons) {
  const auto arrives = [&](const Vec3& travel, const Vec3& offset) {
    return glm::dot(travel, normal) < 0.0f && std::abs(glm::dot(offset, normal)) <= kFlatness * radius;
  };
  return kernel_sum<2>(photons..., point, arrives, [](const Vec3&, const Rgb& power) { return power; });
}

}  // namespace vpm
