// Scenes whose shapes are all looked at for each ray: they are met as those of a tree, and edges let nothing through.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "surface/random_shapes.h"
#include "vpm/surface/few_triangles.h"
#include "vpm/surface/mesh.h"

namespace vpm {
namespace {

void add_random_shapes(Rng& rng, Geometry& geometry) {
  for (int i = 0; i < 6; ++i) geometry.add(quad_mesh(Vec3d(in_cube(rng)), Vec3d(in_cube(rng)), Vec3d(in_cube(rng))));
  geometry.add(box_mesh(Vec3d(-0.2), Vec3d(0.3)));
  geometry.add(SphereShape{in_cube(rng), 0.3f}, Layer::boundary);
  geometry.add(DiscShape{in_cube(rng), uniform_sphere(rng.uniform2()), 0.5f});
}

/// Boxes of fog and of glass that stand on a floor and touch each other.
void add_touching_shapes(Rng&, Geometry& geometry) {
  geometry.add(quad_mesh(Vec3d(-1, -1, 0), Vec3d(2, 0, 0), Vec3d(0, 2, 0)));
  geometry.add(box_mesh(Vec3d(-0.5, -0.5, 0.0), Vec3d(0.0, 0.5, 0.5)), Layer::boundary);
  geometry.add(box_mesh(Vec3d(0.0, -0.5, 0.0), Vec3d(0.5, 0.5, 0.5)), Layer::interface);
  geometry.add(DiscShape{Vec3(-0.25f, 0.0f, 0.5f), Vec3(0, 0, 1), 0.2f}, Layer::dividing_surface);
}

/// In how many of 200,000 rays `ask` differs between a scene and the same with specks that make it one of Embree's
/// tree. Both take lines for inside that pass an edge within the rounding of floats, and round otherwise: 3e-7 of the
/// length of edges or less, so that one or two rays may differ.
template <class Add, class Ask>
int different_rays(Add&& add, Ask&& ask) {
  Rng rng(1, rng_stream(RngUse::test, 53), 0);
  Geometry few, many;
  for (Geometry* geometry : {&few, &many}) {
    Rng same = rng;
    add(same, *geometry);
  }
  add_specks(many, Vec3(0.0f), 0.28f);
  few.commit();
  many.commit();
  int met = 0, different = 0;
  for (int i = 0; i < 200000; ++i) {
    const Ray ray{in_cube(rng), uniform_sphere(rng.uniform2())};
    const Encounter one = ask(few, ray), other = ask(many, ray);
    met += one ? 1 : 0;
    const size_t bytes = static_cast<size_t>(one.count) * sizeof(Hit);
    different += one.count != other.count || one.surface != other.surface ||
                 std::memcmp(one.hits.data(), other.hits.data(), bytes) != 0;
  }
  EXPECT_GT(met, 30000);
  return different;
}

Encounter first_hit(const Geometry& geometry, const Ray& ray) {
  Encounter first;
  if (const std::optional<Hit> hit = geometry.intersect(ray, 10.0f)) first.hits[first.count++] = *hit;
  return first;
}

TEST(FewTriangles, AreMetAsThoseOfATree) { EXPECT_LE(different_rays(add_random_shapes, first_hit), 2); }

TEST(FewTriangles, CoincideAsThoseOfATree) {
  const auto faces = [](const Geometry& geometry, const Ray& ray) { return geometry.faces(ray); };
  const auto division = [](const Geometry& geometry, const Ray& ray) { return geometry.division(ray); };
  const auto encounter = [](const Geometry& geometry, const Ray& ray) { return geometry.encounter(ray, 10.0f); };
  EXPECT_LE(different_rays(add_touching_shapes, first_hit), 2);
  EXPECT_LE(different_rays(add_touching_shapes, faces), 2);
  EXPECT_LE(different_rays(add_touching_shapes, division), 2);
  EXPECT_LE(different_rays(add_touching_shapes, encounter), 2);
}

// From within a box whose faces are shapes of their own, with corners that differ in the last place.
TEST(FewTriangles, LetNoRayOutBetweenFacesOfTheirOwn) {
  Rng rng(1, rng_stream(RngUse::test, 56), 0);
  const TriangleMesh box = box_mesh(Vec3d(-1.0), Vec3d(1.3, 1.1, 0.9));
  const auto moved = [&](float x) { return rng.uniform() < 0.5f ? x : std::nextafter(x, 2.0f * x); };
  int out = 0;
  for (int k = 0; k < 100; ++k) {
    Geometry geometry;
    for (const glm::uvec3& v : box.triangles) {
      TriangleMesh face = triangle(box.positions[v.x], box.positions[v.y], box.positions[v.z]);
      for (Vec3& p : face.positions) p = {moved(p.x), moved(p.y), moved(p.z)};
      geometry.add(face);
    }
    geometry.commit();
    for (int i = 0; i < 2000; ++i) {
      const glm::uvec3& v = box.triangles[i % 12];
      const Vec3 &a = box.positions[v.x], &b = box.positions[v.y], origin = 0.5f * in_cube(rng);
      out += geometry.intersect({origin, glm::normalize(a + rng.uniform() * (b - a) - origin)}) ? 0 : 1;
    }
  }
  EXPECT_EQ(out, 0);
}

// From within a closed mesh, towards points of its edges and its corners.
TEST(FewTriangles, LetNoRayOutBetweenThem) {
  Rng rng(1, rng_stream(RngUse::test, 54), 0);
  TriangleMesh mesh = box_mesh(Vec3d(-1.0), Vec3d(1.0));
  for (Vec3& p : mesh.positions) p = 0.8f * p + 0.1f * in_cube(rng) + Vec3(5.0f, -3.0f, 2.0f);
  Geometry geometry;
  geometry.add(mesh);
  geometry.commit();
  for (int i = 0; i < 200000; ++i) {
    const glm::uvec3& v = mesh.triangles[i % 12];
    const Vec3 &a = mesh.positions[v.x], &b = mesh.positions[v.y];
    const Vec3 origin = 0.3f * in_cube(rng) + Vec3(5.0f, -3.0f, 2.0f);
    const Vec3 aim = i % 5 == 0 ? a : a + rng.uniform() * (b - a);
    const std::optional<Hit> hit = geometry.intersect({origin, glm::normalize(aim - origin)});
    ASSERT_TRUE(hit) << "ray " << i;
    EXPECT_NEAR(hit->t, glm::distance(aim, origin), 1e-5f) << "ray " << i;
  }
}

// Scenes that show what rounding does: mostly in planes x = 3 y, where rounding errors are all that products of
// Pluecker coordinates have.
class FewTrianglesOfOnePlane : public testing::Test {
 protected:
  /// To 20 binary digits: three times it is a float, too.
  static float rounded(float x) { return std::ldexp(std::round(std::ldexp(x, 20)), -20); }
  static Vec3 in_plane(float y, float z) { return {3.0f * rounded(y), rounded(y), z}; }
  Vec3 near_origin() { return in_plane(rng_.uniform(), power_of_ten(rng_, -6.0f, 0.0f)); }
  bool meets(const Ray& ray, const std::vector<Vec3>& corners, const std::vector<glm::uvec3>& triangles) {
    Geometry geometry;
    geometry.add(TriangleMesh{corners, triangles});
    geometry.commit();
    return geometry.intersect(ray).has_value();
  }

