// The closed set of lights: each question goes to the kind of light it is asked of.
#include "light/light.h"

#include "base/overloads.h"
#include "light/kinds.h"

namespace vpm {

Rgb light_power(const Light& light, const Box& scene) {
  return std::visit([&](const auto& l) { return power_of(l, scene); }, light);
}

Emission emit(const Light& light, const Box& scene, Rng& rng) {
  return std::visit([&](const auto& l) { return emit_from(l, scene, rng); }, light);
}

std::optional<Incident> sample_towards(const Light& light, const Vec3& point, Rng& rng) {
  return std::visit([&](const auto& l) { return incident_from(l, point, rng); }, light);
}

float incident_pdf(const Light& light, const Vec3& point, const SeenLight& seen) {
  return std::visit(
      [&](const auto& l) {
        if constexpr (requires { pdf_of(l, point, seen); })
          return pdf_of(l, point, seen);
        else
          return 0.0f;
      },
      light);
}

std::string_view light_kind(const Light& light) {
  return std::visit(
      Overloads{[](const PointLight&) { return "point"; }, [](const SpotLight&) { return "spot"; },
                [](const BeamLight&) { return "beam"; }, [](const QuadLight&) { return "quad"; },
                [](const DiscLight&) { return "disc"; }, [](const SphereLight&) { return "sphere"; },
                [](const MeshLight&) { return "mesh"; }, [](const DirectionalLight&) { return "directional"; },
                [](const ConstantEnvironment&) { return "constant environment"; },
                [](const EnvironmentMap&) { return "environment map"; }},
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
                              [](const EnvironmentMap& l) { return l.image->grey(); }},
                    light);
}

bool is_infinite(const Light& light) {
  return std::holds_alternative<DirectionalLight>(light) || std::holds_alternative<ConstantEnvironment>(light) ||
         std::holds_alternative<EnvironmentMap>(light);
}

Rgb environment_radiance(const Light& light, const Vec3& direction) {
  if (const auto* constant = std::get_if<ConstantEnvironment>(&light)) return constant->radiance;
  if (const auto* map = std::get_if<EnvironmentMap>(&light)) return map->image->radiance(direction);
  return Rgb(0.0f);
}

Rgb surface_radiance(const Light& light, const Vec3& normal, const Vec3& travel) {
  if (glm::dot(normal, travel) >= 0.0f) return Rgb(0.0f);
  if (const auto* quad = std::get_if<QuadLight>(&light)) return quad->radiance;
  if (const auto* disc = std::get_if<DiscLight>(&light)) return disc->radiance;
  if (const auto* sphere = std::get_if<SphereLight>(&light)) return sphere->radiance;
  if (const auto* mesh = std::get_if<MeshLight>(&light)) return mesh->radiance;
  return Rgb(0.0f);
}

}  // namespace vpm
