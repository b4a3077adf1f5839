// Rough materials and metals: lobes, energy, reciprocity, Fresnel's equations.
#include <gtest/gtest.h>

#include <complex>

#include "vpm/base/rng.h"
#include "vpm/base/warp.h"
#include "vpm/study/validate/scenes/lobes.h"
#include "vpm/surface/material/facet_loss.h"
#include "vpm/surface/material/fresnel.h"
#include "vpm/surface/material/metals.h"
#include "vpm/surface/material/microfacet.h"

namespace vpm {
namespace {

const Vec3 kRoughNormal = glm::normalize(Vec3(0.3f, 0.8f, -0.5f));

/// A direction of travel towards that side of the surface.
Vec3 arriving(double angle, bool from_outside = true) {
  return -direction_about(from_outside ? kRoughNormal : -kRoughNormal, static_cast<float>(1.0 - std::cos(angle)), 1.0f);
}

/// The reflectance in complex numbers.
double reflectance(double cosine, double eta, double k) {
  const std::complex<double> index(eta, k), across = std::sqrt(index * index - (1.0 - cosine * cosine));
  return 0.5 * (std::norm((cosine - across) / (cosine + across)) +
                std::norm((index * index * cosine - across) / (index * index * cosine + across)));
}

TEST(FresnelOfConductors, EqualsThatOfComplexNumbers) {
  for (const double eta : {0.04, 0.4, 1.0, 3.0})
    for (const double k : {0.01, 0.5, 3.0, 14.0})
      for (const double cosine : {0.0, 1e-3, 0.3, 0.9, 1.0})
        EXPECT_NEAR(fresnel_conductor(static_cast<float>(cosine), Rgb(eta), Rgb(k)).g, reflectance(cosine, eta, k),
                    2e-6)
            << eta << " + i " << k << " at " << cosine;
}

TEST(FresnelOfConductors, IsThatOfDielectricsWithoutAbsorption) {
  for (const float eta : {1.5f, 2.4f})
    for (const float cosine : {0.1f, 0.5f, 0.8f, 1.0f})
      EXPECT_NEAR(fresnel_conductor(cosine, Rgb(eta), Rgb(1e-6f)).r, fresnel_dielectric(cosine, eta), 1e-6f);
}

// The colours that everyone knows: gold and copper redden white light in this order, the others hardly.
TEST(Metals, HaveTheirColours) {
  for (const Metal& metal : kMetals) {
    const Rgb seen = fresnel_conductor(1.0f, metal.eta, metal.k);
    const bool coloured = metal.name == std::string("gold") || metal.name == std::string("copper");
    EXPECT_EQ(seen.r > 1.5f * seen.b, coloured) << metal.name;
    EXPECT_EQ(seen.r > 0.9f, metal.name != std::string("iron")) << metal.name;
  }
}

// Facets project to the surface's area; those that a direction sees, to the area that it sees. Midpoint rules.
TEST(Microfacets, CoverTheSurface) {
  for (const float alpha : {0.01f, 0.2f, 1.0f})
    for (const double angle : {0.0, 0.7, 1.5}) {
      const Microfacets facets(alpha);
      const Vec3 v(std::sin(angle), 0.0f, std::cos(angle));
      constexpr int kRings = 2000, kTurns = 100;
      double area = 0.0, seen = 0.0;
      for (int i = 0; i < kRings; ++i)
        for (int j = 0; j < kTurns; ++j) {
          const double x = (i + 0.5) / kRings, tan = alpha * x / (1.0 - x), turn = 2.0 * kPiD * (j + 0.5) / kTurns;
          const double z = 1.0 / std::sqrt(1.0 + tan * tan), r = tan * z;
          const Vec3 h(r * std::cos(turn), r * std::sin(turn), z);
          const double solid_angle =  // -d(cos) / dx over the equal parts of x
              tan * z * z * z * alpha / ((1.0 - x) * (1.0 - x)) / kRings * 2.0 * kPiD / kTurns;
          area += facets.density(h) * h.z * solid_angle;
          seen += facets.density(h) * facets.masking(v) * std::max(0.0f, glm::dot(v, h)) * solid_angle;
        }
      EXPECT_NEAR(area, 1.0, 1e-4) << alpha;
      EXPECT_NEAR(seen, 1.0, 1e-3) << alpha << " at " << angle;
    }
}

double albedo(const Material& material, double angle) {
  const LobeCells::Integrals all = LobeCells({material, kRoughNormal, arriving(angle)}).integrate();
  return all.near + all.far;
}

// Metal that absorbs nothing, seen along its normal: facets at an angle x send light away at 2 x, up to pi/4. For
// roughness 1 the integral is 1 - ln 2.
TEST(RoughConductor, LosesWhatWouldMeetASecondFacet) {
  const auto perfect = [](float roughness) { return RoughConductor{Rgb(1.0f), Rgb(1e6f), roughness}; };
  EXPECT_NEAR(albedo(perfect(1.0f), 0.0), 1.0 - std::log(2.0), 1e-3);
  EXPECT_NEAR(albedo(perfect(0.001f), 0.3), 1.0, 1e-3);
  for (const double alpha : {0.1, 0.3, 0.5}) {
    double exact = 0.0;
    constexpr int kSteps = 10000;
    for (int i = 0; i < kSteps; ++i) {
      const double x = 0.25 * kPiD * (i + 0.5) / kSteps, tan = std::tan(x), tan_after = std::tan(2.0 * x);
      const double facets = 2.0 * tan / std::pow(std::cos(x) * alpha * (1.0 + tan * tan / (alpha * alpha)), 2);
      exact += facets * 2.0 / (1.0 + std::sqrt(1.0 + alpha * alpha * tan_after * tan_after)) * 0.25 * kPiD / kSteps;
    }
    EXPECT_NEAR(albedo(perfect(static_cast<float>(alpha)), 0.0), exact, 1e-3) << alpha;
  }
}

/// A material of microfacets that gives back what its main lobes lose.
class Lossless {
 public:
  explicit Lossless(const Material& main_lobes) : material_(main_lobes), loss_(facet_loss_of(main_lobes)) {
    set_facet_loss(material_, loss_.get());
  }
  const Material& material() const { return material_; }

