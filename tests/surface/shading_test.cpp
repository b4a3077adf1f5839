// Two normals at a hit: where they come from, which light passes, and that photons are the adjoint of eye paths.
#include "vpm/surface/shading.h"

#include <gtest/gtest.h>

#include "support/statistics.h"
#include "vpm/base/error.h"
#include "vpm/base/rng.h"
#include "vpm/base/statistics/tails.h"
#include "vpm/base/warp.h"
#include "vpm/surface/mesh.h"

namespace vpm {
namespace {

/// A triangle in the plane z = 0 that faces +z.
TriangleMesh facing_up() { return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}; }

struct MeshHit : Hit {
  Vec2 uv{0.0f};
};
MeshHit hit_of(const TriangleMesh& mesh, float x, float y) {
  Geometry geometry;
  geometry.add(mesh);
  geometry.commit();
  const auto hit = geometry.intersect({Vec3(x, y, 1), Vec3(0, 0, -1)});
  EXPECT_TRUE(hit.has_value());
  return {*hit, geometry.has_uvs(0) ? geometry.uv(*hit) : Vec2(0.0f)};
}

TEST(ShadingNormal, IsInterpolatedBetweenTheVertices) {
  TriangleMesh mesh = facing_up();
  mesh.normals = {{0, 0, 5}, {1, 0, 1}, {0, 2, 2}};  // of any length
  const float s = std::sqrt(0.5f);
  for (const auto& [x, y] : {std::pair(0.25f, 0.5f), {0.125f, 0.125f}, {0.7f, 0.1f}}) {
    const Vec3 expected = glm::normalize((1 - x - y) * Vec3(0, 0, 1) + x * Vec3(s, 0, s) + y * Vec3(0, s, s));
    const Hit hit = hit_of(mesh, x, y);
    EXPECT_LT(glm::distance(hit.shading_normal, expected), 1e-6f);
    EXPECT_NEAR(glm::length(hit.shading_normal), 1.0f, 1e-6f);
    EXPECT_EQ(hit.normal, Vec3(0, 0, 1));
  }
}

TEST(ShadingNormal, StandsOnTheSideOfTheGeometricOne) {
  TriangleMesh mesh = facing_up();
  mesh.normals.assign(3, Vec3(0.6f, 0, -0.8f));
  EXPECT_LT(glm::distance(hit_of(mesh, 0.3f, 0.3f).shading_normal, Vec3(-0.6f, 0, 0.8f)), 1e-6f);
}

TEST(ShadingNormal, IsTheGeometricOneWhereThereIsNoOther) {
  const TriangleMesh bare{{{0, 0, 0}, {1, 0.1f, 0.3f}, {0.2f, 1, -0.2f}}, {{0, 1, 2}}};
  const Hit hit = hit_of(bare, 0.4f, 0.4f);
  EXPECT_EQ(hit.shading_normal, hit.normal);
  TriangleMesh opposed = facing_up();
  opposed.positions = {{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  opposed.normals = {{-1, 0, 0}, {1, 0, 0}, {0, 0, 1}};  // cancel in the middle of the lower edge
  EXPECT_TRUE(is_finite(hit_of(opposed, 0.0f, 0.0f).shading_normal));
  Geometry geometry;
  geometry.add(SphereShape{});
  geometry.commit();
  const auto on_sphere = geometry.intersect({Vec3(0.3f, 0.2f, 5), Vec3(0, 0, -1)});
  EXPECT_EQ(on_sphere->shading_normal, on_sphere->normal);
}

TEST(TextureCoordinates, OfMeshesAreInterpolated) {
  TriangleMesh mesh = facing_up();
  mesh.uvs = {{2, 3}, {4, 3}, {2, -1}};
  const Vec2 uv = hit_of(mesh, 0.25f, 0.5f).uv;
  EXPECT_NEAR(uv.x, 2.5f, 1e-6f);
  EXPECT_NEAR(uv.y, 1.0f, 1e-6f);
}

TEST(TextureCoordinates, OfQuadsAreTheSharesOfTheEdges) {
  const TriangleMesh quad = quad_mesh(Vec3d(1, 1, 0), Vec3d(2, 0, 0), Vec3d(1, 4, 0));
  for (const auto& [u, v] : {std::pair(0.1f, 0.7f), {0.9f, 0.2f}, {0.5f, 0.25f}}) {
    const Vec2 uv = hit_of(quad, 1 + 2 * u + v, 1 + 4 * v).uv;
    EXPECT_NEAR(uv.x, u, 1e-6f);
    EXPECT_NEAR(uv.y, v, 1e-6f);
  }
}

TEST(TextureCoordinates, OfSpheresAreThoseOfAGlobe) {
  Geometry geometry;
  geometry.add(SphereShape{Vec3(1, 2, 3), 0.5f});
  geometry.commit();
  const float s = std::sqrt(0.5f);
  for (const auto& [normal, uv] : {std::pair(Vec3(0, 0, 1), Vec2(0, 0.5f)),
                                   {Vec3(1, 0, 0), Vec2(0.25f, 0.5f)},
                                   {Vec3(0, 0, -1), Vec2(0.5f, 0.5f)},
                                   {Vec3(-1, 0, 0), Vec2(0.75f, 0.5f)},
                                   {Vec3(s, 0, s), Vec2(0.125f, 0.5f)},
                                   {Vec3(s, s, 0), Vec2(0.25f, 0.75f)},
                                   {Vec3(0, -s, -s), Vec2(0.5f, 0.25f)}}) {
    const Vec2 found = geometry.uv(*geometry.intersect({Vec3(1, 2, 3) + 2.0f * normal, -normal}));
    const float turn = found.x - uv.x;
    EXPECT_NEAR(turn - std::round(turn), 0.0f, 1e-6f);
    EXPECT_NEAR(found.y, uv.y, 1e-6f);
  }
  EXPECT_NEAR(geometry.uv(*geometry.intersect({Vec3(1, 4, 3), Vec3(0, -1, 0)})).y, 1.0f, 1e-3f);
}

TEST(TextureCoordinates, AreWhereTheShapeHasThem) {
  TriangleMesh with = facing_up();
  with.uvs.assign(3, Vec2(0.0f));
  Geometry geometry;
  geometry.add(facing_up());
  geometry.add(with);
  geometry.add(SphereShape{});
  EXPECT_FALSE(geometry.has_uvs(0));
  EXPECT_TRUE(geometry.has_uvs(1));
  EXPECT_TRUE(geometry.has_uvs(2));
}

TEST(VertexAttributes, AreRefusedWhereBad) {
  const auto refused = [](auto change) {
    TriangleMesh mesh = facing_up();
    mesh.normals.assign(3, Vec3(0, 0, 1));
    mesh.uvs.assign(3, Vec2(0.0f));
    change(mesh);
    Geometry geometry;
    EXPECT_THROW(geometry.add(mesh), InputError);
  };
  refused([](TriangleMesh& m) { m.normals.pop_back(); });
  refused([](TriangleMesh& m) { m.uvs.push_back({}); });
  refused([](TriangleMesh& m) { m.normals[1] = Vec3(0.0f); });
  refused([](TriangleMesh& m) { m.normals[1].y = kInfinity; });
  refused([](TriangleMesh& m) { m.uvs[2].x = NAN; });
  refused([](TriangleMesh& m) { m.uvs[2].y = -1e7f; });
}

/// A hit on the plane z = 0 from either side, with a shading normal of its own.
Hit tilted_hit() {
  Hit hit;
  hit.normal = Vec3(0, 0, 1);
  hit.shading_normal = glm::normalize(Vec3(0.5f, -0.2f, 0.8f));
  return hit;
}
const Vec3 kTravels[] = {glm::normalize(Vec3(0.3f, 0.5f, -1)), glm::normalize(Vec3(-1, 0.1f, -0.6f)),
                         glm::normalize(Vec3(0.2f, -0.4f, 0.9f))};

TEST(Shading, WithOneNormalIsTheMaterialsOwn) {
  Hit hit = tilted_hit();
  hit.shading_normal = hit.normal;
  Rng rng(1, rng_stream(RngUse::test, 0), 0);
  for (const Material& material : {Material(Lambertian{}), Material(Mirror{}), Material(Dielectric{})})
    for (const Vec3& travel : kTravels) {
      const float choice = rng.uniform();
      const Vec2 u = rng.uniform2();
      const Scatter a = sample_scatter(material, hit, travel, choice, u);
      const Scatter b = sample_scatter(material, hit.normal, travel, choice, u);
      EXPECT_EQ(a.direction, b.direction);
      EXPECT_EQ(a.weight, b.weight);
      EXPECT_EQ(a.flux_scale, 1.0f);
      EXPECT_EQ(shading_irradiance_scale(hit, travel), 1.0f);
    }
}

TEST(Shading, AbsorbsWhatLiesOnDifferentSidesOfTheNormals) {
  const Hit hit = tilted_hit();
  const Vec3 grazing = glm::normalize(Vec3(1, 0, -0.2f));  // from before the plane, and from behind the shading normal
  for (const Material& material : {Material(Lambertian{}), Material(Mirror{}), Material(Dielectric{})})
    EXPECT_EQ(sample_scatter(material, hit, grazing, 0.999f, Vec2(0.5f)).weight, Rgb(0.0f));
  EXPECT_EQ(shading_irradiance_scale(hit, grazing), 0.0f);
  EXPECT_EQ(scatter_value(Lambertian{}, hit, grazing, hit.shading_normal).value, Rgb(0.0f));
  EXPECT_EQ(scatter_value(Lambertian{}, hit, kTravels[0], -grazing).value, Rgb(0.0f));
  const Vec3 below = glm::normalize(Vec3(1, 0, -0.2f));  // before the shading normal, behind the plane
  ASSERT_GT(glm::dot(below, hit.shading_normal), 0.0f);
  EXPECT_EQ(scatter_value(Lambertian{}, hit, kTravels[0], below).value, Rgb(0.0f));
  const Scatter reflected = sample_scatter(Mirror{}, hit, glm::normalize(Vec3(-1, 0, -0.1f)), 0.5f, Vec2(0.5f));
  EXPECT_GT(reflected.direction.z, 0.0f);
  EXPECT_EQ(sample_scatter(Dielectric{1.0f}, hit, grazing, 0.5f, Vec2(0.5f)).direction, grazing);
  EXPECT_EQ(sample_scatter(Dielectric{1.0f}, hit, grazing, 0.5f, Vec2(0.5f)).weight, Rgb(1.0f));
}

// Flux that photons carry from `travel` into directions weighted by h, against the same by what eye paths see of light
// from there: the integral of value / |cos_g(in)| times |cos_g(out)| h. Two estimates of one number, by z-test.
TEST(Shading, OfDiffuseSurfacesIsAdjoint) {
  const Hit hit = tilted_hit();
  const Material material = Lambertian{Rgb(0.7f)};
  const auto h = [](const Vec3& d) { return 0.5f + d.x * d.x + 0.3f * d.y; };
  for (const Vec3& travel : kTravels) {
    Moments photons, eyes;
    for (uint64_t i = 0; i < 200000; ++i) {
      Rng rng(2, rng_stream(RngUse::test, 0), i);
      const Scatter s = sample_scatter(material, hit, travel, rng.uniform(), rng.uniform2());
      photons.add(s.weight.r * s.flux_scale * h(s.direction));
      const Vec3 out = uniform_sphere(rng.uniform2());
      const float seen = scatter_value(material, hit, -out, -travel).value.r / std::abs(travel.z);
      eyes.add(4.0 * kPiD * seen * std::abs(out.z) * h(out));
    }
    const double error = std::sqrt(photons.variance_of_mean() + eyes.variance_of_mean());
    EXPECT_LT(std::abs(photons.mean() - eyes.mean()), normal_quantile(kFalseAlarms) * error)
        << photons.mean() << " against " << eyes.mean() << " +- " << error;
    EXPECT_LT(error, 0.01 * eyes.mean());
  }
}

// A bundle of solid angle dw keeps its radiance over ior^2 on the way, so its flux changes by
// (ior_out / ior_in)^2 dw_out / dw_in |cos_g(out)| / |cos_g(in)|. The ratio of the solid angles by finite differences.
TEST(Shading, OfSpecularSurfacesKeepsTheRadianceOfABundle) {
  const Hit hit = tilted_hit();
  for (const Material& material : {Material(Mirror{}), Material(Dielectric{1.5f})})
    for (const Vec3& travel : kTravels) {
      const auto out = [&](const Vec3& in) { return sample_scatter(material, hit, in, 0.9999f, Vec2(0.5f)); };
      const Scatter middle = out(travel);
      ASSERT_NE(middle.weight, Rgb(0.0f));
      constexpr float kStep = 2e-3f;
      Vec3 s, t;
      make_frame(travel, s, t);
      const auto difference = [&](const Vec3& along) {
        return (out(glm::normalize(travel + kStep * along)).direction -
                out(glm::normalize(travel - kStep * along)).direction) /
               (2.0f * kStep);
      };
      const float solid_angles = glm::length(glm::cross(difference(s), difference(t)));
      const float expected = solid_angles / middle.radiance_scale * std::abs(middle.direction.z) / std::abs(travel.z);
      EXPECT_NEAR(middle.flux_scale / expected, 1.0f, 1e-3f);
    }
}

}  // namespace
}  // namespace vpm
