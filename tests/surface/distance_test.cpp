// Distances of points to shapes, and the search for shapes near a point, against brute force.
#include "vpm/surface/distance.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "surface/random_shapes.h"
#include "vpm/base/rng.h"
#include "vpm/base/warp.h"

namespace vpm {
namespace {

TEST(Distance, ToATriangleIsTheLeastToItsPoints) {
  constexpr int kSteps = 300;
  for (uint64_t i = 0; i < 60; ++i) {
    Rng rng(1, rng_stream(RngUse::test, 40), i);
    const Vec3 a = in_cube(rng), b = in_cube(rng), c = in_cube(rng), point = 2.0f * in_cube(rng);
    double least = kInfinity;
    for (int u = 0; u <= kSteps; ++u)
      for (int v = 0; u + v <= kSteps; ++v) {
        const Vec3d on =
            (double(kSteps - u - v) * Vec3d(a) + double(u) * Vec3d(b) + double(v) * Vec3d(c)) / double{kSteps};
        least = std::min(least, glm::distance(on, Vec3d(point)));
      }
    const double found = distance_to_triangle(point, a, b, c);
    EXPECT_LE(found, least + 1e-9);
    EXPECT_NEAR(found, least, 4.0 / kSteps);
  }
  // Exactly: above the inside, beside an edge, beyond a corner.
  const Vec3 a(0.0f), b(1.0f, 0.0f, 0.0f), c(0.0f, 1.0f, 0.0f);
  EXPECT_DOUBLE_EQ(distance_to_triangle(Vec3(0.25f, 0.25f, -2.0f), a, b, c), 2.0);
  EXPECT_DOUBLE_EQ(distance_to_triangle(Vec3(0.5f, -3.0f, 4.0f), a, b, c), 5.0);
  EXPECT_DOUBLE_EQ(distance_to_triangle(Vec3(4.0f, -4.0f, 0.0f), a, b, c), 5.0);
}

TEST(Distance, ToSpheresAndDiscs) {
  const SphereShape sphere{Vec3(1.0f, 0.0f, 0.0f), 2.0f};
  EXPECT_DOUBLE_EQ(distance_to(sphere, Vec3(1.5f, 0.0f, 0.0f)), 1.5);
  EXPECT_DOUBLE_EQ(distance_to(sphere, Vec3(1.0f, 0.0f, -5.0f)), 3.0);
  const DiscShape disc{Vec3(0.0f, 1.0f, 0.0f), Vec3(0.0f, 1.0f, 0.0f), 2.0f};
  EXPECT_DOUBLE_EQ(distance_to(disc, Vec3(1.5f, -1.0f, 0.0f)), 2.0);
  EXPECT_DOUBLE_EQ(distance_to(disc, Vec3(0.0f, 5.0f, -5.0f)), 5.0);
}

TEST(Geometry, FindsShapesNearAPointLikeBruteForce) {
  Rng rng(1, rng_stream(RngUse::test, 41), 0);
  Geometry geometry;
  std::vector<TriangleMesh> triangles;
  std::vector<SphereShape> spheres;
  std::vector<DiscShape> discs;
  for (int i = 0; i < 20; ++i) {
    const Vec3 center = in_cube(rng);
    triangles.push_back({{center, center + 0.4f * in_cube(rng), center + 0.4f * in_cube(rng)}, {{0, 1, 2}}});
    spheres.push_back({in_cube(rng), 0.02f + 0.2f * rng.uniform()});
    discs.push_back({in_cube(rng), uniform_sphere(rng.uniform2()), 0.02f + 0.2f * rng.uniform()});
    geometry.add(triangles.back());
    geometry.add(spheres.back(), Layer::boundary);
    geometry.add(discs.back(), Layer::dividing_surface);
  }
  geometry.commit();
  int near = 0;
  for (int k = 0; k < 5000; ++k) {
    const Vec3 point = 1.2f * in_cube(rng);
    double least = kInfinity;
    for (int i = 0; i < 20; ++i) {
      const auto& p = triangles[i].positions;
      least = std::min({least, distance_to_triangle(point, p[0], p[1], p[2]), distance_to(spheres[i], point),
                        distance_to(discs[i], point)});
    }
    const float radius = 0.3f * rng.uniform();
    if (std::abs(least - radius) < 1e-5) continue;
    ASSERT_EQ(geometry.is_near(point, radius), least < radius) << least << " " << radius;
    near += least < radius;
  }
  EXPECT_GT(near, 1000);
  EXPECT_LT(near, 4900);
}

TEST(Geometry, LooksForSurfacesThroughBoundaries) {
  Geometry geometry;
  geometry.add(SphereShape{Vec3(0.0f), 1.0f}, Layer::boundary);
  geometry.add(DiscShape{Vec3(0.0f, 0.0f, -1.0f), Vec3(0.0f, 0.0f, 1.0f), 1.0f});  // touches the sphere
  geometry.commit();
  const Ray down{Vec3(0.0f, 0.0f, 3.0f), Vec3(0.0f, 0.0f, -1.0f)};
  EXPECT_EQ(geometry.intersect(down)->shape, 0u);
  const std::optional<Hit> hit = geometry.intersect_surface(down, 10.0f);
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->shape, 1u);
  EXPECT_FLOAT_EQ(hit->t, 4.0f);
  EXPECT_FALSE(geometry.intersect_surface(down, 3.9f));
}

}  // namespace
}  // namespace vpm