 private:
  Material material_;
  std::shared_ptr<const FacetLoss> loss_;
};

// Metal that absorbs nothing reflects all, whatever its roughness, from wherever the light comes.
TEST(FacetLoss, ReturnsFromPerfectMetal) {
  for (const float roughness : {0.05f, 0.3f, 0.6f, 1.0f}) {
    const Lossless metal(RoughConductor{Rgb(1.0f), Rgb(1e6f), roughness});
    for (const double angle : {0.0, 0.5, 1.0, 1.4})
      EXPECT_NEAR(albedo(metal.material(), angle), 1.0, 1e-3) << roughness << " at " << angle;
  }
}

// Glass sends on all, to one side or the other.
TEST(SlowFacetLoss, ReturnsFromGlass) {
  for (const float ior : {1.5f, 0.7f})
    for (const float roughness : {0.05f, 1.0f}) {
      const Lossless glass(RoughDielectric{ior, roughness});
      for (const bool from_outside : {true, false})
        for (const double angle : {0.0, 1.4}) {
          const LobeCells::Integrals all =
              LobeCells({glass.material(), kRoughNormal, arriving(angle, from_outside)}).integrate();
          EXPECT_NEAR(all.near + all.far, 1.0, 1e-3) << ior << ", " << roughness << " at " << angle;
        }
    }
}

// Metal reflects no more than a mirror of it, and the more often light meets it the redder gold gets.
TEST(FacetLoss, IsTintedByFurtherReflections) {
  const RoughConductor gold{Rgb(0.16f, 0.42f, 1.38f), Rgb(3.6f, 2.5f, 1.9f), 1.0f};
  const Lossless lossless(gold);
  const Vec3 travel = arriving(0.5), back = -arriving(0.9);
  const Rgb once = scatter_value(gold, kRoughNormal, travel, back).value;
  const Rgb more = scatter_value(lossless.material(), kRoughNormal, travel, back).value - once;
  EXPECT_GT(more.b, 0.0f);
  EXPECT_GT(more.r / more.b, 1.2f * once.r / once.b);
  EXPECT_LT(albedo(lossless.material(), 0.5), reflectance(1.0, gold.eta.g, gold.k.g));
}

TEST(RoughConductor, IsSmoothInTheLimit) {
  const Rgb eta(0.16f, 0.42f, 1.38f), k(3.6f, 2.5f, 1.9f);
  for (const double angle : {0.0, 0.8, 1.3})
    EXPECT_NEAR(albedo(RoughConductor{eta, k, 0.001f}, angle), reflectance(std::cos(angle), eta.g, k.g), 2e-3);
}

TEST(RoughDielectric, IsSmoothInTheLimit) {
  for (const float ior : {1.5f, 1.0f / 1.5f})
    for (const double angle : {0.0, 0.5, 1.2}) {
      const LobeCells::Integrals all =
          LobeCells({RoughDielectric{ior, 0.001f}, kRoughNormal, arriving(angle)}).integrate();
      const double reflected = fresnel_dielectric(static_cast<float>(std::cos(angle)), ior);
      EXPECT_NEAR(all.near, reflected, 2e-3) << ior << " at " << angle;
      EXPECT_NEAR(all.far, 1.0 - reflected, 2e-3) << ior << " at " << angle;
    }
}

TEST(Phong, ReflectsItsCoefficientsAlongTheNormalAndNoMoreElsewhere) {
  for (const float exponent : {0.0f, 3.0f, 100.0f, 1e4f, 1e6f}) {
    const Phong phong{Rgb(0.3f), Rgb(0.6f), exponent};
    EXPECT_NEAR(albedo(phong, 0.0), 0.9, 1e-3) << exponent;
    for (const double angle : {0.5, 1.0, 1.5}) EXPECT_LT(albedo(phong, angle), 0.901) << exponent << " at " << angle;
  }
}

// weight pdf = value for every drawn direction, and the two agree on what refraction does to radiance.
TEST(RoughMaterials, WeighByValueOverDensity) {
  Rng rng(6, static_cast<uint64_t>(RngUse::test), 0);
  for (const Material& m : {Material(Phong{Rgb(0.2f, 0.3f, 0.4f), Rgb(0.5f, 0.1f, 0.3f), 20.0f}),
                            Material(RoughConductor{Rgb(0.2f, 0.4f, 1.4f), Rgb(3.6f, 2.5f, 1.9f), 0.3f}),
                            Material(RoughDielectric{1.5f, 0.3f})})
    for (int i = 0; i < 2000; ++i) {
      const Vec3 travel = uniform_sphere(rng.uniform2());
      const Scatter s = sample_scatter(m, kRoughNormal, travel, rng.uniform(), rng.uniform2());
      if (is_black(s.weight)) continue;
      const ScatterValue v = scatter_value(m, kRoughNormal, travel, s.direction);
      EXPECT_EQ(v.pdf, s.pdf);
      EXPECT_LE(glm::length(v.value - s.weight * v.pdf), 1e-6f * glm::length(v.value));
      EXPECT_EQ(v.radiance_scale, s.radiance_scale);
    }
}

}  // namespace
}  // namespace vpm
