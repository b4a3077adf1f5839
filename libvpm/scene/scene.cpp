// What a scene derives from its parts, and which medium fills a point.
#include "scene/scene.h"

#include <algorithm>
#include <cassert>

#include "base/error.h"

namespace vpm {

namespace {

/// Directions of no symmetry, so that they do not run along the faces and edges that scenes are made of.
const Vec3 kProbes[] = {glm::normalize(Vec3(0.5470f, 0.7316f, 0.4071f)),
                        glm::normalize(Vec3(-0.6133f, 0.3319f, 0.7168f)),
                        glm::normalize(Vec3(0.2843f, -0.8429f, -0.4567f))};

MediumId medium_along(const Scene& scene, const Vec3& point, const Vec3& direction) {
  Ray ray{point, direction};
  while (const std::optional<Hit> hit = scene.geometry.intersect(ray)) {
    const Shape& shape = scene.shapes[hit->shape];
    if (shape.separates_media)
      return glm::dot(direction, hit->normal) > 0.0f ? shape.media.inside : shape.media.outside;
    ray.origin = leave_surface(*hit, direction);
  }
  return scene.world_medium;
}

SceneSphere bounding_sphere(const Box& box) {
  if (box.empty()) return {Vec3(0.0f), 1.0f};
  // A little larger than the box, so that light from infinity starts outside in spite of rounding.
  const float reach = glm::length(glm::max(glm::abs(box.lo), glm::abs(box.hi)));
  return {box.centre(), 0.5f * box.diagonal() + 1e-6f * reach};
}

bool all_grey(const Scene& scene) {
  return std::all_of(scene.lights.begin(), scene.lights.end(), [](const Light& l) { return is_grey(l); }) &&
         std::all_of(scene.media.begin(), scene.media.end(), [](const Medium& m) { return m.grey(); }) &&
         std::all_of(scene.materials.begin(), scene.materials.end(), [](const Material& m) { return is_grey(m); });
}

std::vector<float> probability_by_power(const std::vector<Light>& lights, const SceneSphere& sphere) {
  std::vector<double> power;
  double total = 0.0;
  for (const Light& light : lights) total += power.emplace_back(mean_channel(light_power(light, sphere)));
  if (lights.empty()) return {};
  if (!(total > 0.0) || std::isinf(total)) {
    throw InputError("lights: their power is " + std::to_string(total) + " W in all, it must be positive and finite");
  }
  std::vector<float> probability;
  probability.reserve(power.size());
  for (const double p : power) probability.push_back(static_cast<float>(p / total));
  return probability;
}

/// A point of a finite light, for area lights just before their surface.
Vec3 point_before(const Light& light) {
  if (const auto* l = std::get_if<PointLight>(&light)) return l->position;
  if (const auto* l = std::get_if<SpotLight>(&light)) return l->position;
  if (const auto* l = std::get_if<BeamLight>(&light)) return l->position;
  if (const auto* l = std::get_if<QuadLight>(&light)) {
    const Vec3 across = glm::cross(l->edge_u, l->edge_v);
    const Vec3 normal = glm::normalize(across);
    const Vec3 reach = glm::abs(l->edge_u) + glm::abs(l->edge_v);
    return leave_surface_at(l->corner + 0.5f * (l->edge_u + l->edge_v), normal, normal,
                            flat_slack(normal, reach, glm::length(across)));
  }
  const auto& l = std::get<SphereLight>(light);
  const SphereShape shape{l.centre, l.radius};
  const Vec3 normal = kProbes[0];
  return leave_surface_at(point_on(shape, normal), normal, normal, sphere_slack(shape));
}

}  // namespace

void finish(Scene& scene) {
  assert(scene.light_probability.empty() && scene.light_medium.empty());
  scene.sphere = bounding_sphere(scene.geometry.bounds());
  scene.grey = all_grey(scene);
  scene.light_probability = probability_by_power(scene.lights, scene.sphere);
  for (const Light& light : scene.lights) {
    scene.light_medium.push_back(is_infinite(light) ? scene.world_medium : medium_at(scene, point_before(light)));
  }
}

MediumId medium_at(const Scene& scene, const Vec3& point) {
  const MediumId a = medium_along(scene, point, kProbes[0]);
  const MediumId b = medium_along(scene, point, kProbes[1]);
  const MediumId c = medium_along(scene, point, kProbes[2]);
  return b == c ? b : a;
}

}  // namespace vpm
