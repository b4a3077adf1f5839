// Sampling of the materials: which way a path goes on from a surface, and with what weight.
#include "surface/material.h"

#include <cassert>

#include "base/warp.h"

namespace vpm {

namespace {

/// Reflected and refracted directions make at least this cosine with the side they go to. At grazing incidence rounding
/// could otherwise carry a path through a mirror, or a refracted one back.
constexpr float kMinCosine = 1e-6f;

/// `direction` with unit length, on the side of the unit vector `n`.
Vec3 on_side(const Vec3& direction, const Vec3& n) {
  const Vec3 d = glm::normalize(direction);
  const float cosine = glm::dot(d, n);
  return cosine >= kMinCosine ? d : glm::normalize(d + (2.0f * kMinCosine - cosine) * n);
}

Vec3 mirrored(const Vec3& normal, const Vec3& near_side, const Vec3& travel) {
  return on_side(travel - 2.0f * glm::dot(normal, travel) * normal, near_side);
}

/// The cosine on the far side by Snell's law; negative at total internal reflection. In this form eta = 1 is exact, and
/// nothing cancels at grazing incidence.
float cos_transmitted(float cos_incident, float eta) {
  const float square = cos_incident * cos_incident + (eta - 1.0f) * (eta + 1.0f);
  return square < 0.0f ? -1.0f : std::sqrt(square) / eta;
}

/// A path before the surface: the normal on its side, and the cosine of incidence to it in [0, 1].
struct Incidence {
  Vec3 normal{0.0f};
  float cosine = 0.0f;
  bool from_outside = true;
};
Incidence incidence(const Vec3& normal, const Vec3& travel) {
  const float along = glm::dot(normal, travel);
  const bool from_outside = along < 0.0f;
  return {from_outside ? normal : -normal, std::min(1.0f, std::abs(along)), from_outside};
}

Scatter passed(const Vec3& travel) { return {travel, Rgb(1.0f), true, 1.0f}; }

Scatter sample(const Lambertian& m, const Vec3& normal, const Vec3& travel, float, const Vec2& u) {
  return {cosine_hemisphere(incidence(normal, travel).normal, u), m.reflectance, false, 1.0f};
}

Scatter sample(const Mirror& m, const Vec3& normal, const Vec3& travel, float, const Vec2&) {
  return {mirrored(normal, incidence(normal, travel).normal, travel), m.reflectance, false, 1.0f};
}

/// Reflection is chosen with its probability by Fresnel, so either way the weight is 1.
Scatter sample(const Dielectric& m, const Vec3& normal, const Vec3& travel, float u_choice, const Vec2&) {
  if (m.ior == 1.0f) return passed(travel);
  const Incidence in = incidence(normal, travel);
  const float eta = in.from_outside ? m.ior : 1.0f / m.ior;
  if (u_choice < fresnel_dielectric(in.cosine, eta))
    return {mirrored(normal, in.normal, travel), Rgb(1.0f), false, 1.0f};
  const float cos_t = cos_transmitted(in.cosine, eta);
  const Vec3 refracted = travel / eta + (in.cosine / eta - cos_t) * in.normal;
  return {on_side(refracted, -in.normal), Rgb(1.0f), true, 1.0f / (eta * eta)};
}

Scatter sample(const Boundary&, const Vec3&, const Vec3& travel, float, const Vec2&) { return passed(travel); }

ScatterValue value(const Lambertian& m, const Vec3& normal, const Vec3& travel, const Vec3& direction) {
  const float cosine = glm::dot(incidence(normal, travel).normal, direction);
  if (!(cosine > 0.0f)) return {};
  return {m.reflectance * (cosine / kPi), cosine / kPi};
}
template <class Specular>
ScatterValue value(const Specular&, const Vec3&, const Vec3&, const Vec3&) {
  return {};
}

bool grey(const Lambertian& m) { return is_grey(m.reflectance); }
bool grey(const Mirror& m) { return is_grey(m.reflectance); }
bool grey(const Dielectric&) { return true; }
bool grey(const Boundary&) { return true; }

}  // namespace

bool is_grey(const Material& material) {
  return std::visit([](const auto& m) { return grey(m); }, material);
}

Scatter sample_scatter(const Material& material, const Vec3& normal, const Vec3& travel, float u_choice,
                       const Vec2& u) {
  return std::visit([&](const auto& m) { return sample(m, normal, travel, u_choice, u); }, material);
}

ScatterValue scatter_value(const Material& material, const Vec3& normal, const Vec3& travel, const Vec3& direction) {
  return std::visit([&](const auto& m) { return value(m, normal, travel, direction); }, material);
}

float fresnel_dielectric(float cos_incident, float eta) {
  assert(cos_incident >= 0.0f && cos_incident <= 1.0f && eta > 0.0f);
  if (eta == 1.0f) return 0.0f;
  const float cos_t = cos_transmitted(cos_incident, eta);
  if (cos_t < 0.0f) return 1.0f;
  const float parallel = (eta * cos_incident - cos_t) / (eta * cos_incident + cos_t);
  const float perpendicular = (cos_incident - eta * cos_t) / (cos_incident + eta * cos_t);
  return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

}  // namespace vpm
