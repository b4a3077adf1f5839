// Materials, a closed set: how a surface scatters light. Directions are directions of travel, before and after.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <variant>

#include "vpm/base/vec.h"

namespace vpm {

class FacetLoss;

/// Ideal diffuse reflection on both sides, with the BRDF reflectance/pi.
struct Lambertian {
  Rgb reflectance{0.5f};  // in [0, 1]
};
/// Diffuse and glossy reflection on both sides. The glossy lobe is a power of the cosine to the mirror direction. The
/// part of it that points into the surface is lost [Lafortune1994].
struct Phong {
  Rgb diffuse{0.5f};       // reflectance, in [0, 1]
  Rgb glossy{0.3f};        // largest reflectance of the lobe, at normal incidence; with `diffuse` at most 1
  float exponent = 50.0f;  // >= 0
};
/// Ideal mirror on both sides.
struct Mirror {
  Rgb reflectance{1.0f};  // in [0, 1]
};
/// Smooth metal that reflects by Fresnel's equations on both sides. Its index of refraction eta + i k is relative to
/// the index on the side of the path.
struct Conductor {
  Rgb eta{1.0f}, k{1.0f};  // > 0
};
/// Metal of conducting microfacets with the distribution of Trowbridge and Reitz (GGX). The main lobe reflects light
/// once. Light that would meet a second facet is lost, unless `loss` is given, which returns it
/// (surface/material/facet_loss.h).
struct RoughConductor {
  Rgb eta{1.0f}, k{1.0f};  // as in Conductor
  float roughness = 0.1f;  // alpha of the distribution, in [kLeastRoughness, 1]
  const FacetLoss* loss = nullptr;
};
/// Smooth dielectric: reflects and refracts by Fresnel's equations.
struct Dielectric {
  float ior = 1.5f;  // index behind the surface (against its normal: inside) over the index before it, > 0
};
/// A pane of smooth dielectric, too thin to shift light that passes. By Fresnel's equations it reflects the sum of all
/// reflections between its two faces, and lets the rest straight through.
struct ThinDielectric {
  float ior = 1.5f;  // index of the pane over that around it, > 0
};
/// Dielectric of microfacets, distributed as in RoughConductor, that reflect and refract [Walter2007].
struct RoughDielectric {
  float ior = 1.5f;        // as in Dielectric, at least kLeastIorStep away from 1
  float roughness = 0.1f;  // as in RoughConductor
  const FacetLoss* loss = nullptr;
};
/// A boundary between media that light passes unchanged. Crossing it is no scattering event.
struct Boundary {};

/// Lobes narrower than these would be close to the accuracy of directions in single precision and in photon maps.
inline constexpr float kLeastRoughness = 1e-3f;
inline constexpr float kLeastIorStep = 1e-2f;
inline constexpr float kLargestExponent = 1e6f;

using Material = std::variant<Lambertian, Phong, Mirror, Conductor, RoughConductor, Dielectric, ThinDielectric,
                              RoughDielectric, Boundary>;

/// Is the material a boundary, which does not scatter?
inline bool is_boundary(const Material& m) { return std::holds_alternative<Boundary>(m); }
/// Does the material both reflect light and let it through?
inline bool is_dielectric(const Material& m) {
  return std::holds_alternative<Dielectric>(m) || std::holds_alternative<ThinDielectric>(m) ||
         std::holds_alternative<RoughDielectric>(m);
}
/// Is the material non-specular: does it scatter light into a range of directions? So is Lambertian, unless black.
/// Photons are stored only on such materials, and only their scatter_value() is not black.
bool is_rough(const Material& m);
/// The reflectance of a diffuse material; null for all others. Such a material looks the same from all directions: the
/// radiance that it reflects is its reflectance / pi times the irradiance on that side.
inline const Rgb* diffuse_reflectance(const Material& m) {
  const auto* lambertian = std::get_if<Lambertian>(&m);
  return lambertian ? &lambertian->reflectance : nullptr;
}
/// Does the material scatter diffusely?
inline bool is_diffuse(const Material& m) { return diffuse_reflectance(m) != nullptr; }
/// Is the material non-specular, and does light that arrives on either side leave on both?
bool scatters_through(const Material& m);
/// Are all its coefficients equal over the channels?
bool is_grey(const Material& m);

/// How a path goes on from a surface.
struct Scatter {
  Vec3 direction{0.0f};  // of travel, away from the surface, unit; on the far side if transmitted, else on the near one
  Rgb weight{0.0f};      // times the path's power or throughput: value / pdf of scatter_value()
  bool transmitted = false;  // to the other side of the surface
  /// (ior on the near side / ior on the far side)^2 at refraction, else 1. Paths from the eye multiply by it, because
  /// refraction preserves radiance / ior^2. Photons carry power and do not multiply by it.
  float radiance_scale = 1.0f;
  float pdf = std::numeric_limits<float>::infinity();  // of `direction`, 1/sr; infinite for specular scattering
  /// Photons multiply by it, paths from the eye do not. It differs from 1 only where the shading normal differs from
  /// the geometric one (surface/shading.h).
  float flux_scale = 1.0f;
};

/// The reflectance of a material, which a texture may replace; null where it has none.
Rgb* reflectance_of(Material& material);

/// Samples the scattering of a path that travels along `travel` (unit) and meets a surface of normal `normal` (unit,
/// outward) from either side. `u_choice` and `u` are uniform in [0, 1). Black weight: absorbed. A boundary, a
/// thin dielectric, and a dielectric of ior 1 pass the direction unchanged to the last bit.
Scatter sample_scatter(const Material& material, const Vec3& normal, const Vec3& travel, float u_choice, const Vec2& u);

/// The fraction of light that a smooth dielectric reflects, by Fresnel's equations; it lets the rest pass. With that
/// probability sample_scatter() reflects: where `u_choice` is below it. Nothing for all other materials.
std::optional<float> reflected_fraction(const Material& material, const Vec3& normal, const Vec3& travel);

/// How much light a material scatters from `travel` into `direction` (both directions of travel, unit), and with which
/// density sample_scatter() does so: for shadow rays, gathering and multiple importance sampling. Black for specular
/// materials, because no ray finds their directions by chance.
struct ScatterValue {
  Rgb value{0.0f};   // BSDF for power along `travel`, times |cos| of `direction` to the normal, 1/sr
  float pdf = 0.0f;  // of sample_scatter(), 1/sr
  /// As in Scatter: paths from the eye, along which light travels the other way, multiply the value by it.
  float radiance_scale = 1.0f;
};
ScatterValue scatter_value(const Material& material, const Vec3& normal, const Vec3& travel, const Vec3& direction);

/// The first number of a material that is out of its range, and that range, as a clause: "its reflectance must lie in
/// [0, 1]"; "" where there is none.
std::string problem_of(const Material& material);

}  // namespace vpm
