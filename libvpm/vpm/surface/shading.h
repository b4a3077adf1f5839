// Scattering at a hit whose shading normal may differ from the geometric one.
//
// The material uses the shading normal. Light is scattered only if each of its two directions lies on the same side of
// the geometric normal as of the shading normal. With respect to the geometric normal it is then reflected or
// transmitted as the material says. Other light is absorbed, except that light which goes straight on is left
// unchanged. With respect to the geometric cosines the BSDF is f |cos_s| / |cos_g|, with the cosines of the direction
// from which light arrives [Veach1997, sec. 5.3]. It is not symmetric: with w = f |cos_s| / pdf,
// paths from the eye multiply radiance by w, and photons multiply power by w times Scatter::flux_scale.
#pragma once

#include "vpm/surface/geometry.h"
#include "vpm/surface/material/material.h"

namespace vpm {

/// sample_scatter() at a hit, with Scatter::flux_scale. Where the normals are equal, the result is that of the material
/// bit for bit.
Scatter sample_scatter(const Material& material, const Hit& hit, const Vec3& travel, float u_choice, const Vec2& u);

/// The result that sample_scatter() would give if it drew `direction`: for callers that draw the direction by other
/// means. Specular lobes are left out. Black, with pdf 0, if sample_scatter() never draws the direction.
Scatter scatter_into(const Material& material, const Hit& hit, const Vec3& travel, const Vec3& direction);

/// scatter_value() at a hit. Its value is the BSDF times the cosine of `direction` to the shading normal. Radiance that
/// arrives against `direction` is multiplied by it on its way to the eye.
ScatterValue scatter_value(const Material& material, const Hit& hit, const Vec3& travel, const Vec3& direction);

/// Are the two normals equal?
inline bool single_normal(const Hit& hit) { return hit.shading_normal == hit.normal; }

/// |cos_s| / |cos_g| of light that arrives along `travel`. It converts irradiance by geometric cosines, which photons
/// estimate, into irradiance by shading cosines. 0 if the light arrives on different sides of the two normals; 1 if the
/// normals are equal.
float shading_irradiance_scale(const Hit& hit, const Vec3& travel);

}  // namespace vpm