  Rng rng_{1, rng_stream(RngUse::test, 55), 0};
};

// Rays through the common edge of two triangles.
TEST_F(FewTrianglesOfOnePlane, NoRayPassesBetweenTriangles) {
  for (int i = 0; i < 2000; ++i) {
    const Vec3 before = in_plane(-1.0f - rng_.uniform(), rng_.uniform()), behind = near_origin() + Vec3(3, 1, 0);
    const Vec3 left(2.0f, -2.0f, rng_.uniform()), right(-2.0f, 2.0f, rng_.uniform());
    const Ray ray{in_plane(0.1f * rng_.uniform(), 3.0f), in_plane(0.2f * rng_.uniform() - 0.1f, -1.0f)};
    EXPECT_TRUE(meets(ray, {before, behind, left, right}, {{0, 2, 1}, {1, 3, 0}})) << "ray " << i;
  }
}

// Rays through the corner that three triangles have in common, which lies on them exactly.
TEST_F(FewTrianglesOfOnePlane, NoRayPassesThroughACorner) {
  const auto place = [&] { return Vec3(rounded(rng_.uniform()), rounded(rng_.uniform()), rounded(rng_.uniform())); };
  for (int i = 0; i < 5000; ++i) {
    const Ray ray{place() + Vec3(0, 0, 2), 0.5f * place() - Vec3(0, 0, 1)};
    const Vec3 corner = ray.origin + 2.0f * ray.direction;
    const Vec3 ring[] = {Vec3(1, 0, 0), Vec3(-0.5f, 0.8f, 0), Vec3(-0.5f, -0.8f, 0)};
    std::vector<Vec3> corners{corner};
    for (const Vec3& p : ring) corners.push_back(corner + p + 0.1f * in_cube(rng_));
    EXPECT_TRUE(meets(ray, corners, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}})) << "ray " << i;
  }
}

// Rays in the plane of a triangle, away from it.
TEST_F(FewTrianglesOfOnePlane, NoRayMeetsATriangleBesideIt) {
  for (int i = 0; i < 2000; ++i) {
    const Ray away{in_plane(5.0f + rng_.uniform(), 0.0f), in_plane(0.1f + rng_.uniform(), 0.5f * rng_.uniform())};
    EXPECT_FALSE(meets(away, {near_origin(), near_origin(), near_origin() + Vec3(0, 0, 2)}, {{0, 1, 2}}))
        << "ray " << i;
  }
}

// The boundary of a fog before a wall: the layers that are asked for.
TEST(FewTriangles, AreSeenByLayer) {
  Geometry geometry;
  const auto wall = [&](double z, Layer layer) {
    return geometry.add(quad_mesh(Vec3d(-1, -1, z), Vec3d(2, 0, 0), Vec3d(0, 2, 0)), layer);
  };
  const uint32_t fog = wall(1.0, Layer::boundary), behind = wall(2.0, Layer::surface);
  geometry.commit();
  const Ray ray{Vec3(0.1f, 0.2f, 0.0f), Vec3(0.0f, 0.0f, 1.0f)};
  EXPECT_EQ(geometry.intersect(ray)->shape, fog);
  EXPECT_EQ(geometry.intersect_surface(ray, 10.0f)->shape, behind);
  EXPECT_FALSE(geometry.intersect(ray, 1.0f));
}

}  // namespace
}  // namespace vpm
