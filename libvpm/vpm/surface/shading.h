// Scattering at a hit whose normal for shading may differ from the geometric one.
//
// The material sees the shading normal. Light passes only where both its directions lie on the same sides of the
// geometric normal as of the shading one, by the geometric normal reflected or transmitted as the material says, and is
// absorbed elsewhere; what goes straight on is untouched. The BSDF with respect to the true, geometric cosines is
// f |cos_s| / |cos_g|, the cosines those of the light's arrival [Veach1997, sec. 5.3]. It is not symmetric: what
// weighs radiance by w = f |cos_s| / pdf for paths from the eye weighs flux by w times flux_scale().
#pragma once

#include "vpm/surface/geometry.h"
#include "vpm/surface/material.h"

namespace vpm {

/// sample_scatter() at a hit; with Scatter::flux_scale. Where the normals are equal, what the material says bit for
/// bit.
Scatter sample_scatter(const Material& material, const Hit& hit, const Vec3& travel, float u_choice, const Vec2& u);

/// What sample_scatter() makes of that direction where it draws it, for those who draw it otherwise; without any lobe
/// of a single direction. Black, with pdf 0, where it never does.
Scatter scatter_into(const Material& material, const Hit& hit, const Vec3& travel, const Vec3& direction);

/// scatter_value() at a hit. Its value is BSDF times the cosine to the shading normal of `direction`: what the radiance
/// that arrives against `direction` is multiplied by on its way to the eye.
ScatterValue scatter_value(const Material& material, const Hit& hit, const Vec3& travel, const Vec3& direction);

/// Is there but one normal?
inline bool single_normal(const Hit& hit) { return hit.shading_normal == hit.normal; }

/// |cos_s| / |cos_g| of light that arrives along `travel`: what turns irradiance by geometric cosines, such as photons
/// tell of, into irradiance by shading cosines. 0 where it arrives on different sides of the normals; 1 where they are
/// equal.
float shading_irradiance_scale(const Hit& hit, const Vec3& travel);

}  // namespace vpm
