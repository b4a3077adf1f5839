// The closed set of materials: each question goes to the kind it is asked of. The answers of the simplest kinds, and
// the ranges of what materials are made of.
#include "vpm/surface/material/material.h"

#include <fmt/format.h>

#include "vpm/base/overloads.h"
#include "vpm/base/warp.h"
#include "vpm/surface/material/fresnel.h"
#include "vpm/surface/material/kinds.h"

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

namespace {

bool within(float value, double lo, double hi) {
  return value >= static_cast<float>(lo) && value <= static_cast<float>(hi);
}
bool within(const Rgb& value, double lo, double hi) {
  return within(value.r, lo, hi) && within(value.g, lo, hi) && within(value.b, lo, hi);
}

/// The clause about a number, "" where it is in its range.
template <class Number>
std::string range_problem(const char* name, const Number& value, double lo, double hi) {
  return within(value, lo, hi) ? "" : fmt::format("its {} must lie in [{}, {}]", name, lo, hi);
}

std::string index_problem(float ior) { return range_problem("ior", ior, kLeastIndex, kLargestIndex); }

std::string roughness_problem(float roughness) {
  return within(roughness, kLeastRoughness, 1.0) ? ""
                                                 : fmt::format("its roughness must lie in [{}, 1]", kLeastRoughness);
}

std::string metal_problem(const Rgb& eta, const Rgb& k) {
  const std::string of_eta = range_problem("eta", eta, kLeastIndex, kLargestIndex);
  return of_eta.empty() ? range_problem("k", k, kLeastK, kLargestK) : of_eta;
}

std::string phong_problem(const Phong& m) {
  if (!within(m.diffuse, 0.0, 1.0) || !within(m.glossy, 0.0, 1.0) || !within(m.diffuse + m.glossy, 0.0, 1.0))
    return "its diffuse and glossy reflectances must be at least 0, and their sum at most 1";
  return range_problem("exponent", m.exponent, 0.0, kLargestExponent);
}

std::string rough_dielectric_problem(const RoughDielectric& m) {
  const std::string of_index = index_problem(m.ior);
  if (!of_index.empty()) return of_index;
  if (std::abs(m.ior - 1.0f) < kLeastIorStep)
    return fmt::format("its ior must be at least {} away from 1", kLeastIorStep);
  return roughness_problem(m.roughness);
}

}  // namespace

std::string problem_of(const Material& material) {
  return std::visit(Overloads{[](const Lambertian& m) { return range_problem("reflectance", m.reflectance, 0.0, 1.0); },
                              [](const Phong& m) { return phong_problem(m); },
                              [](const Mirror& m) { return range_problem("reflectance", m.reflectance, 0.0, 1.0); },
                              [](const Conductor& m) { return metal_problem(m.eta, m.k); },
                              [](const RoughConductor& m) {
                                const std::string of_metal = metal_problem(m.eta, m.k);
                                return of_metal.empty() ? roughness_problem(m.roughness) : of_metal;
                              },
                              [](const Dielectric& m) { return index_problem(m.ior); },
                              [](const ThinDielectric& m) { return index_problem(m.ior); },
                              [](const RoughDielectric& m) { return rough_dielectric_problem(m); },
                              [](const Boundary&) { return std::string(); }},
                    material);
}

}  // namespace vpm
