// What each kind of light answers; light.cpp picks the overload. Included by this folder's .cpp files only.
#pragma once

#include "light/light.h"

namespace vpm {

// light_power()
Rgb power_of(const PointLight& light, const SceneSphere& scene);
Rgb power_of(const SpotLight& light, const SceneSphere& scene);
Rgb power_of(const BeamLight& light, const SceneSphere& scene);
Rgb power_of(const QuadLight& light, const SceneSphere& scene);
Rgb power_of(const SphereLight& light, const SceneSphere& scene);
Rgb power_of(const DirectionalLight& light, const SceneSphere& scene);
Rgb power_of(const ConstantEnvironment& light, const SceneSphere& scene);
Rgb power_of(const EnvironmentMap& light, const SceneSphere& scene);

// emit()
Emission emit_from(const PointLight& light, const SceneSphere& scene, Rng& rng);
Emission emit_from(const SpotLight& light, const SceneSphere& scene, Rng& rng);
Emission emit_from(const BeamLight& light, const SceneSphere& scene, Rng& rng);
Emission emit_from(const QuadLight& light, const SceneSphere& scene, Rng& rng);
Emission emit_from(const SphereLight& light, const SceneSphere& scene, Rng& rng);
Emission emit_from(const DirectionalLight& light, const SceneSphere& scene, Rng& rng);
Emission emit_from(const ConstantEnvironment& light, const SceneSphere& scene, Rng& rng);
Emission emit_from(const EnvironmentMap& light, const SceneSphere& scene, Rng& rng);

// sample_towards()
std::optional<Incident> incident_from(const PointLight& light, const Vec3& point, Rng& rng);
std::optional<Incident> incident_from(const SpotLight& light, const Vec3& point, Rng& rng);
std::optional<Incident> incident_from(const BeamLight& light, const Vec3& point, Rng& rng);
std::optional<Incident> incident_from(const QuadLight& light, const Vec3& point, Rng& rng);
std::optional<Incident> incident_from(const SphereLight& light, const Vec3& point, Rng& rng);
std::optional<Incident> incident_from(const DirectionalLight& light, const Vec3& point, Rng& rng);
std::optional<Incident> incident_from(const ConstantEnvironment& light, const Vec3& point, Rng& rng);
std::optional<Incident> incident_from(const EnvironmentMap& light, const Vec3& point, Rng& rng);

// incident_pdf(), of the lights that can be seen
float pdf_of(const QuadLight& light, const Vec3& point, const Vec3& direction, float distance);
float pdf_of(const SphereLight& light, const Vec3& point, const Vec3& direction, float distance);
float pdf_of(const ConstantEnvironment& light, const Vec3& point, const Vec3& direction, float distance);
float pdf_of(const EnvironmentMap& light, const Vec3& point, const Vec3& direction, float distance);

/// Where parallel light from infinity starts: uniform over the disc across `direction` that touches the scene's sphere
/// from the side the light comes from; its area is pi radius^2.
Ray ray_from_infinity(const Vec3& direction, const SceneSphere& scene, const Vec2& u);
/// A point uniform over the disc of `radius` across the unit vector `axis`.
Vec3 point_on_disc(const Vec3& centre, const Vec3& axis, float radius, const Vec2& u);

}  // namespace vpm
