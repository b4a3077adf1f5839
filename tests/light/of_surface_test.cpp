// Lights that surfaces are, where lights stand, and which of them are even.
#include "vpm/light/of_surface.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "light/lights.h"
#include "vpm/base/error.h"

namespace vpm {
namespace {

TEST(LightOfSurface, KeepsPlaceAndNormal) {
  const auto sphere = std::get<SphereLight>(light_of(SphereShape{{1, 2, 3}, 0.5f}, Rgb(7)));
  EXPECT_TRUE(sphere.center == Vec3(1, 2, 3) && sphere.radius == 0.5f && sphere.radiance == Rgb(7));
  const auto disc = std::get<DiscLight>(light_of(DiscShape{{1, 2, 3}, {0, 0, 1}, 0.5f}, Rgb(7)));
  EXPECT_TRUE(disc.center == Vec3(1, 2, 3) && disc.normal == Vec3(0, 0, 1) && disc.radius == 0.5f);
  const auto mesh = std::get<MeshLight>(light_of(box_mesh(Vec3d(0), Vec3d(1)), Rgb(7)));
  EXPECT_DOUBLE_EQ(mesh.mesh->area(), 6.0);
}

TEST(LightOfSurface, IsNoMeshWithoutArea) {
  EXPECT_THROW(EmittingMesh(TriangleMesh{{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {{0, 1, 2}}}), InputError);
}

TEST(LightOfSurface, AQuadKeepsItsNormalUnderMirrors) {
  for (const double z : {1.0, -1.0}) {
    QuadMesh quad{quad_mesh(Vec3d(0), Vec3d(0, 0, 2), Vec3d(3, 0, 0))};
    transform_mesh(glm::scale(Mat4d(1.0), Vec3d(1, 1, z)), quad.mesh);
    const auto light = std::get<QuadLight>(light_of(quad, Rgb(7)));
    EXPECT_EQ(glm::cross(light.edge_u, light.edge_v), Vec3(0, 6, 0)) << z;
  }
}

TEST(LightPlace, HoldsWhatPhotonsStartFrom) {
  for (const Light& light : test_lights()) {
    SCOPED_TRACE(light_kind(light));
    const std::optional<LightPlace> place = light_place(light);
    ASSERT_EQ(place.has_value(), !is_infinite(light));
    if (!place) continue;
    const Box wider{place->bounds.lo - 1e-5f, place->bounds.hi + 1e-5f};
    const auto inside = [&](const Vec3& p) {
      return glm::all(glm::greaterThanEqual(p, wider.lo)) && glm::all(glm::lessThanEqual(p, wider.hi));
    };
    EXPECT_TRUE(inside(place->point));
    Rng rng = test_rng(1);
    for (int i = 0; i < 1000; ++i) ASSERT_TRUE(inside(emit(light, kScene, rng).ray.origin));
  }
}

TEST(LightPlace, IsBeforeTheSurface) {
  EXPECT_GT(light_place(QuadLight{})->point.z, 0.0f);
  EXPECT_GT(light_place(DiscLight{})->point.y, 0.0f);
  EXPECT_GT(glm::length(light_place(SphereLight{})->point), 1.0f);
}

TEST(EvenRadiance, IsThatOfTheConstantEnvironmentAlone) {
  for (const Light& light : test_lights()) {
    const bool constant = light_kind(light) == "constant environment";
    EXPECT_EQ(even_radiance(light).has_value(), constant) << light_kind(light);
    EXPECT_EQ(is_surface(light), light_place(light) && surface_radiance(light, {0, 1, 0}, {0, -1, 0}) != Rgb(0));
  }
  EXPECT_EQ(even_radiance(ConstantEnvironment{Rgb(1, 2, 3)}), Rgb(1, 2, 3));
}

}  // namespace
}  // namespace vpm
