// The surface radiance estimate [Jarosz2008, eq. 7.5, corrected], for any photon map.
#pragma once

#include "estimate/kernel_sum.h"
#include "surface/material.h"

namespace vpm {

/// How far off the plane through the point photons may lie: a share of the radius, and a share of their distance within
/// the plane. Leaves out most photons of other surfaces, and keeps those of surfaces curved with a radius of curvature
/// above twice the gather radius.
inline constexpr float kFlatness = 0.05f;
inline constexpr float kSlope = 0.3f;

/// Does a photon at `offset` from a point lie close to the plane of that normal?
inline bool lies_on_plane(const Vec3& offset, const Vec3& normal, float radius) {
  return std::abs(glm::dot(offset, normal)) <= kFlatness * radius + kSlope * glm::length(offset);
}

/// Irradiance, W/m^2, on the side of a surface that `normal` (unit) points to: sum_p Phi_p K_r over the discs of
/// photons that arrive at that side. A Lambertian surface of that reflectance sends out reflectance/pi times it.
/// `Photons` are a PhotonMap, or a plain list for the brute-force twin.
template <class... Photons>
Rgb surface_irradiance(const Vec3& point, const Vec3& normal, float radius, const Photons&... photons) {
  const auto arrives = [&](const Vec3& travel, const Vec3& offset) {
    return glm::dot(travel, normal) < 0.0f && lies_on_plane(offset, normal, radius);
  };
  return kernel_sum<2>(photons..., point, arrives, [](const Vec3&, const Rgb& power) { return power; });
}

/// Radiance, W/(m^2 sr), that a rough surface of outward normal `normal` sends towards the eye, `towards_eye`:
/// sum_p f(w_p, towards_eye) Phi_p K_r [Jarosz2008, eq. 7.5]. Photons on the eye's side count, and those on the far
/// side where the material scatters them through. f is for flux on its way to the eye, so refraction scales nothing
/// here.
template <class... Photons>
Rgb scattered_radiance(const Material& material, const Vec3& point, const Vec3& normal, const Vec3& towards_eye,
                       float radius, const Photons&... photons) {
  const float cosine = glm::dot(normal, towards_eye);
  if (cosine == 0.0f) return Rgb(0.0f);  // seen edge on, it fills no solid angle
  const Vec3 near_side = cosine > 0.0f ? normal : -normal;
  if (const auto* diffuse = std::get_if<Lambertian>(&material))
    return diffuse->reflectance / kPi * surface_irradiance(point, near_side, radius, photons...);
  const bool through = scatters_through(material);
  const auto arrives = [&](const Vec3& travel, const Vec3& offset) {
    return (through || glm::dot(travel, near_side) < 0.0f) && lies_on_plane(offset, normal, radius);
  };
  const auto scattered = [&](const Vec3& travel, const Rgb& power) {
    return scatter_value(material, normal, travel, towards_eye).value * power;
  };
  return kernel_sum<2>(photons..., point, arrives, scattered) / std::abs(cosine);
}

}  // namespace vpm
