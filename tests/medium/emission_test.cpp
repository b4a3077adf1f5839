// What media emit along rays, against closed forms and integrals that other code computed (S9 of ../oracles/README.md).
#include "vpm/medium/emission.h"

#include <gtest/gtest.h>

#include <array>

#include "support/emission.h"
#include "vpm/base/rng.h"
#include "vpm/medium/blackbody.h"

namespace vpm {
namespace {

Rgb radiance_along(const Medium& medium, const Ray& ray, const Interval& interval) {
  uint64_t lookups = 0;
  return emitted_along(medium, ray, interval, lookups).radiance;
}

/// Case S9a-slab-rgb, at a cosine of 0.5: 4 m of an even absorbing medium.
TEST(Emission, OfAnEvenMediumIsExact) {
  Medium medium = make_medium(nullptr, Rgb(0.05f, 0.5f, 2.5f), 0.0f);
  medium.emission = MediumEmission{.colour = Rgb(3.0f, 1.5f, 0.25f)};
  const Rgb light = radiance_along(medium, {Vec3(0.0f), Vec3(0.0f, 0.0f, 1.0f)}, {1.0f, 5.0f});
  EXPECT_NEAR(light.r, 0.5438077407660544, 1e-6);
  EXPECT_NEAR(light.g, 1.296997075145081, 1e-6);
  EXPECT_NEAR(light.b, 0.24998865001755938, 1e-6);
  // An endless one is as bright as its source.
  EXPECT_EQ(radiance_along(medium, {Vec3(0.0f), Vec3(0.0f, 0.0f, 1.0f)}, {}), medium.emission->colour);
}

/// By volume nothing depends on absorption, where there is none.
TEST(Emission, ByVolumeNeedsNoAbsorption) {
  Medium medium = make_medium(nullptr, Rgb(0.0f, 0.0f, 2.0f), 1.0f);
  medium.emission = MediumEmission{.meaning = MediumEmission::Meaning::volume, .colour = Rgb(3.0f)};
  const Rgb light = radiance_along(medium, {Vec3(0.0f), Vec3(0.0f, 0.0f, 1.0f)}, {0.0f, 0.5f});
  EXPECT_FLOAT_EQ(light.r, 1.5f);
  EXPECT_NEAR(light.b, 3.0 * (1.0 - std::exp(-1.0)) / 2.0, 1e-6);
  medium.emission->meaning = MediumEmission::Meaning::thermal;
  EXPECT_EQ(radiance_along(medium, {Vec3(0.0f), Vec3(0.0f, 0.0f, 1.0f)}, {0.0f, 0.5f}), Rgb(0.0f));
}

struct Expected {
  double mu, leaving_zero, leaving_far;
};
/// A slab 2 m thick whose fields are linear from z = 0 to 2, seen from below and from above.
void expect_slab(const Medium& medium, const Expected& expected, int channel, double tolerance) {
  const auto sine = static_cast<float>(std::sqrt(1.0 - expected.mu * expected.mu));
  const auto mu = static_cast<float>(expected.mu);
  const Interval within{0.0f, 2.0f / mu};
  const Rgb below = radiance_along(medium, {Vec3(0.0f), Vec3(sine, 0.0f, mu)}, within);
  const Rgb above = radiance_along(medium, {Vec3(0.0f, 0.0f, 2.0f), Vec3(sine, 0.0f, -mu)}, within);
  EXPECT_NEAR(below[channel] / expected.leaving_zero, 1.0, tolerance) << expected.mu;
  EXPECT_NEAR(above[channel] / expected.leaving_far, 1.0, tolerance) << expected.mu;
}

TEST(Emission, OfALinearSourceIsThatOfTheIntegral) {
  struct Case {
    std::shared_ptr<const DensityGrid> density;  // null: 1
    float sigma_t;
    std::array<Expected, 3> expected;
  };
  for (const Case& c : {Case{nullptr,
                             0.8f,
                             {Expected{0.1, 0.6249997045951663, 2.3749999577993095},
                              {0.5, 0.9976181125676057, 1.8800952754972957},
                              {1.0, 0.9928880575200425, 1.4014223884959915}}},
                        Case{linear_in_z(0.2, 3.0),
                             1.0f,
                             {Expected{0.1, 0.7291279698107216, 2.4661218287415236},
                              {0.5, 1.1206844739188833, 2.3142528526466704},
                              {1.0, 1.3162870904630588, 2.0687833233857464}}}}) {
    Medium medium = make_medium(c.density, Rgb(c.sigma_t), 0.0f);
    medium.emission = MediumEmission{.colour = Rgb(1.0f)};
    medium.emission_grid = linear_in_z(0.5, 2.5);
    for (const Expected& expected : c.expected) expect_slab(medium, expected, 0, 2e-5);
  }
}

/// Temperatures are interpolated, and then become light: in red and in green, which are not clamped from 1000 K on.
TEST(Emission, OfALinearTemperatureIsThatOfTheIntegral) {
  Medium medium = make_medium(nullptr, Rgb(0.8f), 0.0f);
  medium.emission = MediumEmission{.colour = Rgb(1.0f), .blackbody = true, .scale = 1000.0, .offset = -200.0};
  medium.emission_grid = linear_in_z(1.2, 2.4);
  struct Case {
    double mu;
    Vec3d zero, far;
  };
  for (const Case& c : {Case{0.1,
                             {0.20758423183683575, 0.13282290442541006, 0.006246093990750108},
                             {1842.6935435376229, 1495.8686224909268, 267.00069309809044}},
                        Case{0.6,
                             {101.3780449850815, 79.29298819583443, 11.708148067461387},
                             {731.1157382066301, 584.3900324850938, 96.11420799036665}},
                        Case{1.0,
                             {149.02691514564313, 117.27796764965873, 17.844681359141063},
                             {490.107763705565, 390.6140008113154, 63.30431368326637}}})
    for (const int channel : {0, 1})
      expect_slab(medium, {c.mu, linear_srgb_of_xyz(c.zero)[channel], linear_srgb_of_xyz(c.far)[channel]}, channel,
                  1e-4);
}

struct RayOfGrid {
  Vec3 origin, direction;
  float length;
  double thermal, by_volume;  // of sigma_a 0.9 and sigma_s 1.6
};
/// Of 8^3 voxels: along a row, through middles of cells, along the diagonal, from within to within, and beside them.
TEST(Emission, OfTrilinearFieldsIsThatOfTheIntegral) {
  const std::array rays{
      RayOfGrid{{-2.0f, 1.25f, 2.25f}, {1.0f, 0.0f, 0.0f}, 6.0f, 0.308293245334002, 0.4833258855532166},
      RayOfGrid{{-0.125f, 3.0f, 2.625f}, {0.0f, -1.0f, 0.0f}, 6.0f, 0.22928967996281496, 0.4518365532540954},
      RayOfGrid{{-2.0f, -0.75f, 0.0f}, {1.0f, 1.0f, 1.0f}, 9.0f, 0.2675809782918286, 0.5089422888196973},
      RayOfGrid{{1.825f, 1.775f, 4.325f}, {-7.0f, -1.0f, -9.0f}, 7.0f, 0.2500639605589297, 0.5545199672908466},
      RayOfGrid{{-0.45f, 0.975f, 1.35f}, {1.0f, 2.0f, 3.0f}, 0.6f, 0.10580208952029999, 0.23870487090917744},
      RayOfGrid{{-2.0f, 2.7f, 1.25f}, {1.0f, 0.0f, 0.0f}, 6.0f, 0.0, 0.0}};
  Medium medium = emitting_grids(0.9f, 1.6f);
  for (const RayOfGrid& r : rays) {
    const Ray ray{r.origin, glm::normalize(r.direction)};
    medium.emission->meaning = MediumEmission::Meaning::thermal;
    EXPECT_NEAR(radiance_along(medium, ray, {0.0f, r.length}).g, r.thermal, 3e-5 * std::max(0.1, r.thermal));
    medium.emission->meaning = MediumEmission::Meaning::volume;
    EXPECT_NEAR(radiance_along(medium, ray, {0.0f, r.length}).g, r.by_volume, 3e-5 * std::max(0.1, r.by_volume));
  }
}

/// The same by a sum over many short steps.
double by_small_steps(const Medium& medium, const Ray& ray) {
  constexpr int kSteps = 200'000;
  double sum = 0.0, depth = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double step = 6.0 / kSteps;
    const Vec3 at = ray.at(static_cast<float>((i + 0.5) * step));
    const double half = 0.5 * step * double{medium.sigma_t.g} * double{medium.grid->density(at)};
    depth += half;
    sum += step * emission_coefficient(medium, at).g * std::exp(-depth);
    depth += half;
  }
  return sum;
}

/// Where the grid of temperatures is 0 nothing glows, whatever the offset is.
TEST(Emission, ByAnOffsetEndsWithItsGrid) {
  Medium medium = emitting_grids(0.9f, 1.6f);
  medium.emission_grid = turned_grid(3, lattice_noise);
  medium.emission->blackbody = true;
  medium.emission->scale = 400.0;
  medium.emission->offset = 1500.0;
  const Ray ray{Vec3(-2.0f, -0.7f, 0.1f), glm::normalize(Vec3(1.0f, 0.9f, 0.95f))};
  EXPECT_EQ(medium.emission->source(0.0), Rgbd(0.0));
  EXPECT_NEAR(radiance_along(medium, ray, {0.0f, 6.0f}).g / by_small_steps(medium, ray), 1.0, 2e-4);
}

/// Grids on two lattices.
TEST(Emission, OfTwoLatticesIsThatOfSmallSteps) {
  Medium medium = emitting_grids(0.9f, 1.6f);
  medium.emission_grid = turned_grid(4, lattice_noise);
  const Ray ray{Vec3(-2.0f, -0.7f, 0.1f), glm::normalize(Vec3(1.0f, 0.9f, 0.95f))};
  for (const auto meaning : {MediumEmission::Meaning::thermal, MediumEmission::Meaning::volume}) {
    medium.emission->meaning = meaning;
    const double sum = by_small_steps(medium, ray);
    EXPECT_GT(sum, 0.05);
    EXPECT_NEAR(radiance_along(medium, ray, {0.0f, 6.0f}).g / sum, 1.0, 2e-4);
  }
}

}  // namespace
}  // namespace vpm
