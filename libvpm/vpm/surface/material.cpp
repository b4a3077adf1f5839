// The closed set of materials: each question goes to the kind it is asked of. And the answers of the simplest kinds.
#include "vpm/surface/material.h"

#include "vpm/base/overloads.h"
#include "vpm/base/warp.h"
#include "vpm/surface/fresnel.h"
#include "vpm/surface/kinds.h"

namespace vpm {

namespace {

Scatter passed(const Vec3& travel) { return {travel, Rgb(1.0f), true, 1.0f}; }

/// The index on the far side over that on the near one.
float relative_index(const Dielectric& m, const Incidence& in) { return in.from_outside ? m.ior : 1.0f / m.ior; }

float reflected(const Dielectric& m, const Incidence& in) {
  return fresnel_dielectric(in.cosine, relative_index(m, in));
}

/// R + (1 - R)^2 R (1 + R^2 + R^4 + ...) = 2 R / (1 + R) comes back of what each face reflects R of.
float reflected(const ThinDielectric& m, const Incidence& in) {
  const float by_face = fresnel_dielectric(in.cosine, m.ior);
  return 2.0f * by_face / (1.0f + by_face);
}

}  // namespace

Scatter sample(const Lambertian& m, const Vec3& normal, const Vec3& travel, float, const Vec2& u) {
  const Vec3 near_side = Incidence(normal, travel).normal;
  const Vec3 direction = cosine_hemisphere(near_side, u);
  return {direction, m.reflectance, false, 1.0f, glm::dot(near_side, direction) / kPi};
}

Scatter sample(const Mirror& m, const Vec3& normal, const Vec3& travel, float, const Vec2&) {
  return {mirrored(Incidence(normal, travel), travel), m.reflectance, false, 1.0f};
}

Scatter sample(const Conductor& m, const Vec3& normal, const Vec3& travel, float, const Vec2&) {
  const Incidence in(normal, travel);
  return {mirrored(in, travel), fresnel_conductor(in.cosine, m.eta, m.k), false, 1.0f};
}

/// Reflection is chosen with its probability by Fresnel, so either way the weight is 1.
Scatter sample(const Dielectric& m, const Vec3& normal, const Vec3& travel, float u_choice, const Vec2&) {
  if (m.ior == 1.0f) return passed(travel);
  const Incidence in(normal, travel);
  if (u_choice < reflected(m, in)) return {mirrored(in, travel), Rgb(1.0f), false, 1.0f};
  const float eta = relative_index(m, in);
  const float cos_t = cos_transmitted(in.cosine, eta);
  const Vec3 refracted = travel / eta + (in.cosine / eta - cos_t) * in.normal;
  return {on_side(refracted, -in.normal), Rgb(1.0f), true, 1.0f / (eta * eta)};
}

Scatter sample(const ThinDielectric& m, const Vec3& normal, const Vec3& travel, float u_choice, const Vec2&) {
  const Incidence in(normal, travel);
  if (u_choice < reflected(m, in)) return {mirrored(in, travel), Rgb(1.0f), false, 1.0f};
  return passed(travel);
}

Scatter sample(const Boundary&, const Vec3&, const Vec3& travel, float, const Vec2&) { return passed(travel); }

ScatterValue value(const Lambertian& m, const Vec3& normal, const Vec3& travel, const Vec3& direction) {
  const float cosine = glm::dot(Incidence(normal, travel).normal, direction);
  if (!(cosine > 0.0f)) return {};
  return {m.reflectance * (cosine / kPi), cosine / kPi};
}

ScatterValue value(const Mirror&, const Vec3&, const Vec3&, const Vec3&) { return {}; }
ScatterValue value(const Conductor&, const Vec3&, const Vec3&, const Vec3&) { return {}; }
ScatterValue value(const Dielectric&, const Vec3&, const Vec3&, const Vec3&) { return {}; }
ScatterValue value(const ThinDielectric&, const Vec3&, const Vec3&, const Vec3&) { return {}; }
ScatterValue value(const Boundary&, const Vec3&, const Vec3&, const Vec3&) { return {}; }

bool is_rough(const Material& material) {
  return std::visit(Overloads{[](const Lambertian& m) { return !is_black(m.reflectance); },
                              [](const Phong& m) { return !is_black(m.diffuse) || !is_black(m.glossy); },
                              [](const RoughConductor&) { return true; }, [](const RoughDielectric&) { return true; },
                              [](const Mirror&) { return false; }, [](const Conductor&) { return false; },
                              [](const Dielectric&) { return false; }, [](const ThinDielectric&) { return false; },
                              [](const Boundary&) { return false; }},
                    material);
}

bool scatters_through(const Material& material) {
  return std::visit(Overloads{[](const RoughDielectric&) { return true; }, [](const Lambertian&) { return false; },
                              [](const Phong&) { return false; }, [](const RoughConductor&) { return false; },
                              [](const Mirror&) { return false; }, [](const Conductor&) { return false; },
                              [](const Dielectric&) { return false; }, [](const ThinDielectric&) { return false; },
                              [](const Boundary&) { return false; }},
                    material);
}

Rgb* reflectance_of(Material& material) {
  using None = Rgb*;
  return std::visit(Overloads{[](Lambertian& m) { return &m.reflectance; }, [](Mirror& m) { return &m.reflectance; },
                              [](Phong&) { return None(); }, [](Conductor&) { return None(); },
                              [](RoughConductor&) { return None(); }, [](Dielectric&) { return None(); },
                              [](ThinDielectric&) { return None(); }, [](RoughDielectric&) { return None(); },
                              [](Boundary&) { return None(); }},
                    material);
}

bool is_grey(const Material& material) {
  return std::visit(Overloads{[](const Lambertian& m) { return is_grey(m.reflectance); },
                              [](const Phong& m) { return is_grey(m.diffuse) && is_grey(m.glossy); },
                              [](const Mirror& m) { return is_grey(m.reflectance); },
                              [](const Conductor& m) { return is_grey(m.eta) && is_grey(m.k); },
                              [](const RoughConductor& m) { return is_grey(m.eta) && is_grey(m.k); },
                              [](const Dielectric&) { return true; }, [](const ThinDielectric&) { return true; },
                              [](const RoughDielectric&) { return true; }, [](const Boundary&) { return true; }},
                    material);
}

Scatter sample_scatter(const Material& material, const Vec3& normal, const Vec3& travel, float u_choice,
                       const Vec2& u) {
  return std::visit([&](const auto& m) { return sample(m, normal, travel, u_choice, u); }, material);
}

std::optional<float> reflected_fraction(const Material& material, const Vec3& normal, const Vec3& travel) {
  using Fraction = std::optional<float>;
  const auto smooth = [&](const auto& m) { return Fraction(reflected(m, Incidence(normal, travel))); };
  const auto other = [](const auto&) { return Fraction(); };
  return std::visit(Overloads{[&](const Dielectric& m) { return smooth(m); },
                              [&](const ThinDielectric& m) { return smooth(m); }, other},
                    material);
}

ScatterValue scatter_value(const Material& material, const Vec3& normal, const Vec3& travel, const Vec3& direction) {
  return std::visit([&](const auto& m) { return value(m, normal, travel, direction); }, material);
}

}  // namespace vpm
