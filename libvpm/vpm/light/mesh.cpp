// Triangles that emit the same radiance from every point of their fronts.
#include <algorithm>
#include <cassert>

#include "vpm/base/error.h"
#include "vpm/base/warp.h"
#include "vpm/light/kinds.h"
#include "vpm/surface/mesh.h"

namespace vpm {

namespace {

float area_of(const MeshLight& light) { return static_cast<float>(light.mesh->area()); }

}  // namespace

EmittingMesh::EmittingMesh(TriangleMesh mesh) : mesh_(std::move(mesh)) {
  cumulative_.reserve(mesh_.triangles.size() + 1);
  cumulative_.push_back(0.0);
  const auto& p = mesh_.positions;
  for (const glm::uvec3& v : mesh_.triangles) {
    assert(std::max(v.x, std::max(v.y, v.z)) < p.size());
    cumulative_.push_back(cumulative_.back() + 0.5 * glm::length(area_vector(p[v.x], p[v.y], p[v.z])));
  }
  if (!(area() > 0.0)) throw InputError("mesh light: no triangle has an area, at least one must");
}

EmittingMesh::Sample EmittingMesh::sample(double choice, const Vec2& u) const {
  const double target = choice * area();
  const auto above = std::upper_bound(cumulative_.begin() + 1, cumulative_.end(), target);
  assert(above != cumulative_.end());
  const glm::uvec3& v = mesh_.triangles[static_cast<size_t>(above - cumulative_.begin() - 1)];
  const Vec3 &a = mesh_.positions[v.x], &b = mesh_.positions[v.y], &c = mesh_.positions[v.z];
  // Uniform over the triangle: the distance from the corner a as the square root, then across.
  const double away = std::sqrt(double{u.x}), to_c = away * u.y;
  const Vec3 p((1.0 - away) * Vec3d(a) + (away - to_c) * Vec3d(b) + to_c * Vec3d(c));
  const Vec3d across = area_vector(a, b, c);
  const double twice_area = glm::length(across);
  const Vec3 normal(across / twice_area);
  const Vec3 reach = glm::max(glm::max(glm::abs(a - p), glm::abs(b - p)), glm::abs(c - p));
  return {p, normal, flat_slack(normal, reach, twice_area)};
}

Box EmittingMesh::bounds() const {
  Box box;
  for (const glm::uvec3& v : mesh_.triangles)
    for (int corner = 0; corner < 3; ++corner) box.add(mesh_.positions[v[corner]]);
  return box;
}

Rgb power_of(const MeshLight& light, const Box&) { return kPi * area_of(light) * light.radiance; }

Emission emit_from(const MeshLight& light, const Box& scene, const EmissionNumbers& u) {
  const EmittingMesh::Sample from = light.mesh->sample(u.choice, u.place);
  const Vec3 direction = cosine_hemisphere(from.normal, u.direction);
  return {Ray{leave_surface_at(from.position, from.normal, direction, from.slack), direction}, power_of(light, scene),
          from.normal};
}

std::optional<Incident> incident_from(const MeshLight& light, const Vec3& point, Rng& rng) {
  return incident_by_area(light.radiance, draw_place(light, rng), point);
}

LightPoint draw_place(const MeshLight& light, Rng& rng) {
  const double choice = rng.uniform_double();
  const EmittingMesh::Sample from = light.mesh->sample(choice, rng.uniform2());
  return {from.position, from.normal, area_of(light)};
}

float pdf_of(const MeshLight& light, const Vec3&, const SeenLight& seen) { return pdf_by_area(area_of(light), seen); }

LightPlace place_of(const MeshLight& light) {
  Rng rng(0, rng_stream(RngUse::probe, 0), 0);
  const double choice = rng.uniform_double();
  const EmittingMesh::Sample at = light.mesh->sample(choice, rng.uniform2());
  return {light.mesh->bounds(), leave_surface_at(at.position, at.normal, at.normal, at.slack)};
}

}  // namespace vpm
