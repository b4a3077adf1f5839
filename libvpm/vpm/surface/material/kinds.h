// The functions of each kind of material; material.cpp picks the overload. Only this folder's .cpp files include this.
#pragma once

#include "vpm/surface/incidence.h"
#include "vpm/surface/material/material.h"

namespace vpm {

// sample_scatter()
Scatter sample(const Lambertian& m, const Vec3& normal, const Vec3& travel, float u_choice, const Vec2& u);
Scatter sample(const Phong& m, const Vec3& normal, const Vec3& travel, float u_choice, const Vec2& u);
Scatter sample(const Mirror& m, const Vec3& normal, const Vec3& travel, float u_choice, const Vec2& u);
Scatter sample(const Conductor& m, const Vec3& normal, const Vec3& travel, float u_choice, const Vec2& u);
Scatter sample(const RoughConductor& m, const Vec3& normal, const Vec3& travel, float u_choice, const Vec2& u);
Scatter sample(const Dielectric& m, const Vec3& normal, const Vec3& travel, float u_choice, const Vec2& u);
Scatter sample(const ThinDielectric& m, const Vec3& normal, const Vec3& travel, float u_choice, const Vec2& u);
Scatter sample(const RoughDielectric& m, const Vec3& normal, const Vec3& travel, float u_choice, const Vec2& u);
Scatter sample(const Boundary& m, const Vec3& normal, const Vec3& travel, float u_choice, const Vec2& u);

// scatter_value()
ScatterValue value(const Lambertian& m, const Vec3& normal, const Vec3& travel, const Vec3& direction);
ScatterValue value(const Phong& m, const Vec3& normal, const Vec3& travel, const Vec3& direction);
ScatterValue value(const Mirror& m, const Vec3& normal, const Vec3& travel, const Vec3& direction);
ScatterValue value(const Conductor& m, const Vec3& normal, const Vec3& travel, const Vec3& direction);
ScatterValue value(const RoughConductor& m, const Vec3& normal, const Vec3& travel, const Vec3& direction);
ScatterValue value(const Dielectric& m, const Vec3& normal, const Vec3& travel, const Vec3& direction);
ScatterValue value(const ThinDielectric& m, const Vec3& normal, const Vec3& travel, const Vec3& direction);
ScatterValue value(const RoughDielectric& m, const Vec3& normal, const Vec3& travel, const Vec3& direction);
ScatterValue value(const Boundary& m, const Vec3& normal, const Vec3& travel, const Vec3& direction);

/// The scattering of a non-specular material into the drawn direction; absorbed if it scatters nothing there.
inline Scatter scattered(const Vec3& direction, const ScatterValue& v, bool transmitted) {
  return {direction, v.pdf > 0.0f ? v.value / v.pdf : Rgb(0.0f), transmitted, v.radiance_scale, v.pdf};
}
/// The end of a path; the direction has no meaning.
inline Scatter absorbed(const Incidence& in) { return {in.normal, Rgb(0.0f), false, 1.0f, 0.0f}; }

}  // namespace vpm
