// Light that arrives at a point: the mean of sample_towards() against closed forms.
#include <gtest/gtest.h>

#include "light/lights.h"
#include "support/statistics.h"
#include "vpm/base/statistics/tails.h"
#include "vpm/surface/mesh.h"

namespace vpm {
namespace {

/// Samples of irradiance on a surface of normal `normal` at `point`, red channel; its pdf and direction are checked on
/// the way.
Moments irradiance(const Light& light, const Vec3& point, const Vec3& normal, uint64_t index, int samples = 100000) {
  Rng rng = test_rng(index);
  Moments moments;
  for (int i = 0; i < samples; ++i) {
    const auto in = sample_towards(light, point, rng);
    moments.add(in ? in->irradiance.r * std::max(0.0f, glm::dot(normal, in->direction)) : 0.0);
    if (!in) continue;
    EXPECT_NEAR(glm::length(in->direction), 1.0f, 1e-6f);
    EXPECT_GT(in->distance, 0.0f);
  }
  return moments;
}

TEST(Incident, PointLightFallsWithTheSquare) {
  Rng rng = test_rng(0);
  const auto in = sample_towards(PointLight{{0, 3, 4}, Rgb(50, 25, 5)}, {0, 0, 0}, rng);
  ASSERT_TRUE(in);
  EXPECT_EQ(in->irradiance, Rgb(2, 1, 0.2f));
  EXPECT_EQ(in->distance, 5.0f);
  EXPECT_EQ(in->pdf, 0.0f);
  EXPECT_LT(glm::length(in->direction - Vec3(0, 0.6f, 0.8f)), 1e-6f);
  EXPECT_FALSE(sample_towards(PointLight{}, {0, 0, 0}, rng));
}

TEST(Incident, SpotHasFullIntensityWithinHalfAtTheMiddleOfTheRimAndNoneOutside) {
  Rng rng = test_rng(1);
  const SpotLight spot{{0, 0, 0}, {0, -1, 0}, 0.9f, 0.7f, Rgb(4)};
  const auto at = [&](float cosine) {
    return sample_towards(spot, 2.0f * Vec3(std::sqrt(1.0f - cosine * cosine), -cosine, 0.0f), rng);
  };
  EXPECT_NEAR(at(0.95f)->irradiance.r, 1.0f, 1e-6f);
  EXPECT_NEAR(at(0.8f)->irradiance.r, 0.5f, 1e-5f);
  EXPECT_NEAR(at(0.75f)->irradiance.r, 3.0f / 16 - 2.0f / 64, 1e-5f);
  EXPECT_FALSE(at(0.69f));
  EXPECT_FALSE(at(-0.9f));
}

TEST(Incident, BeamLightsItsCylinderOnly) {
  Rng rng = test_rng(2);
  const BeamLight beam{{0, 1, 0}, {0, -1, 0}, 0.5f, Rgb(kPi)};
  const auto in = sample_towards(beam, {0.3f, -2, 0.3f}, rng);
  ASSERT_TRUE(in);
  EXPECT_FLOAT_EQ(in->irradiance.r, 4.0f);
  EXPECT_EQ(in->direction, Vec3(0, 1, 0));
  EXPECT_FLOAT_EQ(in->distance, 3.0f);
  EXPECT_EQ(in->pdf, 0.0f);
  EXPECT_FALSE(sample_towards(beam, {0.4f, -2, 0.4f}, rng));
  EXPECT_FALSE(sample_towards(beam, {0, 1.5f, 0}, rng));
}

TEST(Incident, DirectionalLightIsEverywhereTheSame) {
  Rng rng = test_rng(3);
  const auto in = sample_towards(DirectionalLight{{0, 0, 1}, Rgb(1, 2, 3)}, {100, 200, 300}, rng);
  ASSERT_TRUE(in);
  EXPECT_EQ(in->irradiance, Rgb(1, 2, 3));
  EXPECT_EQ(in->direction, Vec3(0, 0, -1));
  EXPECT_TRUE(std::isinf(in->distance));
  EXPECT_EQ(in->pdf, 0.0f);
}

// E = pi L (R/d)^2 cos for a sphere above the horizon, from just off it to a million radii. False-alarm rate 1e-5 for
// each distance.
TEST(Incident, SphereMatchesItsFormFactor) {
  const Vec3 towards = glm::normalize(Vec3(0.2f, 0.9f, 0.3f));
  for (const double distance : {1.0001, 1.5, 4.0, 1e3, 1e6}) {
    const SphereLight sphere{static_cast<float>(0.5 * distance) * towards, 0.5f, Rgb(2)};
    const double expected = 2.0 * kPiD / (distance * distance);
    const Moments m = irradiance(sphere, {0, 0, 0}, towards, 20);
    EXPECT_NEAR(m.mean() / expected, 1.0, 1e-6 + normal_quantile(1e-5) * std::sqrt(m.variance_of_mean()) / expected)
        << distance;
  }
  Rng rng = test_rng(21);
  EXPECT_FALSE(sample_towards(SphereLight{{0, 0, 0}, 1.0f, Rgb(1)}, {0.5f, 0.5f, 0.5f}, rng));
}

TEST(Incident, SphereIsMetAtItsNearSide) {
  const SphereLight sphere{{3, 4, 12}, 2.0f, Rgb(1)};
  Rng rng = test_rng(22);
  for (int i = 0; i < 10000; ++i) {
    const auto in = sample_towards(sphere, {0, 0, 0}, rng);
    ASSERT_TRUE(in);
    const Vec3 p = in->distance * in->direction;
    ASSERT_NEAR(glm::length(p - sphere.center), 2.0f, 2e-5f);
    ASSERT_LE(in->distance, std::sqrt(169.0f - 4.0f) + 1e-4f);
    ASSERT_FLOAT_EQ(in->pdf * in->irradiance.r, 1.0f);
  }
}

TEST(Incident, RadianceIsSeenFromTheFrontOnly) {
  const Light disc = DiscLight{{}, {0, 0, 1}, 1.0f, Rgb(6)};
  const Light mesh = MeshLight{std::make_shared<const EmittingMesh>(test_tetrahedron()), Rgb(7)};
  for (const auto& [light, radiance] : {std::pair(disc, 6.0f), {mesh, 7.0f}}) {
    EXPECT_EQ(surface_radiance(light, {0, 0, 1}, {0, 0, -1}), Rgb(radiance));
    EXPECT_EQ(surface_radiance(light, {0, 0, 1}, {0, 0, 1}), Rgb(0));
  }
  const Light quad = QuadLight{{}, {1, 0, 0}, {0, 1, 0}, Rgb(3)}, sphere = SphereLight{{}, 1.0f, Rgb(4)};
  EXPECT_EQ(surface_radiance(quad, {0, 0, 1}, {0, 0, -1}), Rgb(3));
  EXPECT_EQ(surface_radiance(quad, {0, 0, 1}, {0, 0, 1}), Rgb(0));
  EXPECT_EQ(irradiance(quad, {0, 0, -1}, {0, 0, 1}, 11, 1000).mean(), 0.0);
  EXPECT_EQ(irradiance(disc, {0, 0, -1}, {0, 0, 1}, 24, 1000).mean(), 0.0);
  EXPECT_EQ(surface_radiance(sphere, {0, 0, 1}, {0, 0, -1}), Rgb(4));
  EXPECT_EQ(surface_radiance(PointLight{}, {0, 0, 1}, {0, 0, -1}), Rgb(0));
  EXPECT_EQ(environment_radiance(ConstantEnvironment{Rgb(5)}, {0, 0, 1}), Rgb(5));
  EXPECT_EQ(environment_radiance(quad, {0, 0, 1}), Rgb(0));
}

TEST(Lights, KnowGreyAndInfinite) {
  int infinite = 0;
  for (const Light& light : test_lights()) {
    EXPECT_FALSE(is_grey(light));
    infinite += is_infinite(light) ? 1 : 0;
  }
  EXPECT_EQ(infinite, 3);
  EXPECT_TRUE(is_grey(Light(PointLight{})) && is_grey(Light(SphereLight{})) && is_grey(Light(QuadLight{})));
}

/// The outward normal of a light's surface at a point of it; of no meaning for other lights.
Vec3 normal_at(const Light& light, const Vec3& point) {
  if (const auto* quad = std::get_if<QuadLight>(&light)) return glm::normalize(glm::cross(quad->edge_u, quad->edge_v));
  if (const auto* disc = std::get_if<DiscLight>(&light)) return disc->normal;
  if (!std::holds_alternative<MeshLight>(light)) return Vec3(0.0f);
  const TriangleMesh mesh = test_tetrahedron();
  Vec3 normal(0.0f);
  for (float nearest = kInfinity; const glm::uvec3& t : mesh.triangles) {
    const Vec3 a = mesh.positions[t.x];
    const Vec3 n = glm::normalize(glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a));
    const float away = std::abs(glm::dot(n, point - a));
    if (away < nearest) nearest = away, normal = n;
  }
  return normal;
}

TEST(Incident, ComesFromAPointDrawnBeforehandAsFromOthers) {
  const Vec3 point(0.3f, -0.4f, 0.2f);
  for (const Light& light : test_lights()) {
    Rng rng = test_rng(30 + light.index());
    std::vector<Moments> before(3), at_once(3);
    bool is_drawn = false;
    for (int i = 0; i < 20'000; ++i) {
      const auto from = draw_light_point(light, rng);
      is_drawn = from.has_value();
      if (!from) break;
      const auto in = sample_towards(light, *from, point, rng), other = sample_towards(light, point, rng);
      for (int c = 0; c < 3; ++c) {
        before[c].add(in ? in->irradiance[c] : 0.0);
        at_once[c].add(other ? other->irradiance[c] : 0.0);
      }
      if (from->area > 0.0f && in) {
        ASSERT_LT(glm::distance(point + in->distance * in->direction, from->position), 1e-5f);
      }
    }
    EXPECT_EQ(is_drawn, !is_infinite(light) && !std::holds_alternative<BeamLight>(light)) << light_kind(light);
    if (is_drawn) expect_same_means(before, at_once, 1e-6, std::string(light_kind(light)));
  }
}

// What sample_towards() says of its own density is what incident_pdf() says of the same direction.
TEST(Incident, TheDensityOfADirectionIsThatOfItsSample) {
  Rng rng = test_rng(20);
  const Vec3 point(0.3f, -0.4f, 0.2f);
  for (const Light& light : test_lights()) {
    int different = 0;
    for (int i = 0; i < 1000; ++i) {
      const auto in = sample_towards(light, point, rng);
      if (!in) continue;
      const Vec3 normal = normal_at(light, point + in->distance * in->direction);
      different +=
          std::abs(incident_pdf(light, point, {in->direction, in->distance, normal}) - in->pdf) > 1e-4f * in->pdf;
    }
    // A direction at the border of two texels may be rounded into the other one.
    EXPECT_LE(different, std::holds_alternative<EnvironmentMap>(light) ? 5 : 0) << light.index();
  }
  EXPECT_EQ(incident_pdf(SphereLight{{0, 0, 0}, 1.0f, Rgb(1)}, {0.5f, 0, 0}, {{1, 0, 0}, 0.5f}), 0.0f) << "inside";
  EXPECT_EQ(incident_pdf(QuadLight{}, {0.5f, 0.5f, -1.0f}, {{0, 0, 1}, 1.0f, {0, 0, 1}}), 0.0f) << "behind";
}

}  // namespace
}  // namespace vpm
