// What each kind of light answers; light.cpp picks the overload. Included by this folder's .cpp files only.
#pragma once

#include "vpm/light/light.h"

namespace vpm {

// light_power()
Rgb power_of(const PointLight& light, const Box& scene);
Rgb power_of(const SpotLight& light, const Box& scene);
Rgb power_of(const BeamLight& light, const Box& scene);
Rgb power_of(const QuadLight& light, const Box& scene);
Rgb power_of(const DiscLight& light, const Box& scene);
Rgb power_of(const SphereLight& light, const Box& scene);
Rgb power_of(const MeshLight& light, const Box& scene);
Rgb power_of(const DirectionalLight& light, const Box& scene);
Rgb power_of(const ConstantEnvironment& light, const Box& scene);
Rgb power_of(const EnvironmentMap& light, const Box& scene);

// emit()
Emission emit_from(const PointLight& light, const Box& scene, const EmissionNumbers& u);
Emission emit_from(const SpotLight& light, const Box& scene, const EmissionNumbers& u);
Emission emit_from(const BeamLight& light, const Box& scene, const EmissionNumbers& u);
Emission emit_from(const QuadLight& light, const Box& scene, const EmissionNumbers& u);
Emission emit_from(const DiscLight& light, const Box& scene, const EmissionNumbers& u);
Emission emit_from(const SphereLight& light, const Box& scene, const EmissionNumbers& u);
Emission emit_from(const MeshLight& light, const Box& scene, const EmissionNumbers& u);
Emission emit_from(const DirectionalLight& light, const Box& scene, const EmissionNumbers& u);
Emission emit_from(const ConstantEnvironment& light, const Box& scene, const EmissionNumbers& u);
Emission emit_from(const EnvironmentMap& light, const Box& scene, const EmissionNumbers& u);

// sample_towards()
std::optional<Incident> incident_from(const PointLight& light, const Vec3& point, Rng& rng);
std::optional<Incident> incident_from(const SpotLight& light, const Vec3& point, Rng& rng);
std::optional<Incident> incident_from(const BeamLight& light, const Vec3& point, Rng& rng);
std::optional<Incident> incident_from(const QuadLight& light, const Vec3& point, Rng& rng);
std::optional<Incident> incident_from(const DiscLight& light, const Vec3& point, Rng& rng);
std::optional<Incident> incident_from(const SphereLight& light, const Vec3& point, Rng& rng);
std::optional<Incident> incident_from(const MeshLight& light, const Vec3& point, Rng& rng);
std::optional<Incident> incident_from(const DirectionalLight& light, const Vec3& point, Rng& rng);
std::optional<Incident> incident_from(const ConstantEnvironment& light, const Vec3& point, Rng& rng);
std::optional<Incident> incident_from(const EnvironmentMap& light, const Vec3& point, Rng& rng);

// incident_pdf(), of the lights that can be seen
float pdf_of(const QuadLight& light, const Vec3& point, const SeenLight& seen);
float pdf_of(const DiscLight& light, const Vec3& point, const SeenLight& seen);
float pdf_of(const SphereLight& light, const Vec3& point, const SeenLight& seen);
float pdf_of(const MeshLight& light, const Vec3& point, const SeenLight& seen);
float pdf_of(const ConstantEnvironment& light, const Vec3& point, const SeenLight& seen);
float pdf_of(const EnvironmentMap& light, const Vec3& point, const SeenLight& seen);

// light_place(), of the lights that stand somewhere
LightPlace place_of(const PointLight& light);
LightPlace place_of(const SpotLight& light);
LightPlace place_of(const BeamLight& light);
LightPlace place_of(const QuadLight& light);
LightPlace place_of(const DiscLight& light);
LightPlace place_of(const SphereLight& light);
LightPlace place_of(const MeshLight& light);

// draw_light_point(), of the lights whose points are drawn by area
LightPoint draw_place(const QuadLight& light, Rng& rng);
LightPoint draw_place(const DiscLight& light, Rng& rng);
LightPoint draw_place(const MeshLight& light, Rng& rng);
/// The light of radiance `radiance` that reaches `point` from one drawn evenly over an area; nothing from behind.
std::optional<Incident> incident_by_area(const Rgb& radiance, const LightPoint& from, const Vec3& point);
/// The density of that at what was seen, 1/sr: distance^2 / (area cos).
float pdf_by_area(float area, const SeenLight& seen);

/// The areas of a box's faces across the x, y and z axes, m^2.
Vec3d face_areas(const Box& box);
/// The area that the box shows to light along `direction`, m^2: sum |direction_i| face_areas_i.
double area_across(const Box& box, const Vec3& direction);
/// 0, 1 or 2 with probability in proportion to the weights, which are at least 0 and not all 0; `choice` is uniform in
/// [0, 1).
int pick_axis(const Vec3d& weights, double choice);
/// Where parallel light along `direction` enters the box, uniform over the area across the direction; by the numbers
/// `face` and `place`.
Ray ray_into(const Box& box, const Vec3& direction, const EmissionNumbers& u);
/// A point uniform over the face of the box across `axis`, the upper one or the lower one.
Vec3 point_on_face(const Box& box, int axis, bool upper, const Vec2& u);
/// A point uniform over the disc of `radius` across the unit vector `axis`.
Vec3 point_on_disc(const Vec3& centre, const Vec3& axis, float radius, const Vec2& u);

}  // namespace vpm
