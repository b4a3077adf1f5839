// The surface radiance estimate [Jarosz2008, eq. 7.5, corrected], for any photon map.
#pragma once

#include "vpm/estimate/kernel_sum.h"
#include "vpm/surface/shading.h"

namespace vpm {

/// How far from the plane through the point photons may lie: kSlope times their distance from the point, plus kFlatness
/// times the radius where the radius is fixed. This leaves out most photons of other surfaces. It keeps the photons of
/// surfaces whose radius of curvature is above twice the gather radius.
inline constexpr float kSlope = 0.3f;
inline constexpr float kFlatness = 0.05f;

/// The part that depends on the radius, m. It is 0 for the nearest photons: the largest radius they are looked for in
/// says nothing about the radius they will be found in.
inline float plane_thickness(const GatherSettings& gather) {
  return gather.mode == GatherMode::radius ? kFlatness * gather.radius : 0.0f;
}

/// The photons that count on a surface: those near its plane that arrive on the side that `normal` (unit) points to or,
/// with `from_both_sides`, on either side.
struct Arrives {
  Vec3 normal{0.0f};
  float thickness = 0.0f;  // m, plane_thickness()
  bool from_both_sides = false;

  bool near_plane(const Vec3& offset) const {
    return std::abs(glm::dot(offset, normal)) <= thickness + kSlope * glm::length(offset);
  }
  bool operator()(const PackedDirection& travel, const Vec3& offset) const {
    const bool arrives = from_both_sides | (glm::dot(travel.on_octahedron(), normal) < 0.0f);
    return near_plane(offset) & arrives;
  }
  /// Of which nodes are all photons taken, and of which may any be? Places are rounded as the photons' own are. Along
  /// `normal` a direction reaches as far as along the node's own normal or its opposite, but for the distance between
  /// the two normals: directions are no longer than 1.
  void judge(const NodeGroup& nodes, const Vec3& point, GroupView& view) const;
};

inline void Arrives::judge(const NodeGroup& nodes, const Vec3& point, GroupView& view) const {
  constexpr float kRounding = 1e-6f;  // of products of directions
  const Vec3 n = normal, p = point;
  const auto &x_low = (n.x > 0.0f ? nodes.lo : nodes.hi)[0], &x_high = (n.x > 0.0f ? nodes.hi : nodes.lo)[0];
  const auto &y_low = (n.y > 0.0f ? nodes.lo : nodes.hi)[1], &y_high = (n.y > 0.0f ? nodes.hi : nodes.lo)[1];
  const auto &z_low = (n.z > 0.0f ? nodes.lo : nodes.hi)[2], &z_high = (n.z > 0.0f ? nodes.hi : nodes.lo)[2];
  const float always = from_both_sides ? kInfinity : 0.0f, flat = thickness;
  for (uint32_t i = 0; i < kBlock; ++i) {
    const float low = (x_low[i] - p.x) * n.x + (y_low[i] - p.y) * n.y + (z_low[i] - p.z) * n.z;
    const float high = (x_high[i] - p.x) * n.x + (y_high[i] - p.y) * n.y + (z_high[i] - p.z) * n.z;
    const bool all_near = std::max(-low, high) <= flat + kSlope * std::sqrt(view.nearest2[i]);
    const bool any_near = std::max(low, -high) <= flat + kSlope * std::sqrt(view.farthest2[i]);
    const float x = nodes.normal[0][i], y = nodes.normal[1][i], z = nodes.normal[2][i];
    const float sign = std::copysign(1.0f, x * n.x + y * n.y + z * n.z);
    const float dx = n.x - sign * x, dy = n.y - sign * y, dz = n.z - sign * z;
    const float off = std::sqrt(dx * dx + dy * dy + dz * dz) + kRounding;
    const float most = (sign > 0.0f ? nodes.most[i] : -nodes.least[i]) + off;
    const float least = (sign > 0.0f ? nodes.least[i] : -nodes.most[i]) - off;
    view.all[i] = (all_near & (most < always)) ? 1 : 0;
    view.any[i] = (any_near & (least < always)) ? 1 : 0;
  }
}

/// The sum of value(travel, power) K_r, K_r over discs, of the photons that arrive on the side of a surface that
/// `normal` (unit) points to. `Photons` are a map or a view of one, or a plain list for the brute-force twin.
template <class Value, class... Photons>
KernelEstimate surface_sum(const Vec3& point, const Vec3& normal, Value&& value, const Photons&... photons) {
  return kernel_sum<2>(photons..., point, Arrives{normal, plane_thickness(settings_of(photons...))}, value);
}

/// Irradiance, W/m^2, on the side that `normal` (unit) points to: sum_p Phi_p K_r. A Lambertian surface of that
/// reflectance sends out reflectance/pi times it.
template <class... Photons>
KernelEstimate surface_irradiance(const Vec3& point, const Vec3& normal, const Photons&... photons) {
  return surface_sum(point, normal, PowerAlone(), photons...);
}

/// The same with the cosines to the shading normal of a hit: what a Lambertian surface there reflects. `normal` is the
/// geometric normal of the hit, on the side that is asked for.
template <class... Photons>
KernelEstimate shaded_irradiance(const Hit& hit, const Vec3& normal, const Photons&... photons) {
  if (single_normal(hit)) return surface_irradiance(hit.position, normal, photons...);
  const auto shaded = [&](const Vec3& travel, const Rgb& power) {
    return power * shading_irradiance_scale(hit, travel);
  };
  return surface_sum(hit.position, normal, shaded, photons...);
}

/// The radiance, W/(m^2 sr), that a non-specular surface sends in the direction `towards_eye`: sum_p
/// f(w_p, towards_eye) Phi_p K_r [Jarosz2008, eq. 7.5]. Photons that arrive on the eye's side count. So do those on the
/// far side, where the material scatters light through. f is for flux on its way to the eye, so refraction scales
/// nothing here.
template <class... Photons>
KernelEstimate scattered_radiance(const Material& material, const Hit& hit, const Vec3& towards_eye,
                                  const Photons&... photons) {
  const float geometric = glm::dot(hit.normal, towards_eye), shading = glm::dot(hit.shading_normal, towards_eye);
  if (!(geometric * shading > 0.0f)) return {};  // seen edge on, or from different sides of the two normals
  const Vec3 eye_side = geometric > 0.0f ? hit.normal : -hit.normal;
  if (const Rgb* diffuse = diffuse_reflectance(material))
    return *diffuse / kPi * shaded_irradiance(hit, eye_side, photons...);
  const Arrives arrives{eye_side, plane_thickness(settings_of(photons...)), scatters_through(material)};
  const auto scattered = [&](const Vec3& travel, const Rgb& power) {
    return scatter_value(material, hit, travel, towards_eye).value * power * shading_irradiance_scale(hit, travel);
  };
  return kernel_sum<2>(photons..., hit.position, arrives, scattered) * Rgb(1.0f / std::abs(shading));
}

// Each takes seconds to compile: there is one copy, in surface_map.cpp.
extern template KernelEstimate surface_irradiance(const Vec3&, const Vec3&, const PhotonMap&);
extern template KernelEstimate surface_irradiance(const Vec3&, const Vec3&, const CountedMap&);
extern template KernelEstimate shaded_irradiance(const Hit&, const Vec3&, const CountedMap&);
extern template KernelEstimate scattered_radiance(const Material&, const Hit&, const Vec3&, const PhotonMap&);
extern template KernelEstimate scattered_radiance(const Material&, const Hit&, const Vec3&, const CountedMap&);

/// The radius of the disc, m, that scattered_radiance() gathers over.
inline float scattered_radius(const Material& material, const Hit& hit, const Vec3& towards_eye,
                              const CountedMap& map) {
  const Vec3 eye_side = glm::dot(hit.normal, towards_eye) > 0.0f ? hit.normal : -hit.normal;
  return kernel_radius(map, hit.position, Arrives{eye_side, plane_thickness(map.settings), scatters_through(material)});
}

}  // namespace vpm
