// The closed set of lights: each question goes to the kind of light it is asked of. And the ranges of what lights emit,
// of where they stand and where they point.
#include "vpm/light/light.h"

#include <algorithm>
#include <cassert>

#include "vpm/base/overloads.h"
#include "vpm/light/emitting_volume.h"
#include "vpm/light/kinds.h"

namespace vpm {

Rgb light_power(const Light& light, const Box& scene) {
  return std::visit([&](const auto& l) { return power_of(l, scene); }, light);
}

EmissionNumbers draw_emission_numbers(Rng& rng) {
  return {rng.uniform_double(), rng.uniform_double(), rng.uniform2(), rng.uniform2()};
}

Emission emit(const Light& light, const Box& scene, const EmissionNumbers& u) {
  return std::visit([&](const auto& l) { return emit_from(l, scene, u); }, light);
}

std::optional<Incident> sample_towards(const Light& light, const Vec3& point, Rng& rng) {
  return std::visit([&](const auto& l) { return incident_from(l, point, rng); }, light);
}

std::optional<LightPoint> draw_light_point(const Light& light, Rng& rng) {
  using Point = std::optional<LightPoint>;
  return std::visit(
      Overloads{[](const PointLight& l) { return Point(LightPoint{l.position}); },
                [](const SpotLight& l) { return Point(LightPoint{l.position}); },
                [](const SphereLight& l) { return Point(LightPoint{l.center}); },
                [&](const AreaLight auto& l) { return Point(draw_place(l, rng)); },
                [](const BeamLight&) { return Point(); }, [](const DistantLight auto&) { return Point(); },
                [](const VolumeLight&) { return Point(); }},
      light);
}

std::optional<Incident> sample_towards(const Light& light, const LightPoint& from, const Vec3& point, Rng& rng) {
  if (from.area == 0.0f) return sample_towards(light, point, rng);
  const auto incident = [&](const AreaLight auto& l) { return incident_by_area(l.radiance, from, point); };
  const auto no_area = [](const auto&) -> std::optional<Incident> {
    assert(!"a point with an area is of a light with one");
    return std::nullopt;
  };
  return std::visit(Overloads{incident, no_area}, light);
}

float incident_pdf(const Light& light, const Vec3& point, const SeenLight& seen) {
  return std::visit(Overloads{[](const UnseenLight auto&) { return 0.0f; },
                              [&](const AreaLight auto& l) { return pdf_of(l, point, seen); },
                              [](const DirectionalLight&) { return 0.0f; },
                              [&](const ConstantEnvironment& l) { return pdf_of(l, point, seen); },
                              [&](const EnvironmentMap& l) { return pdf_of(l, point, seen); },
                              [&](const VolumeLight& l) { return pdf_of(l, point, seen); }},
                    light);
}

size_t light_memory_bytes(const Light& light) {
  return std::visit(
      Overloads{[](const MeshLight& l) { return l.mesh->memory_bytes(); },
                [](const EnvironmentMap& l) { return l.image->memory_bytes(); },
                [](const VolumeLight& l) { return l.volume->memory_bytes(); }, [](const auto&) { return size_t{0}; }},
      light);
}

std::string_view light_kind(const Light& light) {
  return std::visit(
      Overloads{[](const PointLight&) { return "point"; }, [](const SpotLight&) { return "spot"; },
                [](const BeamLight&) { return "beam"; }, [](const QuadLight&) { return "quad"; },
                [](const DiscLight&) { return "disc"; }, [](const SphereLight&) { return "sphere"; },
                [](const MeshLight&) { return "mesh"; }, [](const DirectionalLight&) { return "directional"; },
                [](const ConstantEnvironment&) { return "constant environment"; },
                [](const EnvironmentMap&) { return "environment map"; }, [](const VolumeLight&) { return "medium"; }},
      light);
}

bool is_grey(const Light& light) {
  return std::visit(Overloads{[](const PointLight& l) { return is_grey(l.intensity); },
                              [](const SpotLight& l) { return is_grey(l.intensity); },
                              [](const BeamLight& l) { return is_grey(l.power); },
                              [](const QuadLight& l) { return is_grey(l.radiance); },
                              [](const DiscLight& l) { return is_grey(l.radiance); },
                              [](const SphereLight& l) { return is_grey(l.radiance); },
                              [](const MeshLight& l) { return is_grey(l.radiance); },
                              [](const DirectionalLight& l) { return is_grey(l.irradiance); },
                              [](const ConstantEnvironment& l) { return is_grey(l.radiance); },
                              [](const EnvironmentMap& l) { return l.image->grey(); },
                              [](const VolumeLight& l) { return l.volume->grey(); }},
                    light);
}

bool is_infinite(const Light& light) {
  return std::visit(
      Overloads{[](const UnseenLight auto&) { return false; }, [](const AreaLight auto&) { return false; },
                [](const DistantLight auto&) { return true; }, [](const VolumeLight&) { return false; }},
      light);
}

std::optional<Rgb> even_radiance(const Light& light) {
  using Radiance = std::optional<Rgb>;
  return std::visit(
      Overloads{[](const UnseenLight auto&) { return Radiance(); }, [](const AreaLight auto&) { return Radiance(); },
                [](const DirectionalLight&) { return Radiance(); },
                [](const ConstantEnvironment& l) { return Radiance(l.radiance); },
                [](const EnvironmentMap&) { return Radiance(); }, [](const VolumeLight&) { return Radiance(); }},
      light);
}

std::optional<LightPlace> light_place(const Light& light) {
  using Place = std::optional<LightPlace>;
  return std::visit(Overloads{[](const UnseenLight auto& l) { return Place(place_of(l)); },
                              [](const AreaLight auto& l) { return Place(place_of(l)); },
                              [](const DistantLight auto&) { return Place(); },
                              [](const VolumeLight& l) { return Place(place_of(l)); }},
                    light);
}

Rgb environment_radiance(const Light& light, const Vec3& direction) {
  return std::visit(
      Overloads{[](const UnseenLight auto&) { return Rgb(0.0f); }, [](const AreaLight auto&) { return Rgb(0.0f); },
                [](const DirectionalLight&) { return Rgb(0.0f); },
                [](const ConstantEnvironment& l) { return l.radiance; },
                [&](const EnvironmentMap& l) { return l.image->radiance(direction); },
                [](const VolumeLight&) { return Rgb(0.0f); }},
      light);
}

Rgb surface_radiance(const Light& light, const Vec3& normal, const Vec3& travel) {
  if (glm::dot(normal, travel) >= 0.0f) return Rgb(0.0f);
  return std::visit(
      Overloads{[](const UnseenLight auto&) { return Rgb(0.0f); }, [](const AreaLight auto& l) { return l.radiance; },
                [](const DistantLight auto&) { return Rgb(0.0f); }, [](const VolumeLight&) { return Rgb(0.0f); }},
      light);
}

namespace {

/// The first clause that says something.
std::string first_of(std::initializer_list<std::string> clauses) {
  const auto found = std::find_if(clauses.begin(), clauses.end(), [](const std::string& c) { return !c.empty(); });
  return found == clauses.end() ? "" : *found;
}

std::string emitted_problem(const std::string& name, const Rgb& emitted) {
  if (!is_finite(emitted) || std::min({emitted.r, emitted.g, emitted.b}) < 0.0f)
    return "its " + name + " must be at least 0 and finite";
  return is_black(emitted) ? "its " + name + " is 0: it emits nothing" : "";
}

std::string position_problem(const Vec3& position) { return is_finite(position) ? "" : "its position must be finite"; }

std::string direction_problem(const Vec3& direction) {
  constexpr float kRounding = 1e-4f;
  return std::abs(glm::length(direction) - 1.0f) < kRounding ? "" : "its direction must be a unit vector";
}

std::string radius_problem(float radius) {
  return radius > 0.0f && std::isfinite(radius) ? "" : "its radius must be positive and finite";
}

std::string cone_problem(const SpotLight& l) {
  const bool in_order = l.cos_inner <= 1.0f && l.cos_inner >= l.cos_outer && l.cos_outer >= -1.0f;
  if (!in_order) return "the cosines of its cones must lie in [-1, 1], the inner one's not below the outer one's";
  return l.cos_outer < 1.0f ? "" : "its outer cone must be open: a beam light is the narrow one";
}

}  // namespace

std::string problem_of(const Light& light) {
  return std::visit(
      Overloads{[](const PointLight& l) {
                  return first_of({position_problem(l.position), emitted_problem("intensity", l.intensity)});
                },
                [](const SpotLight& l) {
                  return first_of({position_problem(l.position), direction_problem(l.direction), cone_problem(l),
                                   emitted_problem("intensity", l.intensity)});
                },
                [](const BeamLight& l) {
                  return first_of({position_problem(l.position), direction_problem(l.direction),
                                   radius_problem(l.radius), emitted_problem("power", l.power)});
                },
                [](const AreaLight auto& l) { return emitted_problem("radiance", l.radiance); },
                [](const DirectionalLight& l) {
                  return first_of({direction_problem(l.direction), emitted_problem("irradiance", l.irradiance)});
                },
                [](const ConstantEnvironment& l) { return emitted_problem("radiance", l.radiance); },
                [](const EnvironmentMap& l) { return std::string(l.image ? "" : "it lacks its picture"); },
                [](const VolumeLight&) { return std::string("a medium that emits is no light of a list"); }},
      light);
}

}  // namespace vpm
