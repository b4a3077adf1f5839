// Rays against shapes: Embree and our spheres against brute force in higher precision, and rays that leave surfaces.
#include "surface/geometry.h"

#include <gtest/gtest.h>
#include <immintrin.h>

#include "base/error.h"
#include "base/rng.h"
#include "base/warp.h"

namespace vpm {
namespace {

float power_of_ten(Rng& rng, float lo, float hi) { return std::pow(10.0f, lo + (hi - lo) * rng.uniform()); }
Vec3 in_cube(Rng& rng) { return 2.0f * Vec3(rng.uniform(), rng.uniform(), rng.uniform()) - 1.0f; }
TriangleMesh triangle(const Vec3& a, const Vec3& b, const Vec3& c) { return {{a, b, c}, {{0, 1, 2}}}; }

/// A direction whose cosine to `normal` is spread over magnitudes from 2e-6 to 1, on either side.
Vec3 grazing_direction(const Vec3& normal, Rng& rng) {
  const float cosine = power_of_ten(rng, -5.7f, 0.0f);
  const Vec3 axis = rng.uniform() < 0.5f ? normal : -normal;
  return direction_about(axis, 1.0f - cosine, 2.0f * kPi * rng.uniform());
}

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
    const Real o = Real(ray.origin[i]) - s.centre[i], d = ray.direction[i];
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
    const Vec3 centre = in_cube(rng);
    triangles.push_back(
        triangle(centre + 0.3f * in_cube(rng), centre + 0.3f * in_cube(rng), centre + 0.3f * in_cube(rng)));
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
      const Ray ray{sphere.centre + aim.x * s + aim.y * t - away * direction, direction};
      const auto hit = geometry.intersect(ray);
      ASSERT_TRUE(hit) << "radius " << radius << " away " << away;
      const double from_centre = glm::length(Vec3d(hit->position) - Vec3d(sphere.centre));
      EXPECT_NEAR(from_centre / radius, 1.0, 2e-7);
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
      const Ray ray{disc.centre + aim.x * s + aim.y * t - radius * power_of_ten(rng, -2.0f, 2.0f) * direction,
                    direction};
      using Real = long double;
      Real ahead = 0, slope = 0, square = 0;
      for (int a = 0; a < 3; ++a) ahead += (Real(disc.centre[a]) - ray.origin[a]) * disc.normal[a];
      for (int a = 0; a < 3; ++a) slope += Real(ray.direction[a]) * disc.normal[a];
      for (int a = 0; a < 3; ++a) {
        const Real p = Real(ray.origin[a]) - disc.centre[a] + ahead / slope * ray.direction[a];
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
      const Vec3d off = Vec3d(hit->position) - Vec3d(disc.centre);
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
    EXPECT_EQ(found.position, met->position);
    EXPECT_EQ(found.normal, met->normal);
    EXPECT_EQ(found.shading_normal, met->shading_normal);
    EXPECT_EQ(found.slack, met->slack);
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

// Triangles of 0.1 mm to 1000 km anywhere within 1000 km, aslant, across an axis, or narrow.
TEST(LeaveSurface, NeverMeetsTheSameTriangleAgain) {
  Rng rng(3, static_cast<uint64_t>(RngUse::test), 0);
  int left = 0;
  for (int k = 0; k < 2500; ++k) {
    const float away = power_of_ten(rng, -4.0f, 6.0f);
    const float size = std::max(power_of_ten(rng, -4.0f, 6.0f), 1e-5f * away);
    const Vec3 centre = away * in_cube(rng);
    Vec3 a = centre + size * in_cube(rng), b = centre + size * in_cube(rng), c = centre + size * in_cube(rng);
    if (k % 3 == 1) a[k % 9 / 3] = b[k % 9 / 3] = c[k % 9 / 3] = centre[k % 9 / 3];
    if (k % 3 == 2) c = glm::mix(a, b, rng.uniform()) + 0.01f * (c - a);
    Geometry geometry;
    geometry.add(triangle(a, b, c));
    geometry.commit();
    for (int i = 0; i < 100; ++i) {
      const Vec2 u = rng.uniform2();
      const float root = std::sqrt(u.x);
      const Vec3 target = (1.0f - root) * a + root * (1.0f - u.y) * b + root * u.y * c;
      const Vec3 direction = uniform_sphere(rng.uniform2());
      const auto hit = geometry.intersect({target - size * power_of_ten(rng, -3.0f, 2.0f) * direction, direction});
      if (!hit) continue;
      for (int j = 0; j < 4; ++j) {
        const Vec3 out = grazing_direction(hit->normal, rng);
        const Vec3 origin = leave_surface(*hit, out);
        ++left;
        ASSERT_FALSE(geometry.intersect({origin, out}))
            << "size " << size << ", away " << away << ", cosine " << glm::dot(out, hit->normal);
      }
    }
  }
  EXPECT_GT(left, 900000);
}

TEST(LeaveSurface, LeavesASphereOutwardForGoodAndInwardToItsFarSide) {
  Rng rng(4, static_cast<uint64_t>(RngUse::test), 0);
  int left = 0;
  for (int k = 0; k < 2500; ++k) {
    const float away = power_of_ten(rng, -4.0f, 6.0f);
    const float radius = std::max(power_of_ten(rng, -4.0f, 6.0f), 1e-5f * away);
    const SphereShape sphere{away * in_cube(rng), radius};
    Geometry geometry;
    geometry.add(sphere);
    geometry.commit();
    for (int i = 0; i < 100; ++i) {
      const Vec3 direction = uniform_sphere(rng.uniform2());
      const float back = radius * power_of_ten(rng, -2.0f, 2.0f);
      const auto hit = geometry.intersect({sphere.centre + 0.5f * radius * in_cube(rng) - back * direction, direction});
      if (!hit) continue;
      for (int j = 0; j < 4; ++j) {
        const Vec3 out = grazing_direction(hit->normal, rng);
        const float cosine = glm::dot(out, hit->normal);
        const auto next = geometry.intersect({leave_surface(*hit, out), out});
        ++left;
        ASSERT_EQ(next.has_value(), cosine < 0.0f) << "radius " << radius << ", away " << away << ", cosine " << cosine;
        // The chord, but for the offset and the rounding of the coordinates, which tilts the normal.
        const float rounding = 1e-6f * (away + radius);
        const float tolerance = 4.0f * rounding + std::sqrt(8.0f * rounding * radius);
        ASSERT_NEAR(next ? next->t : 0.0f, next ? -2.0f * radius * cosine : 0.0f, tolerance);
      }
    }
  }
  EXPECT_GT(left, 900000);
}

TEST(LeaveSurface, NeverMeetsTheSameDiscAgain) {
  Rng rng(7, static_cast<uint64_t>(RngUse::test), 0);
  int left = 0;
  for (int k = 0; k < 2500; ++k) {
    const float away = power_of_ten(rng, -4.0f, 6.0f);
    const float radius = std::max(power_of_ten(rng, -4.0f, 6.0f), 1e-5f * away);
    const DiscShape disc{away * in_cube(rng), uniform_sphere(rng.uniform2()), radius};
    Geometry geometry;
    geometry.add(disc);
    geometry.commit();
    for (int i = 0; i < 100; ++i) {
      const Vec3 direction = uniform_sphere(rng.uniform2());
      const float back = radius * power_of_ten(rng, -2.0f, 2.0f);
      const auto hit = geometry.intersect({disc.centre + 0.5f * radius * in_cube(rng) - back * direction, direction});
      if (!hit) continue;
      for (int j = 0; j < 4; ++j) {
        const Vec3 out = grazing_direction(hit->normal, rng);
        ++left;
        ASSERT_FALSE(geometry.intersect({leave_surface(*hit, out), out})) << "radius " << radius << ", away " << away;
      }
    }
  }
  EXPECT_GT(left, 300000);
}

// What a ray was sent to is where it stands, from near and far and at grazing angles; what is a hundredth of the way
// before it is not.
TEST(SlowStandsAt, TellsThePointAimedAtFromWhatIsBefore) {
  Rng rng(8, static_cast<uint64_t>(RngUse::test), 0);
  int before = 0;
  for (int k = 0; k < 20000; ++k) {
    const float size = power_of_ten(rng, -2.0f, 2.0f);
    const Vec3 a = size * in_cube(rng), b = size * in_cube(rng), c = size * in_cube(rng);
    Geometry geometry;
    geometry.add(triangle(a, b, c));
    geometry.commit();
    const Vec3 target = (a + b + c) / 3.0f;
    const Vec3 normal = glm::normalize(glm::cross(b - a, c - a));
    const Vec3 origin = target - size * power_of_ten(rng, -1.0f, 3.0f) * grazing_direction(normal, rng);
    const float distance = glm::distance(origin, target);
    const Ray ray{origin, glm::normalize(target - origin)};
    const auto hit = geometry.intersect(ray);
    if (!hit) continue;  // beside a needle
    ASSERT_TRUE(stands_at(*hit, ray, distance)) << "size " << size << ", distance " << distance;
    if (std::abs(glm::dot(hit->normal, ray.direction)) < 0.01f) continue;
    ++before;
    ASSERT_FALSE(stands_at(*hit, ray, 1.01f * distance)) << "size " << size << ", distance " << distance;
  }
  EXPECT_GT(before, 5000);
}

// Near the origin coordinates are so exact that the sphere's own rounding is what counts.
TEST(LeaveSurface, LeavesASphereThatPassesThroughTheOrigin) {
  Rng rng(5, static_cast<uint64_t>(RngUse::test), 0);
  for (const float radius : {1e-2f, 1.0f, 1e3f, 1e6f}) {
    Geometry geometry;
    geometry.add(SphereShape{{0, -radius, 0}, radius});
    geometry.commit();
    for (int i = 0; i < 20000; ++i) {
      const float near = radius * power_of_ten(rng, -8.0f, -3.0f);
      const auto hit = geometry.intersect({near * Vec3(rng.uniform(), 1.0f, rng.uniform()), {0, -1, 0}});
      ASSERT_TRUE(hit);
      const Vec3 out = grazing_direction(hit->normal, rng);
      ASSERT_EQ(geometry.intersect({leave_surface(*hit, out), out}).has_value(), glm::dot(out, hit->normal) < 0.0f);
    }
  }
}

TEST(LeaveSurface, MovesByUnitsInTheLastPlaceOnly) {
  Geometry geometry;
  geometry.add(TriangleMesh{{{-1e6f, 0, -1e6f}, {1e6f, 0, -1e6f}, {0, 0, 1e6f}}, {{0, 2, 1}}});  // the ground, up is +y
  geometry.add(SphereShape{{0, 5, 0}, 1.0f});
  geometry.commit();
  const auto ground = geometry.intersect({{0.5f, 1.0f, 0.25f}, {0, -1, 0}});
  ASSERT_TRUE(ground);
  EXPECT_EQ(ground->normal, Vec3(0, 1, 0));
  const Vec3 up = leave_surface(*ground, {0, 1, 0}), down = leave_surface(*ground, {0, -1, 0});
  EXPECT_GT(up.y, 0.0f);
  EXPECT_LT(up.y, 1e-6f);
  EXPECT_LT(down.y, 0.0f);
  const auto ball = geometry.intersect({{0, 9, 0}, {0, -1, 0}});
  ASSERT_TRUE(ball);
  EXPECT_GT(leave_surface(*ball, {0, 1, 0}).y, 6.0f);
  EXPECT_LT(leave_surface(*ball, {0, 1, 0}).y, 6.00001f);
}

}  // namespace
}  // namespace vpm
