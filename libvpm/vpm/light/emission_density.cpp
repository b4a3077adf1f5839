// Emission densities of each kind of light.
#include "vpm/light/emission_density.h"

#include <algorithm>
#include <cassert>

#include "vpm/base/overloads.h"
#include "vpm/light/emitting_volume.h"
#include "vpm/light/kinds.h"

namespace vpm {
namespace {

/// Of lights whose photons start uniformly over an area, by the cosine law.
EmissionDensity of_area(double area, const Vec3& normal, const Vec3& travel) {
  return {1.0 / area, std::max(0.0f, glm::dot(normal, travel)) / kPiD};
}

double area_of_light(const QuadLight& l) { return glm::length(glm::cross(Vec3d(l.edge_u), Vec3d(l.edge_v))); }
double area_of_light(const DiscLight& l) { return kPiD * l.radius * l.radius; }
double area_of_light(const SphereLight& l) { return 4.0 * kPiD * l.radius * l.radius; }
double area_of_light(const MeshLight& l) { return l.mesh->area(); }

}  // namespace

EmissionDensity emission_density(const Light& light, const Box& scene, const Vec3& normal, const Vec3& travel) {
  using D = EmissionDensity;
  return std::visit(
      Overloads{[&](const PointLight&) {
                  return D{1.0, 0.25 / kPiD};
                },
                [&](const SpotLight& l) {
                  return D{1.0, spot_density(l, travel)};
                },
                [&](const BeamLight& l) {
                  return D{1.0, 1.0 / (kPiD * l.radius * l.radius), true};
                },
                [&](const AreaLight auto& l) { return of_area(area_of_light(l), normal, travel); },
                [&](const DirectionalLight& l) {
                  return D{1.0, 1.0 / area_across(scene, l.direction), true};
                },
                [&](const ConstantEnvironment&) {
                  // All lines that meet the box are equally likely: 1 over pi times its surface.
                  const Vec3d faces = face_areas(scene);
                  return D{0.25 / kPiD, 2.0 / (faces.x + faces.y + faces.z), true};
                },
                [&](const EnvironmentMap& l) {  // rounding may put a direction beside its texel
                  return D{std::max(1e-30, double{l.image->pdf(-travel)}), 1.0 / area_across(scene, travel), true};
                },
                [](const VolumeLight&) {
                  assert(!"the line that photons start on is to be given");
                  return D{};
                }},
      light);
}

EmissionDensity emission_density(const Light& medium, const Rgb& arriving) {
  return {1.0, double{mean_channel(arriving)} / std::get<VolumeLight>(medium).volume->bound(), true};
}

double sampled_density(const Light& light, const Vec3& place, const SeenLight& seen) {
  if (!can_be_hit(light)) return 1.0;
  const double pdf = incident_pdf(light, place, seen);
  if (is_infinite(light) || std::holds_alternative<VolumeLight>(light)) return pdf;
  return pdf * std::max(0.0f, -glm::dot(seen.normal, seen.direction)) / (double{seen.distance} * seen.distance);
}

bool can_be_hit(const Light& light) {
  return std::visit(
      Overloads{[](const UnseenLight auto&) { return false; }, [](const AreaLight auto&) { return true; },
                [](const DirectionalLight&) { return false; }, [](const ConstantEnvironment&) { return true; },
                [](const EnvironmentMap&) { return true; }, [](const VolumeLight&) { return true; }},
      light);
}

}  // namespace vpm
