// Light from surfaces that emit the same radiance from every point of their fronts: parallelograms, discs, spheres,
// meshes. Points are drawn by area, and densities turned to solid angle.
#include <algorithm>
#include <cassert>

#include "vpm/base/error.h"
#include "vpm/base/warp.h"
#include "vpm/light/kinds.h"
#include "vpm/surface/locate.h"
#include "vpm/surface/mesh.h"

namespace vpm {

std::optional<Incident> incident_by_area(const Rgb& radiance, const LightPoint& from, const Vec3& point) {
  const Vec3 towards = from.position - point;
  const float facing = -glm::dot(from.normal, towards);  // cosine * distance
  if (!(facing > 0.0f)) return std::nullopt;
  const float square = glm::dot(towards, towards), distance = std::sqrt(square);
  const float pdf = square * distance / (from.area * facing);
  return Incident{towards / distance, distance, radiance / pdf, pdf, from.normal};
}

float pdf_by_area(float area, const SeenLight& seen) {
  const float facing = -area * glm::dot(seen.normal, seen.direction);
  return facing > 0.0f ? seen.distance * seen.distance / facing : 0.0f;
}

namespace {

/// cross(edge_u, edge_v): its length is the area, m^2.
Vec3d area_vector(const QuadLight& light) { return glm::cross(Vec3d(light.edge_u), Vec3d(light.edge_v)); }

float area_of(const QuadLight& light) { return static_cast<float>(glm::length(area_vector(light))); }

Vec3 uniform_point(const QuadLight& light, const Vec2& u) {
  return Vec3(Vec3d(light.corner) + double{u.x} * Vec3d(light.edge_u) + double{u.y} * Vec3d(light.edge_v));
}

/// The largest distance along each axis from `p` to a corner, m.
Vec3 reach_from(const QuadLight& light, const Vec3& p) {
  const Vec3 a = light.corner - p, b = a + light.edge_u, c = a + light.edge_v, d = b + light.edge_v;
  return glm::max(glm::max(glm::abs(a), glm::abs(b)), glm::max(glm::abs(c), glm::abs(d)));
}

}  // namespace

Rgb power_of(const QuadLight& light, const Box&) { return kPi * area_of(light) * light.radiance; }

Emission emit_from(const QuadLight& light, const Box& scene, const EmissionNumbers& u) {
  const Vec3d across = area_vector(light);
  const Vec3 normal(glm::normalize(across));
  const Vec3 p = uniform_point(light, u.place);
  const Vec3 direction = cosine_hemisphere(normal, u.direction);
  const float slack = flat_slack(normal, reach_from(light, p), glm::length(across));
  return {Ray{leave_surface_at(p, normal, direction, slack), direction}, power_of(light, scene), normal};
}

std::optional<Incident> incident_from(const QuadLight& light, const Vec3& point, Rng& rng) {
  return incident_by_area(light.radiance, draw_place(light, rng), point);
}

LightPoint draw_place(const QuadLight& light, Rng& rng) {
  return {uniform_point(light, rng.uniform2()), Vec3(glm::normalize(area_vector(light))), area_of(light)};
}

float pdf_of(const QuadLight& light, const Vec3&, const SeenLight& seen) { return pdf_by_area(area_of(light), seen); }

LightPlace place_of(const QuadLight& light) {
  Box box;
  for (const Vec3& p : {Vec3(0.0f), light.edge_u, light.edge_v, light.edge_u + light.edge_v}) box.add(light.corner + p);
  const Vec3d across = area_vector(light);
  const Vec3 normal(glm::normalize(across)), middle = uniform_point(light, Vec2(0.5f));
  const float slack = flat_slack(normal, reach_from(light, middle), glm::length(across));
  return {box, leave_surface_at(middle, normal, normal, slack)};
}

namespace {

float area_of(const DiscLight& light) { return kPi * light.radius * light.radius; }

/// In the disc's plane to the rounding of its coordinates, which that of the frame about the normal would exceed.
Vec3 uniform_point(const DiscLight& light, const Vec2& u) {
  const Vec3d from_center(point_on_disc(Vec3(0.0f), light.normal, light.radius, u)), normal(light.normal);
  const double off = glm::dot(from_center, normal) / glm::dot(normal, normal);
  return Vec3(Vec3d(light.center) + from_center - off * normal);
}

}  // namespace

Rgb power_of(const DiscLight& light, const Box&) { return kPi * area_of(light) * light.radiance; }

Emission emit_from(const DiscLight& light, const Box& scene, const EmissionNumbers& u) {
  const Vec3 p = uniform_point(light, u.place);
  const Vec3 direction = cosine_hemisphere(light.normal, u.direction);
  const float slack = disc_slack({light.center, light.normal, light.radius});
  return {Ray{leave_surface_at(p, light.normal, direction, slack), direction}, power_of(light, scene), light.normal};
}

std::optional<Incident> incident_from(const DiscLight& light, const Vec3& point, Rng& rng) {
  return incident_by_area(light.radiance, draw_place(light, rng), point);
}

LightPoint draw_place(const DiscLight& light, Rng& rng) {
  return {uniform_point(light, rng.uniform2()), light.normal, area_of(light)};
}

float pdf_of(const DiscLight& light, const Vec3&, const SeenLight& seen) { return pdf_by_area(area_of(light), seen); }

LightPlace place_of(const DiscLight& light) {
  const DiscShape shape{light.center, light.normal, light.radius};
  return {bounds_of(shape), leave_surface_at(light.center, light.normal, light.normal, disc_slack(shape))};
}

namespace {

/// 1 - cosine of the cone in which the sphere is seen from a point at that distance from its center; 0 from inside.
float cone_of(const SphereLight& light, double distance) {
  const double sine = light.radius / distance;
  return sine < 1.0 ? static_cast<float>(sine * sine / (1.0 + std::sqrt((1.0 - sine) * (1.0 + sine)))) : 0.0f;
}

}  // namespace

Rgb power_of(const SphereLight& light, const Box&) {
  return 4.0f * kPi * kPi * light.radius * light.radius * light.radiance;
}

Emission emit_from(const SphereLight& light, const Box& scene, const EmissionNumbers& u) {
  const Vec3 normal = uniform_sphere(u.place);
  const Vec3 direction = cosine_hemisphere(normal, u.direction);
  const SphereShape shape{light.center, light.radius};
  const Vec3 origin = leave_surface_at(point_on(shape, normal), normal, direction, sphere_slack(shape));
  return {Ray{origin, direction}, power_of(light, scene), normal};
}

std::optional<Incident> incident_from(const SphereLight& light, const Vec3& point, Rng& rng) {
  const Vec3d to_center = Vec3d(light.center) - Vec3d(point);
  const double distance = glm::length(to_center);
  const float away = cone_of(light, distance);
  if (away == 0.0f) return std::nullopt;
  const Vec3 direction = uniform_cone(Vec3(to_center / distance), away, rng.uniform2());
  const double along = glm::dot(to_center, Vec3d(direction));
  const Vec3d off_axis = to_center - along * Vec3d(direction);
  // At the cone's rim rounding may carry the direction past the sphere: there the chord is 0.
  const double half_chord =
      std::sqrt(std::max(0.0, double{light.radius} * light.radius - glm::dot(off_axis, off_axis)));
  const float pdf = 1.0f / (2.0f * kPi * away);
  const Vec3 normal(glm::normalize((along - half_chord) * Vec3d(direction) - to_center));
  return Incident{direction, static_cast<float>(along - half_chord), light.radiance / pdf, pdf, normal};
}

float pdf_of(const SphereLight& light, const Vec3& point, const SeenLight&) {
  const float away = cone_of(light, glm::length(Vec3d(light.center) - Vec3d(point)));
  return away > 0.0f ? 1.0f / (2.0f * kPi * away) : 0.0f;
}

LightPlace place_of(const SphereLight& light) {
  const SphereShape shape{light.center, light.radius};
  const Vec3 normal = glm::normalize(Vec3(0.5470f, 0.7316f, 0.4071f));  // of no symmetry, away from others' edges
  return {{light.center - light.radius, light.center + light.radius},
          leave_surface_at(point_on(shape, normal), normal, normal, sphere_slack(shape))};
}

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
