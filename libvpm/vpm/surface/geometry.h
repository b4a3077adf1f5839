// Where rays meet shapes. Embree finds what a ray may meet in large scenes, and our own arithmetic decides what it
// meets. Every offset of a ray's origin is made in this folder.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "vpm/base/vec.h"

namespace vpm {

/// Triangles; counter-clockwise seen from outside, so that (b - a) x (c - a) is the outward normal.
struct TriangleMesh {
  std::vector<Vec3> positions;  // m
  std::vector<glm::uvec3> triangles;
  std::vector<Vec3> normals{};  // of the vertices, of any length except 0, for shading; empty: the triangles' own
  std::vector<Vec2> uvs{};      // texture coordinates of the vertices; empty: none
};
struct SphereShape {
  Vec3 center{0.0f};    // m
  float radius = 1.0f;  // m, > 0
};
/// One flat disc.
struct DiscShape {
  Vec3 center{0.0f};              // m
  Vec3 normal{0.0f, 1.0f, 0.0f};  // unit, outward
  float radius = 1.0f;            // m, > 0
};

/// The point where a ray meets a shape.
struct Hit {
  float t = 0.0f;       // m along the ray
  uint32_t shape = 0;   // as returned by add()
  Vec3 position{0.0f};  // m, on the surface up to the rounding of its coordinates
  Vec3 normal{0.0f};    // unit, outward, geometric: not turned towards the ray
  float slack = 0.0f;   // m: how far rounding may displace the surface from `position` in later queries
  /// Unit. Interpolated between the normals of the vertices, and turned to the side of `normal` if it points to the
  /// other side. Equal to `normal` if the shape has no normals of vertices or if they cancel.
  Vec3 shading_normal{0.0f};
  uint32_t triangle = 0;   // of a mesh, numbered without the triangles that add() left out
  Vec2 barycentric{0.0f};  // of a mesh: the weights of the triangle's second and third vertex
};

/// How a shape acts on a ray. `surface` scatters light and has the same medium on both sides. `dividing_surface`
/// scatters light and has different media on its two sides. `boundary` lies between media, and light passes it. `pane`
/// and `interface` are a surface and a dividing surface of a dielectric: part of the light goes through.
enum class Layer : uint32_t { surface = 1, dividing_surface = 2, boundary = 4, pane = 8, interface = 16 };

/// The hits of a ray at one place; none if the ray meets nothing. Boundaries are in the order of distance. A surface
/// that coincides with them comes first, though rounding may put it behind them.
struct Encounter {
  static constexpr int kMost = 4;
  std::array<Hit, kMost> hits;
  int count = 0;
  bool surface = false;  // the first hit is of a surface: the ray goes no further

  explicit operator bool() const { return count > 0; }
};

/// Shapes of the scene. Add all, then commit(); from then on it is immutable and all queries are thread-safe.
/// Failures of Embree itself (out of memory) throw std::runtime_error.
class Geometry {
 public:
  Geometry();
  ~Geometry();
  Geometry(Geometry&&) noexcept;
  Geometry& operator=(Geometry&&) noexcept;

  /// Adds a shape and returns its number: 0, 1, 2, ... Triangles without area are left out, as no ray can meet them.
  /// Throws InputError if no triangle of a mesh has an area, if a triangle names a vertex that does not exist,
  /// and if coordinates or radii are not finite or beyond 1e9 m, or radii are not positive. Also throws if there are
  /// not as many normals or uvs as vertices, if one is not finite, if a normal is zero, or if a uv is beyond 1e6.
  uint32_t add(const TriangleMesh& mesh, Layer layer = Layer::surface);
  uint32_t add(const SphereShape& sphere, Layer layer = Layer::surface);
  uint32_t add(const DiscShape& disc, Layer layer = Layer::surface);
  void commit();

  /// The nearest hit with 0 < t < t_max, seen from either side. Allocates nothing.
  std::optional<Hit> intersect(const Ray& ray, float t_max = kInfinity) const;

  /// The nearest hit of a shape that is no boundary.
  std::optional<Hit> intersect_surface(const Ray& ray, float t_max) const;
  /// Does any shape come within `radius` (m) of a point?
  bool is_near(const Vec3& point, float radius) const;

