// Parallel light, and light from infinity: where it enters the scene, beams, one direction, and all directions, of one
// radiance or by a picture.
#include "vpm/base/warp.h"
#include "vpm/light/kinds.h"

namespace vpm {

// Where light from infinity enters the scene: the box around it, by the area that the box shows to each direction.
Vec3d face_areas(const Box& box) {
  const Vec3d e(box.extent());
  return {e.y * e.z, e.z * e.x, e.x * e.y};
}

double area_across(const Box& box, const Vec3& direction) {
  return glm::dot(glm::abs(Vec3d(direction)), face_areas(box));
}

int pick_axis(const Vec3d& weights, double choice) {
  const double target = choice * (weights.x + weights.y + weights.z);
  return target < weights.x ? 0 : target < weights.x + weights.y ? 1 : 2;
}

Vec3 point_on_face(const Box& box, int axis, bool upper, const Vec2& u) {
  Vec3 p;
  p[axis] = upper ? box.hi[axis] : box.lo[axis];
  for (const int k : {0, 1}) {
    const int along = (axis + 1 + k) % 3;
    p[along] = std::lerp(box.lo[along], box.hi[along], u[k]);
  }
  return p;
}

Ray ray_into(const Box& box, const Vec3& direction, const EmissionNumbers& u) {
  // The three faces that look against the direction hide nothing of each other.
  const int axis = pick_axis(glm::abs(Vec3d(direction)) * face_areas(box), u.face);
  return {point_on_face(box, axis, direction[axis] < 0.0f, u.place), direction};
}

Vec3 point_on_disc(const Vec3& center, const Vec3& axis, float radius, const Vec2& u) {
  const Vec2 d = radius * uniform_disc(u);
  Vec3 s, t;
  make_frame(axis, s, t);
  return center + d.x * s + d.y * t;
}

Rgb power_of(const BeamLight& light, const Box&) { return light.power; }

Emission emit_from(const BeamLight& light, const Box&, const EmissionNumbers& u) {
  return {Ray{point_on_disc(light.position, light.direction, light.radius, u.place), light.direction}, light.power};
}

std::optional<Incident> incident_from(const BeamLight& light, const Vec3& point, Rng&) {
  const Vec3 from_disc = point - light.position;
  const float ahead = glm::dot(from_disc, light.direction);
  if (!(ahead > 0.0f) || glm::length(from_disc - ahead * light.direction) > light.radius) return std::nullopt;
  return Incident{-light.direction, ahead, light.power / (kPi * light.radius * light.radius), 0.0f};
}

Rgb power_of(const DirectionalLight& light, const Box& scene) {
  return static_cast<float>(area_across(scene, light.direction)) * light.irradiance;
}

Emission emit_from(const DirectionalLight& light, const Box& scene, const EmissionNumbers& u) {
  return {ray_into(scene, light.direction, u), power_of(light, scene)};
}

std::optional<Incident> incident_from(const DirectionalLight& light, const Vec3&, Rng&) {
  return Incident{-light.direction, kInfinity, light.irradiance, 0.0f};
}

LightPlace place_of(const BeamLight& light) {
  return {{light.position - light.radius, light.position + light.radius}, light.position};
}

Rgb power_of(const ConstantEnvironment& light, const Box& scene) {
  const Vec3d faces = face_areas(scene);
  return kPi * 2.0f * static_cast<float>(faces.x + faces.y + faces.z) * light.radiance;
}

Emission emit_from(const ConstantEnvironment& light, const Box& scene, const EmissionNumbers& u) {
  // Even light enters every part of the box's surface alike, by the cosine law.
  const bool upper = u.face >= 0.5;
  const int axis = pick_axis(face_areas(scene), 2.0 * u.face - (upper ? 1.0 : 0.0));
  Vec3 inward(0.0f);
  inward[axis] = upper ? -1.0f : 1.0f;
  const Vec3 from = point_on_face(scene, axis, upper, u.place);
  return {Ray{from, cosine_hemisphere(inward, u.direction)}, power_of(light, scene)};
}

std::optional<Incident> incident_from(const ConstantEnvironment& light, const Vec3&, Rng& rng) {
  return Incident{uniform_sphere(rng.uniform2()), kInfinity, 4.0f * kPi * light.radiance, 1.0f / (4.0f * kPi)};
}

Rgb power_of(const EnvironmentMap& light, const Box& scene) {
  const Vec3d faces = face_areas(scene);
  const auto& flux = light.image->flux_across();
  return Rgb(faces.x * flux[0] + faces.y * flux[1] + faces.z * flux[2]);
}

Emission emit_from(const EnvironmentMap& light, const Box& scene, const EmissionNumbers& u) {
  const ImageEnvironment::Sample s = light.image->sample(u.choice, u.direction);
  const auto area = static_cast<float>(area_across(scene, s.direction));
  return {ray_into(scene, -s.direction, u), area / s.pdf * s.radiance};
}

std::optional<Incident> incident_from(const EnvironmentMap& light, const Vec3&, Rng& rng) {
  const double choice = rng.uniform_double();
  const ImageEnvironment::Sample s = light.image->sample(choice, rng.uniform2());
  return Incident{s.direction, kInfinity, s.radiance / s.pdf, s.pdf};
}

float pdf_of(const ConstantEnvironment&, const Vec3&, const SeenLight&) { return 1.0f / (4.0f * kPi); }

float pdf_of(const EnvironmentMap& light, const Vec3&, const SeenLight& seen) {
  return light.image->pdf(seen.direction);
}

}  // namespace vpm
