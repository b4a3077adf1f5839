// What a surface does to light: the closed set of materials. Directions are those of travel, before and after.
#pragma once

#include <limits>
#include <variant>

#include "vpm/base/vec.h"

namespace vpm {

class FacetLoss;

/// Ideal diffuse reflection on both sides, radiance factor reflectance/pi.
struct Lambertian {
  Rgb reflectance{0.5f};  // in [0, 1]
};
/// Diffuse and glossy reflection on both sides; the glossy lobe is a power of the cosine to the mirror's direction, and
/// loses what it would send into the surface [Lafortune1994].
struct Phong {
  Rgb diffuse{0.5f};       // reflectance, in [0, 1]
  Rgb glossy{0.3f};        // of the lobe at normal incidence, at the most; with `diffuse` at most 1
  float exponent = 50.0f;  // >= 0
};
/// Ideal mirror on both sides.
struct Mirror {
  Rgb reflectance{1.0f};  // in [0, 1]
};
/// Smooth metal: reflects by Fresnel's equations on both sides. Index of refraction eta + i k over that before it.
struct Conductor {
  Rgb eta{1.0f}, k{1.0f};  // > 0
};
/// Metal of conducting microfacets, distributed by Trowbridge and Reitz (GGX). The main lobe reflects light once; what
/// would meet a second facet is lost, or comes back evenly where `loss` tells of it.
struct RoughConductor {
  Rgb eta{1.0f}, k{1.0f};  // as in Conductor
  float roughness = 0.1f;  // alpha of the distribution, in [kLeastRoughness, 1]
  const FacetLoss* loss = nullptr;
};
/// Smooth dielectric: reflects and refracts by Fresnel's equations.
struct Dielectric {
  float ior = 1.5f;  // index behind the surface (against its normal: inside) over the index before it, > 0
};
/// A pane of smooth dielectric, too thin to shift what passes: reflects by Fresnel's equations what comes back from all
/// passes between its two faces, and lets the rest straight through.
struct ThinDielectric {
  float ior = 1.5f;  // index of the pane over that around it, > 0
};
/// Dielectric of microfacets, as RoughConductor's, that reflect and refract [Walter2007].
struct RoughDielectric {
  float ior = 1.5f;        // as in Dielectric, at least kLeastIorStep away from 1
  float roughness = 0.1f;  // as in RoughConductor
  const FacetLoss* loss = nullptr;
};
/// A border between media that light passes unchanged. Crossing it is no scattering event.
struct Boundary {};

/// Narrower lobes than these are close to the accuracy of directions in single precision and in photon maps.
inline constexpr float kLeastRoughness = 1e-3f;
inline constexpr float kLeastIorStep = 1e-2f;
inline constexpr float kLargestExponent = 1e6f;

using Material = std::variant<Lambertian, Phong, Mirror, Conductor, RoughConductor, Dielectric, ThinDielectric,
                              RoughDielectric, Boundary>;

/// Is the material a border that does not scatter?
inline bool is_boundary(const Material& m) { return std::holds_alternative<Boundary>(m); }
/// Does the material both reflect light and let it through?
inline bool is_dielectric(const Material& m) {
  return std::holds_alternative<Dielectric>(m) || std::holds_alternative<ThinDielectric>(m) ||
         std::holds_alternative<RoughDielectric>(m);
}
/// Does the material scatter light into a spread of directions? Then photons on it are worth storing, and shadow rays
/// find its scatter_value().
bool is_rough(const Material& m);
/// The reflectance of a material that scatters diffusely, so that it looks the same from all directions and the
/// radiance it sends out is its reflectance / pi times the irradiance on that side; null for all others.
inline const Rgb* diffuse_reflectance(const Material& m) {
  const auto* lambertian = std::get_if<Lambertian>(&m);
  return lambertian ? &lambertian->reflectance : nullptr;
}
/// Does the material scatter diffusely?
inline bool is_diffuse(const Material& m) { return diffuse_reflectance(m) != nullptr; }
/// Is it rough, and does light from either side leave on both?
bool scatters_through(const Material& m);
/// Are all its coefficients equal over the channels?
bool is_grey(const Material& m);

/// How a path goes on from a surface.
struct Scatter {
  Vec3 direction{0.0f};  // of travel, away from the surface, unit; on the far side if transmitted, else on the near one
  Rgb weight{0.0f};      // times the path's power or throughput: value / pdf of scatter_value()
  bool transmitted = false;  // to the other side of the surface
  /// (ior on the near side / ior on the far side)^2 at refraction, else 1. Eye paths multiply by it, because radiance
  /// over ior^2 is what refraction keeps; photons carry flux and do not.
  float radiance_scale = 1.0f;
  float pdf = std::numeric_limits<float>::infinity();  // of `direction`, 1/sr; infinite: the only one of its kind
  /// What photons multiply by, and eye paths do not: other than 1 only where a shading normal differs from the
  /// geometric one (surface/shading.h).
  float flux_scale = 1.0f;
};

/// The reflectance of a material, which a texture may replace; null where it has none.
Rgb* reflectance_of(Material& material);

/// Samples the scattering of a path that travels along `travel` (unit) and meets a surface of normal `normal` (unit,
/// outward) from either side. `u_choice` and `u` are uniform in [0, 1). Black weight: absorbed. A boundary, a
/// thin dielectric, and a dielectric of ior 1 pass the direction unchanged to the last bit.
Scatter sample_scatter(const Material& material, const Vec3& normal, const Vec3& travel, float u_choice, const Vec2& u);

/// How much light a material scatters from `travel` into `direction` (both of travel, unit), and how likely
/// sample_scatter() does so: for shadow rays, gathering and multiple importance sampling. Black where the material is
/// not rough: no ray finds its directions by chance.
struct ScatterValue {
  Rgb value{0.0f};   // BSDF for flux along `travel`, times |cos| of `direction` to the normal, 1/sr
  float pdf = 0.0f;  // of sample_scatter(), 1/sr
  /// As in Scatter: eye paths, along which light travels the other way, multiply the value by it.
  float radiance_scale = 1.0f;
};
ScatterValue scatter_value(const Material& material, const Vec3& normal, const Vec3& travel, const Vec3& direction);

}  // namespace vpm
