// The shapes of a scene: each looked at for each ray where they are few, found by Embree where they are many.
#include "vpm/surface/geometry.h"

#include <algorithm>
#include <cassert>
#include <span>
#include <variant>

#include "vpm/surface/check_shapes.h"
#include "vpm/surface/geometry_impl.h"
#include "vpm/surface/mesh.h"

namespace vpm {

Geometry::Geometry() : impl_(std::make_unique<Impl>()) {}
Geometry::~Geometry() = default;
Geometry::Geometry(Geometry&&) noexcept = default;
Geometry& Geometry::operator=(Geometry&&) noexcept = default;

uint32_t Geometry::add(const TriangleMesh& mesh, Layer layer) {
  assert(!impl_->committed);
  const std::vector<glm::uvec3> proper = checked_triangles(mesh);
  auto& shape =
      std::get<MeshShape>(impl_->shapes.emplace_back(MeshShape{nullptr, nullptr, {}, mesh.normals, mesh.uvs}));
  impl_->tree.add(shape, mesh.positions, proper, layer);
  double area = 0.0;
  Box box;
  shape.planes.reserve(proper.size());
  for (const glm::uvec3& v : proper) {
    const Vec3* const positions = shape.positions;
    const Vec3d across = area_vector(positions[v.x], positions[v.y], positions[v.z]);
    const double twice_area = glm::length(across);
    const Vec3d normal = across / twice_area;
    shape.planes.push_back({normal, glm::dot(normal, Vec3d(positions[v.x]))});
    area += 0.5 * twice_area;
    for (int corner = 0; corner < 3; ++corner) box.add(positions[v[corner]]);
  }
  for (Vec3& normal : shape.normals) normal = Vec3(glm::normalize(Vec3d(normal)));
  impl_->bytes += shape.planes.size() * sizeof(TrianglePlane) + shape.normals.size() * sizeof(Vec3) +
                  shape.uvs.size() * sizeof(Vec2);
  return impl_->note(area, box, layer);
}

template <class S>
uint32_t Geometry::Impl::add_own(const S& shape, double area, Layer layer) {
  assert(!committed);
  tree.add(std::get<S>(shapes.emplace_back(shape)), layer);
  return note(area, bounds_of(shape), layer);
}

uint32_t Geometry::add(const SphereShape& sphere, Layer layer) {
  check_round("sphere", sphere.center, sphere.radius);
  return impl_->add_own(sphere, 4.0 * kPiD * double{sphere.radius} * sphere.radius, layer);
}

uint32_t Geometry::add(const DiscShape& disc, Layer layer) {
  check_round("disc", disc.center, disc.radius);
  assert(std::abs(glm::length(disc.normal) - 1.0f) < 1e-5f);
  return impl_->add_own(disc, kPiD * double{disc.radius} * disc.radius, layer);
}

/// Decides how rays are to look for shapes.
void Geometry::Impl::lay_out() {
  constexpr size_t kTrianglesForOne = 8;  // a sphere or disc takes as long
  size_t all = 0;
  for (uint32_t shape = 0; shape < shapes.size(); ++shape) {
    const auto* mesh = std::get_if<MeshShape>(&shapes[shape]);
    all += mesh ? mesh->planes.size() : kTrianglesForOne;
  }
  is_small = all <= FewTriangles::kMost;
  if (!is_small) return;
  for (uint32_t shape = 0; shape < shapes.size(); ++shape) {
    if (const auto* mesh = std::get_if<MeshShape>(&shapes[shape]))
      few.add(*mesh, shape, bit(layers[shape]));
    else
      spheres_and_discs.push_back({&shapes[shape], shape, bit(layers[shape])});
  }
  bytes += few.memory_bytes();
}

void Geometry::Impl::look_at_all(Query& query, uint32_t layers_seen) const {
  few.visit(query.ray, layers_seen, [&](const MeshShape& mesh, uint32_t shape, uint32_t triangle) {
    if (!query.leaves_out(shape)) query.take(crossing(mesh, triangle, query.ray), shape, triangle);
  });
  for (const auto& [data, shape, layer] : spheres_and_discs) {
    if ((layer & layers_seen) == 0 || query.leaves_out(shape)) continue;
    if (const auto* sphere = std::get_if<SphereShape>(data)) query.take(crossing(*sphere, query.ray), shape, 0);
    if (const auto* disc = std::get_if<DiscShape>(data)) query.take(crossing(*disc, query.ray), shape, 0);
  }
}

void Geometry::commit() {
  impl_->tree.commit();
  impl_->around = bounds();
  impl_->lay_out();
  impl_->committed = true;
}

std::optional<Hit> Geometry::intersect(const Ray& ray, float t_max) const {
  return first(ray, t_max, kAllLayers, {}).hit;
}

std::optional<Hit> Geometry::intersect_surface(const Ray& ray, float t_max) const {
  return first(ray, t_max, kAllLayers & ~bit(Layer::boundary), {}).hit;
}

bool Geometry::is_near(const Vec3& point, float radius) const {
  assert(impl_->committed && is_finite(point));
  return impl_->tree.is_near(point, radius);
}

Geometry::First Geometry::first(const Ray& ray, float t_max, uint32_t layers, std::span<const Hit> without) const {
  assert(impl_->committed);
  assert(is_finite(ray.origin) && is_finite(ray.direction));
  if (!(t_max > kMinT)) return {};
  if (impl_->is_left_by(ray)) return {{}, t_max};
  Query query(ray, t_max, impl_->size, without);
  if (impl_->is_small)
    impl_->look_at_all(query, layers);
  else
    impl_->tree.look_along(query, layers);
  First met;
  met.others = std::min(query.others, query.limit);
  if (std::isinf(query.t)) return met;
  Hit& hit = met.hit.emplace();
  hit.t = query.t;
  hit.shape = query.shape;
  const ShapeData& shape = impl_->shapes[hit.shape];
  if (const auto* mesh = std::get_if<MeshShape>(&shape)) locate(*mesh, query.triangle, ray, query.nearest, hit);
  if (const auto* sphere = std::get_if<SphereShape>(&shape)) locate(*sphere, ray, query.nearest, hit);
  if (const auto* disc = std::get_if<DiscShape>(&shape)) locate(*disc, ray, query.nearest, hit);
  return met;
}

Box Geometry::bounds() const {
  Box all;
  for (const Box& box : impl_->bounds) all.add(box);
  return all;
}

const Box& Geometry::bounds(uint32_t shape) const { return impl_->bounds[shape]; }

Vec2 Geometry::uv(const Hit& hit) const {
  assert(has_uvs(hit.shape));
  const auto* mesh = std::get_if<MeshShape>(&impl_->shapes[hit.shape]);
  return mesh ? interpolated(mesh->uvs, mesh->triangles[hit.triangle], hit.barycentric) : sphere_uv(hit.normal);
}

bool Geometry::has_uvs(uint32_t shape) const {
  const auto* mesh = std::get_if<MeshShape>(&impl_->shapes[shape]);
  return mesh ? !mesh->uvs.empty() : std::holds_alternative<SphereShape>(impl_->shapes[shape]);
}

std::optional<SphereShape> Geometry::sphere(uint32_t shape) const {
  const auto* sphere = std::get_if<SphereShape>(&impl_->shapes[shape]);
  return sphere ? std::optional(*sphere) : std::nullopt;
}

size_t Geometry::triangle_count(uint32_t shape) const {
  const auto* mesh = std::get_if<MeshShape>(&impl_->shapes[shape]);
  return mesh ? mesh->planes.size() : 0;
}

Hit Geometry::point_of_triangle(uint32_t shape, uint32_t triangle, const Vec2& barycentric) const {
  assert(triangle < triangle_count(shape));
  Hit hit;
  hit.shape = shape;
  locate(std::get<MeshShape>(impl_->shapes[shape]), triangle, barycentric, hit);
  return hit;
}

double Geometry::area(uint32_t shape) const {
  assert(shape < impl_->areas.size());
  return impl_->areas[shape];
}

size_t Geometry::memory_bytes() const { return impl_->tree.memory_bytes() + impl_->bytes; }

}  // namespace vpm
