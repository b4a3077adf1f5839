// Rays that leave surfaces, and where rays were sent to: none meets again what it left. Every second scene is one of
// Embree's tree.
#include <gtest/gtest.h>

#include "surface/random_shapes.h"
#include "vpm/surface/geometry.h"

namespace vpm {
namespace {

// Triangles of 0.1 mm to 1000 km anywhere within 1000 km, aslant, across an axis, or narrow.
TEST(LeaveSurface, NeverMeetsTheSameTriangleAgain) {
  Rng rng(3, static_cast<uint64_t>(RngUse::test), 0);
  int left = 0;
  for (int k = 0; k < 2500; ++k) {
    const float away = power_of_ten(rng, -4.0f, 6.0f);
    const float size = std::max(power_of_ten(rng, -4.0f, 6.0f), 1e-5f * away);
    const Vec3 center = away * in_cube(rng);
    Vec3 a = center + size * in_cube(rng), b = center + size * in_cube(rng), c = center + size * in_cube(rng);
    if (k % 3 == 1) a[k % 9 / 3] = b[k % 9 / 3] = c[k % 9 / 3] = center[k % 9 / 3];
    if (k % 3 == 2) c = glm::mix(a, b, rng.uniform()) + 0.01f * (c - a);
    Geometry geometry;
    geometry.add(triangle(a, b, c));
    if (k % 2 == 1) add_specks(geometry, center, size);
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
    if (k % 2 == 1) add_specks(geometry, sphere.center, radius);
    geometry.commit();
    for (int i = 0; i < 100; ++i) {
      const Vec3 direction = uniform_sphere(rng.uniform2());
      const float back = radius * power_of_ten(rng, -2.0f, 2.0f);
      const auto hit = geometry.intersect({sphere.center + 0.5f * radius * in_cube(rng) - back * direction, direction});
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
    if (k % 2 == 1) add_specks(geometry, disc.center, radius);
    geometry.commit();
    for (int i = 0; i < 100; ++i) {
      const Vec3 direction = uniform_sphere(rng.uniform2());
      const float back = radius * power_of_ten(rng, -2.0f, 2.0f);
      const auto hit = geometry.intersect({disc.center + 0.5f * radius * in_cube(rng) - back * direction, direction});
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

// Rays from within boxes between media, aimed at their corners and edges, where a hit may be just beside each face.
TEST(LeaveSurface, PassesCornersOfBoxesInAFewSteps) {
  Rng rng(11, rng_stream(RngUse::test, 53), 0);
  for (int k = 0; k < 40; ++k) {
    const Vec3d half = 0.05 + 0.5 * (1.0 + Vec3d(in_cube(rng))), center(in_cube(rng));
    Geometry geometry;
    geometry.add(box_mesh(center - half, center + half), Layer::boundary);
    if (k % 2 == 1) add_specks(geometry, Vec3(center), 1.0f);
    geometry.commit();
    for (int i = 0; i < 1000; ++i) {
      Vec3d aim(glm::sign(in_cube(rng)));
      if (i % 2 == 1) aim.z = 2.0 * rng.uniform_double() - 1.0;
      const Vec3 origin(center + 0.99 * half * Vec3d(in_cube(rng)));
      Ray ray{origin, glm::normalize(Vec3(center + half * aim) - origin)};
      int steps = 0;
      while (const Encounter met = geometry.encounter(ray)) {
        ASSERT_LT(++steps, 20) << "box " << k << ", ray " << i;
        ray.origin = leave_surfaces(met, ray.direction);
      }
    }
  }
}

}  // namespace
}  // namespace vpm
