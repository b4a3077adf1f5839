// What a surface does to light: the closed set of materials. Directions are those of travel, before and after.
#pragma once

#include <variant>

#include "base/vec.h"

namespace vpm {

/// Ideal diffuse reflection on both sides, radiance factor reflectance/pi.
struct Lambertian {
  Rgb reflectance{0.5f};  // in [0, 1]
};
/// Ideal mirror on both sides.
struct Mirror {
  Rgb reflectance{1.0f};  // in [0, 1]
};
/// Smooth dielectric: reflects and refracts by Fresnel's equations.
struct Dielectric {
  float ior = 1.5f;  // index behind the surface (against its normal: inside) over the index before it, > 0
};
/// A border between media that light passes unchanged. Crossing it is no scattering event.
struct Boundary {};

using Material = std::variant<Lambertian, Mirror, Dielectric, Boundary>;

/// Is the material a border that does not scatter?
inline bool is_boundary(const Material& m) { return std::holds_alternative<Boundary>(m); }
/// Does the material scatter light into all directions, so that photons on it are worth storing?
inline bool is_diffuse(const Material& m) {
  const auto* lambertian = std::get_if<Lambertian>(&m);
  return lambertian && !is_black(lambertian->reflectance);
}
/// Are all its coefficients equal over the channels?
bool is_grey(const Material& m);

/// How a path goes on from a surface.
struct Scatter {
  Vec3 direction{0.0f};  // of travel, away from the surface, unit; on the far side if transmitted, else on the near one
  Rgb weight{0.0f};      // times the path's power or throughput: value cos / pdf
  bool transmitted = false;  // to the other side of the surface
  /// (ior on the near side / ior on the far side)^2 at refraction, else 1. Eye paths multiply by it, because radiance
  /// over ior^2 is what refraction keeps; photons carry flux and do not.
  float radiance_scale = 1.0f;
  /// What photons multiply by, and eye paths do not: other than 1 only where a shading normal differs from the
  /// geometric one (surface/shading.h).
  float flux_scale = 1.0f;
};

/// The reflectance of a material, which a texture may replace; null where it has none.
inline Rgb* reflectance_of(Material& material) {
  return std::visit(
      [](auto& m) -> Rgb* {
        if constexpr (requires { m.reflectance; })
          return &m.reflectance;
        else
          return nullptr;
      },
      material);
}

/// Samples the scattering of a path that travels along `travel` (unit) and meets a surface of normal `normal` (unit,
/// outward) from either side. `u_choice` and `u` are uniform in [0, 1). Black weight: absorbed. A boundary, and a
/// dielectric of ior 1, pass the direction unchanged to the last bit.
Scatter sample_scatter(const Material& material, const Vec3& normal, const Vec3& travel, float u_choice, const Vec2& u);

/// How much light a material scatters from `travel` into `direction` (both of travel, unit), and how likely
/// sample_scatter() does so: for shadow rays and multiple importance sampling. Black for mirrors, dielectrics and
/// boundaries, whose directions no ray finds by chance.
struct ScatterValue {
  Rgb value{0.0f};   // BSDF times the cosine to the normal of `direction`, 1/sr
  float pdf = 0.0f;  // of sample_scatter(), 1/sr
};
ScatterValue scatter_value(const Material& material, const Vec3& normal, const Vec3& travel, const Vec3& direction);

/// Fresnel reflectance of unpolarised light for the cosine of incidence in [0, 1] and eta = ior on the far side over
/// ior on the near side; 1 at total internal reflection [Pharr2023, sec. 9.3.5].
float fresnel_dielectric(float cos_incident, float eta);

}  // namespace vpm