  /// What the ray meets at one place: the nearest hit and, if that is a boundary, all others within the distance by
  /// which the ray is moved off it. A surface among them stops the ray, so that smoke can stand on a floor. Where a
  /// dielectric coincides with another surface they are in optical contact: that surface is met from within the
  /// dielectric, whose own face there is none. So glass can stand on a table.
  Encounter encounter(const Ray& ray, float t_max = kInfinity) const;
  /// The same, but only of shapes between media, and none of them stops the ray: for finding out which medium is where.
  Encounter division(const Ray& ray) const;
  /// The same of all shapes, and none of them stops the ray: for finding out which of them coincide.
  Encounter faces(const Ray& ray) const;

  /// The box around all shapes; empty without any.
  Box bounds() const;
  /// The box around one shape.
  const Box& bounds(uint32_t shape) const;
  /// The texture coordinates of a hit on a shape that has them.
  Vec2 uv(const Hit& hit) const;
  /// Does a shape have texture coordinates? Spheres and meshes with uvs do.
  bool has_uvs(uint32_t shape) const;
  /// The shape as a sphere; nothing if it is another kind of shape.
  std::optional<SphereShape> sphere(uint32_t shape) const;
  /// How many triangles a shape has, counted as in Hit::triangle; 0 where it is no mesh.
  size_t triangle_count(uint32_t shape) const;
  /// The point of a mesh with these barycentric coordinates, as a ray finds it up to rounding; `t` is 0.
  Hit point_of_triangle(uint32_t shape, uint32_t triangle, const Vec2& barycentric) const;
  /// The area of a shape, m^2.
  double area(uint32_t shape) const;
  /// The memory that Embree holds, its copy of the shapes included, and that of planes, edges, normals and uvs.
  size_t memory_bytes() const;

 private:
  struct Impl;
  /// What a ray meets first. It meets no other shape nearer than `others`, as far as was looked.
  struct First {
    std::optional<Hit> hit;
    float others = 0.0f;  // m
  };
  First first(const Ray& ray, float t_max, uint32_t layers, std::span<const Hit> without) const;
  std::optional<Hit> in_contact(const Ray& ray, float t_max, const First& dielectric) const;
  Encounter faces(const Ray& ray, uint32_t layers) const;

  std::unique_ptr<Impl> impl_;
};

/// The origin of a ray that leaves the surface at `hit` along `direction`. It is moved along the normal, to the side
/// that the ray travels to, just far enough for the ray not to meet the same surface again. As in [Wachter2019], the
/// offset follows the spacing of floats, but a bound for each shape replaces the constants of that paper. A triangle
/// may still be met again if |cos| of the direction to the normal is below 1e-6.
Vec3 leave_surface(const Hit& hit, const Vec3& direction);
/// The origin of a ray that goes straight on through everything that it meets at one place.
Vec3 leave_surfaces(const Encounter& met, const Vec3& direction);
/// The same for a point on a surface found without a ray: `normal` unit, `slack` as in Hit.
Vec3 leave_surface_at(const Vec3& position, const Vec3& normal, const Vec3& direction, float slack = 0.0f);

/// Slack of a triangle at a point of it, m. It bounds the rounding of Embree's intersection. `reach` holds, for each
/// axis, the largest distance from the point to the vertices (m); `twice_area` > 0 is in m^2. For needles (length over
/// width above about 1000, not across an axis) the slack stops at a thousandth of their length, and they may be met
/// again.
float flat_slack(const Vec3& normal, const Vec3& reach, double twice_area);
/// Slack of a disc, m.
float disc_slack(const DiscShape& disc);
/// Does the surface that the ray hit lie at `distance` (m) along the ray or beyond it, within rounding?
bool stands_at(const Hit& hit, const Ray& ray, float distance);
/// Slack of a sphere, m, at its points as point_on() gives them.
float sphere_slack(const SphereShape& sphere);
/// The point of a sphere at which the outward normal is `normal` (of any length except 0). Only the rounding of its
/// coordinates moves it off the sphere.
Vec3 point_on(const SphereShape& sphere, const Vec3d& normal);

}  // namespace vpm
