// Emission of photons: exact power, and where photons start.
#include <gtest/gtest.h>

#include "light/lights.h"
#include "vpm/base/warp.h"
#include "vpm/surface/mesh.h"

namespace vpm {
namespace {

// Of a picture of odd numbers of rows and columns, whose texels lie across the axes: the area that the box shows,
// integrated over the directions by the midpoint rule.
TEST(Emission, PowerOfAMapIsTheIntegralOfTheAreaShown) {
  std::vector<Rgb> texels;
  for (int i = 0; i < 35; ++i) texels.emplace_back(static_cast<float>((7 * i) % 11) + 0.5f, i % 3, 1.0f);
  const EnvironmentMap map{std::make_shared<const ImageEnvironment>(7, 5, texels)};
  const Vec3d e(kScene.extent()), faces(e.y * e.z, e.z * e.x, e.x * e.y);
  Rgbd power(0.0);
  constexpr int kRows = 1000, kColumns = 1400;
  for (int r = 0; r < kRows; ++r) {
    for (int c = 0; c < kColumns; ++c) {
      const double theta = (r + 0.5) * kPiD / kRows, phi = (c + 0.5) * 2.0 * kPiD / kColumns;
      const Vec3d d(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
      const double solid_angle = std::sin(theta) * kPiD / kRows * 2.0 * kPiD / kColumns;
      power += Rgbd(texels[r / 200 * 7 + c / 200]) * glm::dot(glm::abs(d), faces) * solid_angle;
    }
  }
  const Rgb stated = light_power(map, kScene);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(stated[c] / power[c], 1.0, 1e-5) << "channel " << c;
}

TEST(Emission, EveryPhotonCarriesThePowerExceptThoseOfAMap) {
  for (const Light& light : test_lights()) {
    Rng rng = test_rng(light.index());
    const Rgb power = light_power(light, kScene);
    for (int i = 0; i < 20000; ++i) {
      const Emission e = emit(light, kScene, rng);
      ASSERT_NEAR(glm::length(e.ray.direction), 1.0f, 1e-6f);
      ASSERT_TRUE(e.power == power || std::holds_alternative<EnvironmentMap>(light)) << light.index();
    }
  }
}

TEST(Emission, FromInfinityStartsOutsideTheSceneAndEntersIt) {
  for (const Light& light : test_lights()) {
    if (!is_infinite(light)) continue;
    Rng rng = test_rng(300 + light.index());
    for (int i = 0; i < 10000; ++i) {
      const Ray ray = emit(light, kScene, rng).ray;
      int faces = 0;  // that the photon starts on and leaves inwards
      for (int a = 0; a < 3; ++a) {
        ASSERT_TRUE(kScene.lo[a] <= ray.origin[a] && ray.origin[a] <= kScene.hi[a]);
        faces += ray.origin[a] == (ray.direction[a] > 0.0f ? kScene.lo[a] : kScene.hi[a]) ? 1 : 0;
      }
      ASSERT_GE(faces, 1);
    }
  }
}

// Light across a plate without thickness comes through its two sides only, and light along it does not arrive.
TEST(Emission, FromInfinityEntersAPlate) {
  const Box plate{{-1, 2, -1}, {1, 2, 1}};
  Rng rng = test_rng(301);
  for (const Light& light : test_lights()) {
    if (!is_infinite(light)) continue;
    for (int i = 0; i < 1000; ++i) {
      const Ray ray = emit(light, plate, rng).ray;
      ASSERT_EQ(ray.origin.y, 2.0f);
      ASSERT_TRUE(is_finite(ray.origin) && is_finite(ray.direction));
    }
  }
  EXPECT_EQ(light_power(DirectionalLight{{1, 0, 0}, Rgb(2)}, plate), Rgb(0));
  EXPECT_FLOAT_EQ(light_power(ConstantEnvironment{Rgb(2)}, plate).r, 16.0f * kPi);
}

// A million photons of area lights that are shapes of the scene, near the origin and far from it, small and large.
TEST(Emission, NeverMeetsItsOwnEmitter) {
  Rng rng = test_rng(400);
  for (int k = 0; k < 1000; ++k) {
    const float away = std::pow(10.0f, -4.0f + 10.0f * rng.uniform());
    const float size = std::max(std::pow(10.0f, -4.0f + 10.0f * rng.uniform()), 1e-5f * away);
    const Vec3 corner = away * uniform_sphere(rng.uniform2());
    const Vec3 u = size * uniform_sphere(rng.uniform2()), v = size * uniform_sphere(rng.uniform2());
    Geometry quad;
    quad.add(TriangleMesh{{corner, corner + u, corner + u + v, corner + v}, {{0, 1, 2}, {0, 2, 3}}});
    quad.commit();
    Geometry mesh;  // a box, which is met no more from any of its faces
    const TriangleMesh box = box_mesh(Vec3d(corner), Vec3d(corner + size * Vec3(1.0f, 0.5f, 0.7f)));
    const MeshLight mesh_light{std::make_shared<const EmittingMesh>(box), Rgb(1)};
    mesh.add(box);
    mesh.commit();
    Geometry disc;
    const DiscLight disc_light{corner, glm::normalize(glm::cross(u, v)), size, Rgb(1)};
    disc.add(DiscShape{disc_light.center, disc_light.normal, disc_light.radius});
    disc.commit();
    Geometry sphere;
    sphere.add(SphereShape{corner, size});
    sphere.commit();
    for (int i = 0; i < 500; ++i) {
      const Ray from_quad = emit(QuadLight{corner, u, v, Rgb(1)}, kScene, rng).ray;
      ASSERT_FALSE(quad.intersect(from_quad)) << "quad of " << size << " at " << away;
      ASSERT_FALSE(mesh.intersect(emit(mesh_light, kScene, rng).ray)) << "box of " << size << " at " << away;
      ASSERT_FALSE(disc.intersect(emit(disc_light, kScene, rng).ray)) << "disc of " << size << " at " << away;
      const Ray from_sphere = emit(SphereLight{corner, size, Rgb(1)}, kScene, rng).ray;
      ASSERT_FALSE(sphere.intersect(from_sphere)) << "sphere of " << size << " at " << away;
    }
  }
}

}  // namespace
}  // namespace vpm
