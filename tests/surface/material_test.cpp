// Materials: directions, weights, Fresnel's equations.
#include "vpm/surface/material/material.h"

#include <gtest/gtest.h>

#include "support/statistics.h"
#include "vpm/base/rng.h"
#include "vpm/base/warp.h"
#include "vpm/surface/material/fresnel.h"

namespace vpm {
namespace {

const Vec3 kNormal = glm::normalize(Vec3(0.3f, 0.8f, -0.5f));

TEST(Fresnel, KnownValues) {
  EXPECT_NEAR(fresnel_dielectric(1.0f, 1.5f), 0.04f, 1e-7f);         // ((n - 1) / (n + 1))^2
  EXPECT_NEAR(fresnel_dielectric(1.0f, 1.0f / 1.5f), 0.04f, 1e-7f);  // the same from inside
  EXPECT_EQ(fresnel_dielectric(0.0f, 1.5f), 1.0f);
  EXPECT_EQ(fresnel_dielectric(0.5f, 1.0f), 0.0f);
  EXPECT_EQ(fresnel_dielectric(0.0f, 1.0f), 0.0f);
  // 60 degrees on glass: with cos t = sqrt(1 - 0.75 / 2.25) = sqrt(2/3).
  const double ct = std::sqrt(2.0 / 3.0), s = (0.5 - 1.5 * ct) / (0.5 + 1.5 * ct), p = (0.75 - ct) / (0.75 + ct);
  EXPECT_NEAR(fresnel_dielectric(0.5f, 1.5f), 0.5 * (s * s + p * p), 1e-6);
  // At Brewster's angle, tan = n, only the perpendicular part is reflected: ((n^2 - 1) / (n^2 + 1))^2 / 2.
  EXPECT_NEAR(fresnel_dielectric(static_cast<float>(std::cos(std::atan(1.5))), 1.5f), 0.5 * std::pow(1.25 / 3.25, 2),
              1e-6);
  // Beyond the critical angle, sin = 1 / 1.5, nothing passes.
  EXPECT_EQ(fresnel_dielectric(0.745f, 1.0f / 1.5f), 1.0f);
  EXPECT_LT(fresnel_dielectric(0.7455f, 1.0f / 1.5f), 1.0f);
}

// Of every index that scene files take, at every cosine, 0 and 1 among them: a share.
TEST(Fresnel, IsAShareForEveryIndex) {
  const auto powers = [](double lo, double hi) {
    std::vector<float> all{static_cast<float>(hi), 1.0f};
    for (double x = lo; x < hi; x *= 1.37) all.push_back(static_cast<float>(x));
    return all;
  };
  std::vector<float> cosines{0.0f, 1.0f, std::nextafter(1.0f, 0.0f), std::sqrt(0.5f), 1e-20f, 1e-42f};
  for (int i = 1; i < 100; ++i) cosines.push_back(0.01f * static_cast<float>(i));
  for (const float eta : powers(kLeastIndex, kLargestIndex))
    for (const float cosine : cosines) {
      const float glass = fresnel_dielectric(cosine, eta);
      ASSERT_TRUE(glass >= 0.0f && glass <= 1.0f) << eta << " at " << cosine << ": " << glass;
      for (const float k : powers(kLeastK, kLargestK)) {
        const float metal = fresnel_conductor(cosine, Rgb(eta), Rgb(k)).r;
        ASSERT_TRUE(metal >= 0.0f && metal <= 1.0f) << eta << ", " << k << " at " << cosine << ": " << metal;
      }
    }
}

TEST(Dielectric, ObeysSnellOnBothSides) {
  Rng rng(1, static_cast<uint64_t>(RngUse::test), 0);
  const Dielectric glass{1.5f};
  for (int i = 0; i < 10000; ++i) {
    const Vec3 travel = uniform_sphere(rng.uniform2());
    const double cosine = glm::dot(Vec3d(kNormal), Vec3d(travel));
    const double eta = cosine < 0.0 ? 1.5 : 1.0 / 1.5;
    const Scatter s = sample_scatter(glass, kNormal, travel, 0.9999999f, rng.uniform2());
    EXPECT_NEAR(glm::length(s.direction), 1.0f, 1e-6f);
    EXPECT_EQ(s.weight, Rgb(1.0f));
    const Vec3d in = glm::cross(Vec3d(kNormal), Vec3d(travel)), out = glm::cross(Vec3d(kNormal), Vec3d(s.direction));
    const double to_side = glm::dot(kNormal, s.direction);
    if (s.transmitted) {
      EXPECT_LT(glm::length(in - eta * out), 5e-7);  // sines and plane of incidence
      EXPECT_GT(to_side * cosine, 0.0);
      EXPECT_FLOAT_EQ(s.radiance_scale, static_cast<float>(1.0 / (eta * eta)));
    } else {
      EXPECT_GT(glm::length(in), eta - 1e-6) << "only total reflection leaves nothing to refract";
      EXPECT_LT(glm::length(in - out), 5e-7);
      EXPECT_LT(to_side * cosine, 0.0);
      EXPECT_EQ(s.radiance_scale, 1.0f);
    }
  }
}

TEST(ThinDielectric, LetsLightPassAsItCame) {
  Rng rng(1, static_cast<uint64_t>(RngUse::test), 0);
  for (const float cosine : {1.0f, 0.6f, 0.15f}) {
    const Vec3 travel(std::sqrt(1.0f - cosine * cosine), 0.0f, -cosine), up(0.0f, 0.0f, 1.0f);
    for (int i = 0; i < 1000; ++i) {
      const Scatter s = sample_scatter(ThinDielectric{1.5f}, up, travel, rng.uniform(), rng.uniform2());
      EXPECT_TRUE(!s.transmitted || s.direction == travel);
      EXPECT_EQ(s.weight, Rgb(1.0f));
      EXPECT_EQ(s.radiance_scale, 1.0f);
    }
  }
}

TEST(Dielectric, RadianceScalesOfEnteringAndLeavingCancel) {
  const Vec3 travel = -direction_about(kNormal, 0.3f, 2.0f);
  const Scatter in = sample_scatter(Dielectric{1.7f}, kNormal, travel, 0.99f, {});
  const Scatter out = sample_scatter(Dielectric{1.7f}, -kNormal, in.direction, 0.99f, {});
  ASSERT_TRUE(in.transmitted && out.transmitted);
  EXPECT_NEAR(in.radiance_scale, 1.0f / (1.7f * 1.7f), 1e-6f);
  EXPECT_NEAR(in.radiance_scale * out.radiance_scale, 1.0f, 1e-6f);
  EXPECT_LT(glm::length(out.direction - travel), 1e-6f);
}

TEST(Materials, BoundaryAndIndexOnePassTheRayToTheLastBit) {
  Rng rng(3, static_cast<uint64_t>(RngUse::test), 0);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 travel = uniform_sphere(rng.uniform2());
    for (const Material& m : {Material(Boundary{}), Material(Dielectric{1.0f})}) {
      const Scatter s = sample_scatter(m, kNormal, travel, 0.0f, rng.uniform2());
      EXPECT_EQ(s.direction, travel);
      EXPECT_EQ(s.weight, Rgb(1.0f));
      EXPECT_TRUE(s.transmitted);
      EXPECT_EQ(s.radiance_scale, 1.0f);
    }
  }
}

// Grazing to the last bit, from both sides: no NaN, unit length, and strictly on the side it says.
TEST(Materials, SurviveGrazingIncidence) {
  Rng rng(4, static_cast<uint64_t>(RngUse::test), 0);
  const Material materials[] = {Lambertian{},
                                Mirror{},
                                Dielectric{1.5f},
                                Dielectric{1.0f / 1.5f},
                                Dielectric{1.0000001f},
                                Dielectric{10.0f},
                                Dielectric{kLeastIndex},
                                Dielectric{kLargestIndex},
                                RoughDielectric{kLeastIndex, 0.1f},
                                RoughDielectric{kLargestIndex, 0.1f},
                                RoughConductor{Rgb(1.0f), Rgb(kLeastK), 0.1f},
                                RoughConductor{Rgb(kLargestIndex), Rgb(kLargestK), 0.1f},
                                Conductor{Rgb(0.05f), Rgb(4.0f)},
                                RoughConductor{Rgb(0.05f), Rgb(4.0f), 0.001f},
                                RoughConductor{Rgb(0.05f), Rgb(4.0f), 1.0f},
                                RoughDielectric{1.5f, 0.001f},
                                RoughDielectric{0.5f, 1.0f},
                                RoughDielectric{1.01f, 0.1f},
                                Phong{Rgb(0.2f), Rgb(0.5f), 1e6f},
                                Phong{Rgb(0.2f), Rgb(0.5f), 0.0f}};
  for (int i = 0; i < 20000; ++i) {
    const Vec3 normal = uniform_sphere(rng.uniform2());
    const float away = 1.0f - (i % 2 == 0 ? 1.0f : -1.0f) * std::pow(10.0f, -12.0f * rng.uniform());
    const Vec3 travel = i % 10 == 0 ? direction_about(normal, 1.0f, 6.28f * rng.uniform())
                                    : direction_about(normal, away, 6.28f * rng.uniform());
    const float before = glm::dot(normal, travel);
    for (const Material& m : materials) {
      const Scatter s = sample_scatter(m, normal, travel, rng.uniform(), rng.uniform2());
      ASSERT_TRUE(is_finite(s.direction) && is_finite(s.weight) && std::isfinite(s.radiance_scale) && s.pdf >= 0.0f);
      ASSERT_NEAR(glm::length(s.direction), 1.0f, 1e-6f);
      const float after = glm::dot(normal, s.direction);
      ASSERT_EQ(s.transmitted ? after < 0.0f : after > 0.0f, before < 0.0f)
          << m.index() << ": " << before << " to " << after;
    }
  }
}

TEST(Mirror, ReflectsAndTints) {
  const Scatter s = sample_scatter(Mirror{Rgb(0.9f, 0.5f, 0.1f)}, {0, 1, 0}, glm::normalize(Vec3(1, -2, 3)), 0.5f, {});
  EXPECT_LT(glm::length(s.direction - glm::normalize(Vec3(1, 2, 3))), 1e-6f);
  EXPECT_EQ(s.weight, Rgb(0.9f, 0.5f, 0.1f));
  EXPECT_FALSE(s.transmitted);
}

TEST(Materials, KnowGreyRoughAndBoundary) {
  EXPECT_TRUE(is_grey(Material(Lambertian{})));
  EXPECT_FALSE(is_grey(Material(Lambertian{Rgb(0.1f, 0.2f, 0.1f)})));
  EXPECT_FALSE(is_grey(Material(Mirror{Rgb(0.1f, 0.2f, 0.1f)})));
  EXPECT_TRUE(is_grey(Material(Dielectric{})) && is_grey(Material(Boundary{})));
  EXPECT_TRUE(is_rough(Lambertian{}));
  EXPECT_FALSE(is_rough(Lambertian{Rgb(0.0f)}) || is_rough(Mirror{}) || is_rough(Dielectric{}) || is_rough(Boundary{}));
  EXPECT_TRUE(is_rough(Phong{}) && is_rough(RoughConductor{}) && is_rough(RoughDielectric{}));
  EXPECT_FALSE(is_rough(ThinDielectric{}) || scatters_through(ThinDielectric{}));
  EXPECT_FALSE(is_rough(Conductor{}) || is_rough(Phong{Rgb(0.0f), Rgb(0.0f), 1.0f}));
  EXPECT_TRUE(scatters_through(RoughDielectric{}) && !scatters_through(RoughConductor{}));
  EXPECT_FALSE(is_grey(Material(RoughConductor{Rgb(1.0f), Rgb(1.0f, 2.0f, 1.0f)})));
  EXPECT_TRUE(is_boundary(Boundary{}) && !is_boundary(Dielectric{}));
}

// weight pdf = value for every sampled direction, on both sides; nothing is scattered to the other side.
TEST(Lambertian, ValueIsWeightTimesDensity) {
  Rng rng(9, static_cast<uint64_t>(RngUse::test), 0);
  const Material diffuse = Lambertian{Rgb(0.2f, 0.5f, 0.9f)};
  for (int i = 0; i < 1000; ++i) {
    const Vec3 travel = uniform_sphere(rng.uniform2());
    const Scatter s = sample_scatter(diffuse, kNormal, travel, rng.uniform(), rng.uniform2());
    const ScatterValue v = scatter_value(diffuse, kNormal, travel, s.direction);
    EXPECT_FLOAT_EQ(v.pdf, std::abs(glm::dot(kNormal, s.direction)) / kPi);
    EXPECT_LT(glm::length(v.value - s.weight * v.pdf), 1e-6f);
    EXPECT_EQ(scatter_value(diffuse, kNormal, travel, -s.direction).pdf, 0.0f);
  }
  EXPECT_EQ(scatter_value(Mirror{}, kNormal, -kNormal, kNormal).value, Rgb(0.0f));
}

}  // namespace
}  // namespace vpm
