// The ranges of reflectances, indices of refraction, exponents and roughnesses.
#include "vpm/surface/check_material.h"

#include <fmt/format.h>

#include "vpm/base/overloads.h"
#include "vpm/surface/fresnel.h"

namespace vpm {
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
