// The functions of each kind of light; light.cpp picks the overload. Only this folder's .cpp files include this.
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
Rgb power_of(const VolumeLight& light, const Box& scene);

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
Emission emit_from(const VolumeLight& light, const Box& scene, const EmissionNumbers& u);

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
std::optional<Incident> incident_from(const VolumeLight& light, const Vec3& point, Rng& rng);

// incident_pdf(), for the lights that can be seen
float pdf_of(const QuadLight& light, const Vec3& point, const SeenLight& seen);
float pdf_of(const DiscLight& light, const Vec3& point, const SeenLight& seen);
float pdf_of(const SphereLight& light, const Vec3& point, const SeenLight& seen);
float pdf_of(const MeshLight& light, const Vec3& point, const SeenLight& seen);
float pdf_of(const ConstantEnvironment& light, const Vec3& point, const SeenLight& seen);
float pdf_of(const EnvironmentMap& light, const Vec3& point, const SeenLight& seen);
float pdf_of(const VolumeLight& light, const Vec3& point, const SeenLight& seen);

// light_place(), for the lights that are not at infinity
LightPlace place_of(const PointLight& light);
LightPlace place_of(const SpotLight& light);
LightPlace place_of(const BeamLight& light);
LightPlace place_of(const QuadLight& light);
LightPlace place_of(const DiscLight& light);
LightPlace place_of(const SphereLight& light);
LightPlace place_of(const MeshLight& light);
LightPlace place_of(const VolumeLight& light);

// draw_light_point(), for the lights whose points are drawn uniformly by area
LightPoint draw_place(const QuadLight& light, Rng& rng);
LightPoint draw_place(const DiscLight& light, Rng& rng);
LightPoint draw_place(const MeshLight& light, Rng& rng);
/// The light that reaches `point` from the point `from`, which was drawn uniformly over the area of a light of radiance
/// `radiance`; nothing behind the light.
std::optional<Incident> incident_by_area(const Rgb& radiance, const LightPoint& from, const Vec3& point);
/// The density of incident_by_area() at what was seen, 1/sr: distance^2 / (area cos).
float pdf_by_area(float area, const SeenLight& seen);

/// The density with which emit() draws a direction of travel, 1/sr.
double spot_density(const SpotLight& light, const Vec3& travel);

/// The areas of a box's faces perpendicular to the x, y and z axes, m^2.
Vec3d face_areas(const Box& box);
/// The area of the box projected along `direction`, m^2: sum |direction_i| face_areas_i.
double area_across(const Box& box, const Vec3& direction);
/// Picks 0, 1 or 2 with probabilities in proportion to the weights, which are >= 0 and not all 0. `choice` is uniform
/// in [0, 1).
int pick_axis(const Vec3d& weights, double choice);
/// A ray of parallel light along `direction`, from where it enters the box. It is uniform over the box's area projected
/// along the direction, and uses the numbers `face` and `place` of `u`.
Ray ray_into(const Box& box, const Vec3& direction, const EmissionNumbers& u);
/// A point uniform over the upper or lower face of the box perpendicular to `axis`.
Vec3 point_on_face(const Box& box, int axis, bool upper, const Vec2& u);
/// A point uniform over the disc of `radius` perpendicular to the unit vector `axis`.
Vec3 point_on_disc(const Vec3& center, const Vec3& axis, float radius, const Vec2& u);

}  // namespace vpm
