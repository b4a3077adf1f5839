// The surface radiance estimate [Jarosz2008, eq. 7.5, corrected], for any photon map.
#pragma once

#include "estimate/kernel_sum.h"
#include "surface/shading.h"

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

/// The sum of value(travel, power) K_r over the discs of photons that arrive at the side of a surface that `normal`
/// (unit) points to. `Photons` are a PhotonMap, or a plain list for the brute-force twin.
template <class Value, class... Photons>
Rgb surface_sum(const Vec3& point, const Vec3& normal, float radius, Value&& value, const Photons&... photons) {
  const auto arrives = [&](const Vec3& travel, const Vec3& offset) {
    return glm::dot(travel, normal) < 0.0f && lies_on_plane(offset, normal, radius);
  };
  return kernel_sum<2>(photons..., point, arrives, value);
}

/// Irradiance, W/m^2, on the side that `normal` (unit) points to: sum_p Phi_p K_r. A Lambertian surface of that
/// reflectance sends out reflectance/pi times it.
template <class... Photons>
Rgb surface_irradiance(const Vec3& point, const Vec3& normal, float radius, const Photons&... photons) {
  return surface_sum(
      point, normal, radius, [](const Vec3&, const Rgb& power) { return power; }, photons...);
}

/// The same by the cosines to the shading normal of a hit: what a Lambertian surface there reflects. `normal` is the
/// hit's geometric one, turned to the side that is asked for.
template <class... Photons>
Rgb shaded_irradiance(const Hit& hit, const Vec3& normal, float radius, const Photons&... photons) {
  const auto shaded = [&](const Vec3& travel, const Rgb& power) {
    return power * shading_irradiance_scale(hit, travel);
  };
  return surface_sum(hit.position, normal, radius, shaded, photons...);
}

/// Radiance, W/(m^2 sr), that a rough surface sends towards the eye, `towards_eye`: sum_p f(w_p, towards_eye) Phi_p K_r
/// [Jarosz2008, eq. 7.5]. Photons on the eye's side count, and those on the far side where the material scatters them
/// through. f is for flux on its way to the eye, so refraction scales nothing here.
template <class... Photons>
Rgb scattered_radiance(const Material& material, const Hit& hit, const Vec3& towards_eye, float radius,
                       const Photons&... photons) {
  const float geometric = glm::dot(hit.normal, towards_eye), shading = glm::dot(hit.shading_normal, towards_eye);
  if (!(geometric * shading > 0.0f)) return Rgb(0.0f);  // seen edge on, or from different sides of the two normals
  const Vec3 near_side = geometric > 0.0f ? hit.normal : -hit.normal;
  if (const auto* diffuse = std::get_if<Lambertian>(&material))
    return diffuse->reflectance / kPi * shaded_irradiance(hit, near_side, radius, photons...);
  const bool through = scatters_through(material);
  const auto arrives = [&](const Vec3& travel, const Vec3& offset) {
    return (through || glm::dot(travel, near_side) < 0.0f) && lies_on_plane(offset, hit.normal, radius);
  };
  const auto scattered = [&](const Vec3& travel, const Rgb& power) {
    return scatter_value(material, hit, travel, towards_eye).value * power * shading_irradiance_scale(hit, travel);
  };
  return kernel_sum<2>(photons..., hit.position, arrives, scattered) / std::abs(shading);
}

}  // namespace vpm
