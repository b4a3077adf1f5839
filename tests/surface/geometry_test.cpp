// Rays against shapes: Embree and our spheres against brute force in higher precision.
#include "vpm/surface/geometry.h"

#include <gtest/gtest.h>
#include <immintrin.h>

#include "surface/random_shapes.h"
#include "vpm/base/error.h"
#include "vpm/surface/mesh.h"

namespace vpm {
namespace {

/// Nearest hit by testing every shape in double; `margin` is how far, relative to size, the decision was from changing.
struct BruteHit {
  double t = std::numeric_limits<double>::infinity();
  int shape = -1;
  double margin = std::numeric_limits<double>::infinity();
};
void brute_triangle(const TriangleMesh& m, const Ray& ray, int shape, BruteHit& best) {
  const Vec3d a(m.positions[0]), ab = Vec3d(m.positions[1]) - a, ac = Vec3d(m.positions[2]) - a;
  const Vec3d n = glm::cross(ab, ac), d(ray.direction), o = Vec3d(ray.origin) - a;
  const double t = -glm::dot(o, n) / glm::dot(d, n);
  if (!(t > 0.0)) return;
  const Vec3d p = o + t * d;
  const double u = glm::dot(glm::cross(p, ac), n) / glm::dot(n, n), v = glm::dot(glm::cross(ab, p), n) / glm::dot(n, n);
  const double inside = std::min(std::min(u, v), 1.0 - u - v);
  best.margin = std::min(best.margin, std::abs(inside));
  if (inside < 0.0) return;
  if (best.shape >= 0) best.margin = std::min(best.margin, std::abs(t - best.t));
  if (t < best.t) best.t = t, best.shape = shape;
}
void brute_sphere(const SphereShape& s, const Ray& ray, int shape, BruteHit& best) {
  using Real = long double;
  Real a = 0, b = 0, c = -Real(s.radius) * s.radius;
  for (int i = 0; i < 3; ++i) {
    const Real o = Real(ray.origin[i]) - s.center[i], d = ray.direction[i];
    a += d * d, b += o * d, c += o * o;
  }
  const Real discriminant = b * b - a * c;
  best.margin = std::min(best.margin, static_cast<double>(std::abs(discriminant)));
  if (discriminant < 0) return;
  for (const Real t : {(-b - std::sqrt(discriminant)) / a, (-b + std::sqrt(discriminant)) / a}) {
    if (t <= 0) continue;
    if (best.shape >= 0) best.margin = std::min(best.margin, std::abs(static_cast<double>(t) - best.t));
    if (static_cast<double>(t) < best.t) best.t = static_cast<double>(t), best.shape = shape;
    return;
  }
}

TEST(Geometry, MeetsTheNearestShapeLikeBruteForce) {
  Rng rng(1, static_cast<uint64_t>(RngUse::test), 0);
  std::vector<TriangleMesh> triangles;
  std::vector<SphereShape> spheres;
  Geometry geometry;
  for (int i = 0; i < 100; ++i) {
    const Vec3 center = in_cube(rng);
    triangles.push_back(
        triangle(center + 0.3f * in_cube(rng), center + 0.3f * in_cube(rng), center + 0.3f * in_cube(rng)));
    EXPECT_EQ(geometry.add(triangles.back()), static_cast<uint32_t>(2 * i));
    spheres.push_back({in_cube(rng), 0.1f * rng.uniform() + 0.001f});
    EXPECT_EQ(geometry.add(spheres.back()), static_cast<uint32_t>(2 * i + 1));
  }
  geometry.commit();
  int hits = 0, compared = 0;
  for (int k = 0; k < 10000; ++k) {
    const Ray ray{in_cube(rng), uniform_sphere(rng.uniform2())};
    BruteHit best;
    for (int i = 0; i < 100; ++i) {
      brute_triangle(triangles[i], ray, 2 * i, best);
      brute_sphere(spheres[i], ray, 2 * i + 1, best);
    }
    if (best.margin < 1e-5) continue;
    ++compared;
    const std::optional<Hit> hit = geometry.intersect(ray);
    ASSERT_EQ(hit.has_value(), best.shape >= 0);
    if (!hit) continue;
    ++hits;
    ASSERT_EQ(hit->shape, static_cast<uint32_t>(best.shape));
    EXPECT_NEAR(hit->t, best.t, 2e-5);
    EXPECT_NEAR(glm::length(hit->position - ray.at(hit->t)), 0.0f, 3e-5f);
    EXPECT_NEAR(glm::length(hit->normal), 1.0f, 1e-6f);
    EXPECT_FALSE(geometry.intersect(ray, hit->t)) << "t_max is exclusive";
    EXPECT_TRUE(geometry.intersect(ray, std::nextafter(hit->t, kInfinity)));
  }
  EXPECT_GT(compared, 9000);
  EXPECT_GT(hits, 2000);
}

TEST(Geometry, KeepsTheOutwardNormalFromBothSides) {
  Geometry geometry;
  geometry.add(triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  geometry.add(SphereShape{{10, 0, 0}, 2.0f});
  geometry.commit();
  for (const float side : {-1.0f, 1.0f}) {
    const auto hit = geometry.intersect({{0.2f, 0.2f, side}, {0, 0, -side}});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->normal, Vec3(0, 0, 1));
    EXPECT_EQ(hit->t, 1.0f);
    EXPECT_EQ(hit->position.z, 0.0f);
  }
  const auto inside = geometry.intersect({{10, 0, 0}, {0, 1, 0}});
  ASSERT_TRUE(inside);
  EXPECT_EQ(inside->normal, Vec3(0, 1, 0));
  EXPECT_EQ(inside->t, 2.0f);
  const auto outside = geometry.intersect({{10, 7, 0}, {0, -1, 0}});
  ASSERT_TRUE(outside);
  EXPECT_EQ(outside->normal, Vec3(0, 1, 0));
  EXPECT_EQ(outside->t, 5.0f);
}

TEST(Geometry, DoesNotMeetASurfaceAtItsOrigin) {
  Geometry geometry;
  geometry.add(triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  geometry.commit();
  EXPECT_FALSE(geometry.intersect({{0.2f, 0.2f, 0.0f}, {0, 0, 1}}));
  EXPECT_FALSE(geometry.intersect({{0.2f, 0.2f, 1.0f}, {0, 0, -1}}, 0.0f));
}

TEST(Geometry, HitsOfFarAndTinyAndHugeSpheresLieOnThem) {
  Rng rng(2, static_cast<uint64_t>(RngUse::test), 0);
  for (const float radius : {1e-3f, 1.0f, 1e3f, 1e6f}) {
    const SphereShape sphere{radius * Vec3(0.3f, -0.2f, 0.1f), radius};
    Geometry geometry;
    geometry.add(sphere);
    geometry.commit();
    for (int i = 0; i < 1000; ++i) {
      // Aimed at a point of the disc across the ray, from inside to a million radii away.
      const Vec3 direction = uniform_sphere(rng.uniform2());
      const float away = radius * power_of_ten(rng, -3.0f, 6.0f);
      Vec3 s, t;
      make_frame(direction, s, t);
      const Vec2 aim = 0.7f * radius * uniform_disc(rng.uniform2());
      const Ray ray{sphere.center + aim.x * s + aim.y * t - away * direction, direction};
      const auto hit = geometry.intersect(ray);
      ASSERT_TRUE(hit) << "radius " << radius << " away " << away;
      const double from_center = glm::length(Vec3d(hit->position) - Vec3d(sphere.center));
      EXPECT_NEAR(from_center / radius, 1.0, 2e-7);
      // The ray passes through the hit: its distance to the line is that of rounded coordinates.
      const Vec3d to_hit = Vec3d(hit->position) - Vec3d(ray.origin), d = glm::normalize(Vec3d(direction));
      EXPECT_LT(glm::length(to_hit - glm::dot(to_hit, d) * d), 2e-7 * radius);
    }
  }
}

// Discs of any size and place, met from both sides, near the rim and beyond it; the truth in long double.
TEST(Geometry, MeetsDiscsWithinTheirRims) {
  Rng rng(6, static_cast<uint64_t>(RngUse::test), 0);
  int inside = 0, outside = 0;
  for (int k = 0; k < 1000; ++k) {
    const float radius = power_of_ten(rng, -3.0f, 5.0f);
    const DiscShape disc{10.0f * radius * in_cube(rng), uniform_sphere(rng.uniform2()), radius};
    Geometry geometry;
    geometry.add(disc);
    geometry.commit();
    Vec3 s, t;
    make_frame(disc.normal, s, t);
    for (int i = 0; i < 20; ++i) {
      const Vec2 aim = 1.5f * radius * uniform_disc(rng.uniform2());
      const Vec3 direction = grazing_direction(disc.normal, rng);
      const Ray ray{disc.center + aim.x * s + aim.y * t - radius * power_of_ten(rng, -2.0f, 2.0f) * direction,
                    direction};
      using Real = long double;
      Real ahead = 0, slope = 0, square = 0;
      for (int a = 0; a < 3; ++a) ahead += (Real(disc.center[a]) - ray.origin[a]) * disc.normal[a];
      for (int a = 0; a < 3; ++a) slope += Real(ray.direction[a]) * disc.normal[a];
      for (int a = 0; a < 3; ++a) {
        const Real p = Real(ray.origin[a]) - disc.center[a] + ahead / slope * ray.direction[a];
        square += p * p;
      }
      const double share = static_cast<double>(std::sqrt(square) / radius), far = static_cast<double>(ahead / slope);
      if (std::abs(share - 1.0) < 1e-6 || std::abs(far) < 1e-6 * radius) continue;
      const auto hit = geometry.intersect(ray);
      ASSERT_EQ(hit.has_value(), share < 1.0 && far > 0.0) << "radius " << radius << ", share " << share;
      ++(hit ? inside : outside);
      if (!hit) continue;
      EXPECT_EQ(hit->normal, disc.normal);
      EXPECT_NEAR(hit->t, far, 1e-6 * far);
      const Vec3d off = Vec3d(hit->position) - Vec3d(disc.center);
      EXPECT_LT(std::abs(glm::dot(off, Vec3d(disc.normal))), 2e-6 * radius);
      EXPECT_LT(glm::length(off), 1.000003 * radius);
    }
  }
  EXPECT_GT(inside, 5000);
  EXPECT_GT(outside, 5000);
}

TEST(Geometry, KnowsAreaBoundsAndMemory) {
  Geometry geometry;
  EXPECT_TRUE(geometry.bounds().empty());
  // The second triangle has no area: it is left out.
  geometry.add(
      TriangleMesh{{{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0}, {4, 0, 0}}, {{0, 1, 2}, {0, 1, 4}, {0, 2, 3}}});
  geometry.add(SphereShape{{0, 0, 10}, 2.0f});
  geometry.commit();
  EXPECT_DOUBLE_EQ(geometry.area(0), 6.0);
  EXPECT_DOUBLE_EQ(geometry.area(1), 16.0 * kPiD);
  EXPECT_EQ(geometry.bounds().lo, Vec3(-2, -2, 0));
  EXPECT_EQ(geometry.bounds().hi, Vec3(2, 3, 12));
  EXPECT_GT(geometry.memory_bytes(), 100u);
  EXPECT_TRUE(!geometry.has_uvs(0) && geometry.has_uvs(1));
  Geometry disc;
  disc.add(DiscShape{{1, 2, 3}, {0.6f, 0, 0.8f}, 5.0f});
  disc.commit();
  EXPECT_FLOAT_EQ(static_cast<float>(disc.area(0)), 25.0f * kPi);
  EXPECT_FALSE(disc.has_uvs(0));
  EXPECT_LT(glm::length(disc.bounds().lo - Vec3(-3, -3, 0)), 1e-5f);
  EXPECT_LT(glm::length(disc.bounds().hi - Vec3(5, 7, 6)), 1e-5f);
  Geometry empty;
  empty.commit();
  EXPECT_FALSE(empty.intersect({{0, 0, 0}, {0, 0, 1}}));
}

TEST(Geometry, FindsPointsOfTrianglesAsRaysDo) {
  Rng rng(1, rng_stream(RngUse::test, 40), 0);
  for (int i = 0; i < 200; ++i) {
    TriangleMesh mesh = triangle(in_cube(rng), in_cube(rng), in_cube(rng));
    mesh.normals = {in_cube(rng), in_cube(rng), in_cube(rng)};
    const Vec3 inside = (mesh.positions[0] + mesh.positions[1] + 2.0f * mesh.positions[2]) / 4.0f;
    Geometry geometry;
    geometry.add(SphereShape{Vec3(10.0f), 1.0f});
    geometry.add(mesh);
    geometry.commit();
    EXPECT_EQ(geometry.triangle_count(0), 0u);
    EXPECT_EQ(geometry.triangle_count(1), 1u);
    const Vec3 origin = 2.0f * in_cube(rng);
    const std::optional<Hit> met = geometry.intersect({origin, glm::normalize(inside - origin)});
    if (!met) continue;  // edge on
    const Hit found = geometry.point_of_triangle(1, met->triangle, met->barycentric);
    EXPECT_EQ(found.shape, met->shape);
    EXPECT_LT(glm::distance(found.position, met->position), 4e-7f);  // barycentric coordinates are rounded
    EXPECT_EQ(found.normal, met->normal);
    EXPECT_EQ(found.shading_normal, met->shading_normal);
    EXPECT_NEAR(found.slack, met->slack, 1e-5f * met->slack);
  }
}

// Three faces of very different sizes in one plane, as a tile in a floor in a plain: a ray meets all of them, and
// whichever is nearest by rounding hides none. Every second scene is one of Embree's tree.
TEST(Geometry, FindsAllFacesThatCoincide) {
  Rng rng(12, rng_stream(RngUse::test, 54), 0);
  for (int k = 0; k < 100; ++k) {
    Vec3 s, t;
    const Vec3 normal = uniform_sphere(rng.uniform2());
    make_frame(normal, s, t);
    Geometry geometry;
    for (const double size : {1.0, 40.0, 1000.0})
      geometry.add(quad_mesh(-size * Vec3d(s) - 1.5 * size * Vec3d(t), 3.0 * size * Vec3d(s), 3.0 * size * Vec3d(t)),
                   Layer::boundary);
    if (k % 2 == 1) add_specks(geometry, Vec3(0.0f), 500.0f);
    geometry.commit();
    for (int i = 0; i < 100; ++i) {
      const Vec3 aim = 0.9f * (rng.uniform() * s + rng.uniform() * t);
      const Vec3 from = aim + 3.0f * (rng.uniform() + 0.1f) * normal + in_cube(rng).x * s;
      const Encounter met = geometry.faces({from, glm::normalize(aim - from)});
      ASSERT_EQ(met.count, 3) << "plane " << k << ", ray " << i;
      for (int j = 1; j < 3; ++j) ASSERT_LE(met.hits[j - 1].t, met.hits[j].t);
    }
  }
}

TEST(Geometry, RefusesWhatIsNoShape) {
  Geometry geometry;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(geometry.add(TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 3}}}), InputError);
  EXPECT_THROW(geometry.add(triangle({0, 0, 0}, {1, 0, nan}, {0, 1, 0})), InputError);
  EXPECT_THROW(geometry.add(triangle({0, 0, 0}, {1, 1, 1}, {2, 2, 2})), InputError);
  EXPECT_THROW(geometry.add(triangle({0, 0, 0}, {2e9f, 0, 0}, {0, 1, 0})), InputError);
  EXPECT_THROW(geometry.add(TriangleMesh{}), InputError);
  EXPECT_THROW(geometry.add(SphereShape{{0, 0, 0}, 0.0f}), InputError);
  EXPECT_THROW(geometry.add(SphereShape{{0, 0, 0}, nan}), InputError);
  EXPECT_THROW(geometry.add(SphereShape{{0, kInfinity, 0}, 1.0f}), InputError);
  EXPECT_THROW(geometry.add(DiscShape{{0, 0, 0}, {0, 1, 0}, 0.0f}), InputError);
  EXPECT_THROW(geometry.add(DiscShape{{0, nan, 0}, {0, 1, 0}, 1.0f}), InputError);
}

TEST(Geometry, LeavesTheRoundingModeAlone) {
  constexpr unsigned kFlush = 0x8040u;  // flush to zero, denormals are zero
  _mm_setcsr(_mm_getcsr() & ~kFlush);
  Geometry geometry;
  geometry.add(SphereShape{});
  geometry.commit();
  geometry.intersect({{0, 0, 5}, {0, 0, -1}});
  EXPECT_EQ(_mm_getcsr() & kFlush, 0u);
}

}  // namespace
}  // namespace vpm
