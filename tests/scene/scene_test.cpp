// What finish() derives, and the medium at a point among nested shapes.
#include "vpm/scene/scene.h"

#include <gtest/gtest.h>

#include "support/scenes.h"
#include "vpm/base/error.h"
#include "vpm/base/rng.h"
#include "vpm/base/warp.h"

namespace vpm {
namespace {

constexpr bool kSeparates = true;

template <class S>
void add(Scene& scene, const S& geometry, bool separates = false, Interface media = {}) {
  scene.geometry.add(geometry, separates ? Layer::boundary : Layer::surface);
  Shape shape;
  shape.separates_media = separates;
  shape.media = media;
  scene.shapes.push_back(shape);
}

/// World medium 0; in it a box of medium 1, in that a sphere of medium 2 with a vacuum box inside. An opaque ball that
/// separates nothing stands in the outer box, another outside.
Scene nested() {
  Scene scene;
  scene.media.resize(3);
  scene.materials = {Boundary{}};
  scene.world_medium = 0;
  add(scene, box_mesh(Vec3(-4), Vec3(4)), kSeparates, {1, 0});
  add(scene, SphereShape{{0, 0, 0}, 2.0f}, kSeparates, {2, 1});
  add(scene, box_mesh(Vec3(-1), Vec3(1)), kSeparates, {kVacuum, 2});
  add(scene, SphereShape{{3, 3, 3}, 0.5f});
  add(scene, SphereShape{{6, 0, 0}, 0.5f});
  scene.geometry.commit();
  return scene;
}

MediumId nested_truth(const Vec3& p) {
  const Vec3 a = glm::abs(p);
  const float reach = std::max(a.x, std::max(a.y, a.z));
  if (reach < 1.0f) return kVacuum;
  if (glm::length(p) < 2.0f) return 2;
  return reach < 4.0f ? 1 : 0;
}

TEST(MediumAt, KnowsNestedBoxesAndSpheres) {
  const Scene scene = nested();
  Rng rng(1, static_cast<uint64_t>(RngUse::test), 0);
  int seen[4] = {};
  for (int i = 0; i < 20000; ++i) {
    const Vec3 p = (i % 2 == 0 ? 6.0f : 2.5f) * (2.0f * Vec3(rng.uniform(), rng.uniform(), rng.uniform()) - 1.0f);
    const MediumId truth = nested_truth(p);
    ++seen[truth + 1];
    ASSERT_EQ(medium_at(scene, p), truth) << p.x << " " << p.y << " " << p.z;
  }
  for (const int count : seen) EXPECT_GT(count, 500);
}

TEST(MediumAt, DecidesJustOffASurface) {
  const Scene scene = nested();
  Rng rng(2, static_cast<uint64_t>(RngUse::test), 0);
  for (int i = 0; i < 20000; ++i) {
    const Ray ray{9.0f * uniform_sphere(rng.uniform2()), uniform_sphere(rng.uniform2())};
    const auto hit = scene.geometry.intersect(ray);
    if (!hit || !scene.shapes[hit->shape].separates_media) continue;
    // Close to an edge both sides of its other face are within rounding.
    const Vec3 a = glm::abs(hit->position);
    if (hit->shape == 0 && (a.x > 3.9999f) + (a.y > 3.9999f) + (a.z > 3.9999f) > 1) continue;
    const Interface& media = scene.shapes[hit->shape].media;
    ASSERT_EQ(medium_at(scene, leave_surface(*hit, hit->normal)), media.outside);
    ASSERT_EQ(medium_at(scene, leave_surface(*hit, -hit->normal)), media.inside);
  }
}

TEST(MediumAt, IsTheWorldsWhereNothingSeparates) {
  Scene scene;
  scene.world_medium = 3;
  add(scene, SphereShape{{0, 0, 0}, 2.0f});
  scene.geometry.commit();
  EXPECT_EQ(medium_at(scene, {0, 0, 0}), 3);
  EXPECT_EQ(medium_at(scene, {5, 0, 0}), 3);
  Scene empty;
  empty.geometry.commit();
  EXPECT_EQ(medium_at(empty, {0, 0, 0}), kVacuum);
}

TEST(Finish, BoundsTheShapes) {
  Scene scene = nested();
  finish(scene);
  const Box shapes{{-4, -4, -4}, {6.5f, 4, 4}};
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(scene.bounds.lo[i] < shapes.lo[i] && scene.bounds.lo[i] > shapes.lo[i] - 1e-5f);
    EXPECT_TRUE(scene.bounds.hi[i] > shapes.hi[i] && scene.bounds.hi[i] < shapes.hi[i] + 1e-5f);
  }
  Scene empty;
  empty.geometry.commit();
  finish(empty);
  EXPECT_EQ(empty.bounds.center(), Vec3(0));
  EXPECT_FLOAT_EQ(empty.bounds.diagonal(), 2.0f);
  EXPECT_TRUE(empty.grey);
}

TEST(Finish, FindsTheMediaOfLights) {
  Scene scene = nested();
  const TriangleMesh lid = quad_mesh(Vec3d(-1, 4, -1), Vec3d(2, 0, 0), Vec3d(0, 0, 2));
  scene.lights = {PointLight{{1.5f, 0, 0}, Rgb(1)},
                  PointLight{{0, 0, 0}, Rgb(1)},
                  BeamLight{{0, 5, 0}, {0, -1, 0}, 0.1f, Rgb(1)},
                  SpotLight{{0, 3, 0}, {0, -1, 0}, 0.9f, 0.8f, Rgb(1)},
                  SphereLight{{0, 0, 0}, 2.0f, Rgb(1)},  // boundaries within its bounds: decided photon by photon
                  QuadLight{{-1, 4, -1}, {2, 0, 0}, {0, 0, 2}, Rgb(1)},  // on the outer box's lid, facing down
                  QuadLight{{-1, 4, -1}, {0, 0, 2}, {2, 0, 0}, Rgb(1)},  // facing up
                  DirectionalLight{},
                  DiscLight{{0, 4, 0}, {0, -1, 0}, 1.0f, Rgb(1)},  // as the quads
                  DiscLight{{0, 4, 0}, {0, 1, 0}, 1.0f, Rgb(1)},
                  MeshLight{std::make_shared<const EmittingMesh>(lid), Rgb(1)}};
  finish(scene);
  EXPECT_EQ(scene.light_medium, (std::vector<MediumId>{2, kVacuum, 0, 1, kSeveralMedia, 1, 0, 0, 1, 0, 1}));
}

TEST(Finish, ChoosesLightsByMeanPower) {
  Scene scene;
  scene.geometry.commit();
  scene.lights = {BeamLight{{}, {0, -1, 0}, 1.0f, Rgb(3, 0, 0)}, BeamLight{{}, {0, -1, 0}, 1.0f, Rgb(0)},
                  BeamLight{{}, {0, -1, 0}, 1.0f, Rgb(1, 2, 6)}};
  finish(scene);
  EXPECT_EQ(scene.light_probability, (std::vector<double>{0.25, 0.0, 0.75}));
  EXPECT_FALSE(scene.grey);
  Scene dark;
  dark.geometry.commit();
  dark.lights = {PointLight{{}, Rgb(0)}};
  EXPECT_THROW(finish(dark), InputError);
}

TEST(Finish, IsGreyOnlyWhereEverythingIs) {
  const auto grey = [](const Light& light, const Material& material, const Rgb& sigma) {
    Scene scene;
    scene.geometry.commit();
    scene.lights = {light};
    scene.materials = {material};
    scene.media.resize(1);
    scene.media[0].sigma_t = sigma;
    finish(scene);
    return scene.grey;
  };
  const Rgb red(1.0f, 0.5f, 0.5f);
  EXPECT_TRUE(grey(PointLight{}, Lambertian{}, Rgb(1)));
  EXPECT_FALSE(grey(PointLight{{}, red}, Lambertian{}, Rgb(1)));
  EXPECT_FALSE(grey(PointLight{}, Lambertian{red}, Rgb(1)));
  EXPECT_FALSE(grey(PointLight{}, Lambertian{}, red));
}

}  // namespace
}  // namespace vpm
