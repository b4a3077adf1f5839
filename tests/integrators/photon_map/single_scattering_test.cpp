// Single scattering at drawn distances: densities that are what they are said to be, exact radiance, and the march's
// answer for every light, in fog and in grids.
#include "vpm/integrators/photon_map/volume/marched.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "light/lights.h"
#include "support/scenes.h"
#include "support/statistics.h"
#include "vpm/integrators/photon_map/eye_path.h"
#include "vpm/study/exact/airlight.h"
#include "vpm/study/sample_moments.h"

namespace vpm {
namespace {

const Rgb kChromatic(0.5f, 1.5f, 4.0f);

std::shared_ptr<const TransmittanceEstimator> exact_transmittance() { return make_transmittance_estimator({}); }

/// What a ray is estimated to bring along a segment.
Rgb found_along(const VolumeEstimator& estimator, const Scene& scene, const Segment& segment, Rng& rng,
                EyeCounters& counters) {
  EyeScratch scratch;
  EyeWork work{rng, counters, scratch};
  return estimator.along(EyeSegment(scene, segment, {}), work).value;
}

/// The radiance of each channel over many estimates.
std::vector<Moments> estimates(const Scene& scene, const VolumeEstimator& estimator, const Segment& segment,
                               uint64_t count, uint64_t seed) {
  return sample_moments(3, count, seed, [&](Rng& rng, double* out) {
    EyeCounters counters;
    const Rgb radiance = found_along(estimator, scene, segment, rng, counters);
    for (int c = 0; c < 3; ++c) out[c] = radiance[c];
  });
}

SingleEquiangular equiangular(const Scene& scene, int pairs) { return {scene, exact_transmittance(), pairs}; }

/// By marching, in steps of that optical thickness.
MarchedLight marched(const Scene& scene, float optical_step) {
  return {std::nullopt, ScatteredOnce(scene, exact_transmittance()), optical_step};
}

/// Noise with empty layers, over [-1, 1]^3.
std::shared_ptr<const DensityGrid> noise_grid() {
  return make_grid(centered_frame(11, 0.2),
                   [](int x, int y, int z) { return x % 4 == 0 ? 0.0 : 2.0 * lattice_noise(x, y, z); });
}

constexpr int kBins = 50, kMidpoints = 4000;  // in all of an interval; of each bin

/// The density's integral over each bin is the share of evenly spaced numbers that draw from it.
void expect_density(const Interval& interval, const std::function<double(double)>& draw,
                    const std::function<double(double)>& pdf, const std::string& what) {
  constexpr int kDraws = 100'000;
  std::vector<double> drawn(kBins);
  const double width = double{interval.length()} / kBins;
  for (int i = 0; i < kDraws; ++i) {
    const double t = draw((i + 0.5) / kDraws);
    ASSERT_GE(t, interval.t0) << what;
    ASSERT_LE(t, interval.t1) << what;
    drawn[std::min(kBins - 1, static_cast<int>((t - interval.t0) / width))] += 1.0 / kDraws;
  }
  double sum = 0.0;
  for (int bin = 0; bin < kBins; ++bin) {
    double share = 0.0;
    for (int i = 0; i < kMidpoints; ++i)
      share += pdf(interval.t0 + (bin + (i + 0.5) / kMidpoints) * width) * width / kMidpoints;
    EXPECT_NEAR(drawn[bin], share, 1e-4) << what << ", bin " << bin;  // three channels' strata, each off by one draw
    sum += share;
  }
  EXPECT_NEAR(sum, 1.0, 1e-5) << what;
}

TEST(SingleScattering, EquiangularDistancesHaveTheirDensity) {
  const Ray ray{Vec3(1.0f, 2.0f, 3.0f), glm::normalize(Vec3(1.0f, -2.0f, 2.0f))};
  for (const Interval interval : {Interval{0.0f, 4.0f}, Interval{1.0f, 1.5f}})
    for (const float closest : {-3.0f, 0.5f, 2.0f, 50.0f})
      for (const float off : {0.05f, 1.0f, 300.0f}) {
        const Vec3 point = ray.at(closest) + off * glm::normalize(Vec3(2.0f, 1.0f, 0.0f));
        const auto distances = EquiangularDistances::towards(LightPoint{point}, ray, interval);
        ASSERT_TRUE(distances);
        expect_density(
            interval, [&](double u) { return distances->draw(u); }, [&](double t) { return distances->pdf(t); },
            fmt::format("{} m off at {} m", off, closest));
      }
}

// The angle under which the rest of an endless ray is seen, as a share of all of it, is the number still to come.
TEST(SingleScattering, EquiangularDistancesOfEndlessRays) {
  const auto distances = EquiangularDistances::towards(LightPoint{{0.5f, 0.0f, 2.0f}}, {}, {0.0f, kInfinity});
  ASSERT_TRUE(distances);
  const double all = std::atan2(0.5, -2.0);
  for (const double u : {0.0, 0.1, 0.5, 0.9, 0.999})
    EXPECT_NEAR(std::atan2(0.5, distances->draw(u) - 2.0), (1.0 - u) * all, 1e-12);
}

TEST(SingleScattering, ThereAreNoEquiangularDistancesTowardsNothingAndTheRayItself) {
  EXPECT_FALSE(EquiangularDistances::towards(std::nullopt, {}, {0.0f, 1.0f}));
  EXPECT_FALSE(EquiangularDistances::towards(LightPoint{{0.0f, 0.0f, 0.5f}}, {}, {0.0f, 1.0f}));
  EXPECT_FALSE(EquiangularDistances::towards(LightPoint{{0.0f, 0.0f, 2.0f}}, {}, {0.0f, 1.0f}));
}

TEST(SingleScattering, AttenuatedDistancesHaveTheirDensity) {
  const Ray ray{Vec3(-2.0f, 0.1f, -0.2f), glm::normalize(Vec3(1.0f, 0.05f, 0.1f))};
  for (const auto& grid : {std::shared_ptr<const DensityGrid>(), noise_grid()})
    for (const Rgb& sigma_t : {Rgb(1e-12f), Rgb(1.0f), kChromatic, Rgb(0.0f, 2.0f, 1.0f)})
      for (const Rgb& throughput : {Rgb(1.0f), Rgb(0.0f, 0.2f, 3.0f), Rgb(0.0f, 1.0f, 0.0f)}) {
        const Medium medium = make_medium(grid, sigma_t);
        const Interval interval = medium.clip(ray, {0.0f, 4.0f});
        DensityIntegralsAlong integrals;
        integrals.walk(&medium, ray, interval);
        const AttenuatedDistances distances(integrals, sigma_t, throughput * medium.sigma_s);
        expect_density(
            interval, [&](double u) { return distances.draw(u); },
            [&](double t) { return distances.pdf(integrals.at(t)); },
            fmt::format("{}, extinction of red {}, throughput of red {}", grid ? "grid" : "fog", sigma_t.r,
                        throughput.r));
      }
}

TEST(SingleScattering, NothingScattersWithoutDensityOrThroughput) {
  const Medium empty = make_medium(make_grid(centered_frame(5, 0.4), [](int, int, int) { return 0.0; }), Rgb(1.0f));
  const Scene fog = boxed_medium(make_medium(nullptr, Rgb(1.0f)), PointLight{}),
              void_ = boxed_medium(empty, PointLight{});
  Rng rng(1, 0, 0);
  EyeCounters counters;
  const Ray ray{Vec3(0.0f, 0.3f, -0.9f), Vec3(0, 0, 1)};
  const Interval interval{0.0f, 1.0f};
  EXPECT_EQ(found_along(equiangular(void_, 8), void_, {ray, interval, 0}, rng, counters), Rgb(0.0f));
  EXPECT_EQ(found_along(equiangular(fog, 8), fog, {ray, interval, 0, Rgb(0.0f)}, rng, counters), Rgb(0.0f));
  EXPECT_EQ(counters.shadow_rays, 0u);
}

/// A light of 1 W/sr in endless fog.
Scene lamp_in_fog(const Medium& fog, const Vec3& position) {
  Scene scene;
  scene.media.push_back(fog);
  scene.world_medium = scene.camera_medium = 0;
  scene.lights.push_back(PointLight{position, Rgb(1.0f)});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

// In fog that does not attenuate, a light's light comes with exactly the equiangular density. The other technique's
// distances are then uniform, and the balance heuristic bounds what either brings: light over half its own density.
TEST(SingleScattering, StaysBoundedBesideALamp) {
  const double off = 1e-3;
  const Scene scene = lamp_in_fog(make_medium(nullptr, Rgb(1e-6f), 1.0f), Vec3(0.0f, static_cast<float>(off), 1.0f));
  const SingleEquiangular estimator = equiangular(scene, 8);
  const double exact = exact::solve_airlight({1e-6, 1.0, 0.0, off, 1.0, 0.0, 2.0}).radiance.value;
  EyeCounters counters;
  for (uint64_t i = 0; i < 10'000; ++i) {
    Rng rng(1, 0, i);
    const Rgb found = found_along(estimator, scene, {Ray{}, {0.0f, 2.0f}}, rng, counters);
    ASSERT_LT(found.g, 2.001 * exact);
  }
}

/// Segments through the box [-1, 1]^3, and the box with a medium in it.
void expect_as_marched(const Medium& medium, const std::vector<Light>& lights, const std::string& what) {
  const Scene scene = boxed_medium(medium, lights);
  for (const Segment& segment :
       {Segment{{Vec3(-0.9f, 0.4f, -0.8f), glm::normalize(Vec3(1.0f, 0.2f, 0.9f))}, {0.0f, 2.0f}, 0},
        Segment{{Vec3(0.3f, -0.9f, 0.2f), Vec3(0, 1, 0)}, {0.0f, 1.8f}, 0, Rgb(0.5f, 1.0f, 2.0f)}})
    expect_same_means(estimates(scene, equiangular(scene, 2), segment, 8'000, 1),
                      estimates(scene, marched(scene, 0.1f), segment, 1'000, 2), kFalseAlarms, what);
}

TEST(SingleScattering, IsAsMarchedUnderEveryLight) {
  Medium fog = make_medium(nullptr, kChromatic, 0.7f);
  fog.phase = HenyeyGreenstein{0.4f};
  Medium cloud = make_medium(noise_grid(), kChromatic, 0.7f);
  cloud.phase = HenyeyGreenstein{-0.4f};
  for (const Light& light : test_lights()) {
    expect_as_marched(fog, {light}, "fog, " + std::string(light_kind(light)));
    expect_as_marched(cloud, {light}, "grid, " + std::string(light_kind(light)));
  }
  expect_as_marched(cloud, test_lights(), "grid, all lights");
}

// A ray that has come through fog and goes on in a box of other fog, by all of the eye path.
TEST(SingleScattering, IsDimmedByTheMediaBefore) {
  Scene scene;
  scene.media = {make_medium(nullptr, Rgb(0.6f, 0.3f, 0.1f), 0.3f), make_medium(nullptr, kChromatic, 0.9f)};
  scene.world_medium = scene.camera_medium = 0;
  const Interface media{1, 0};
  add_shape(scene, box_mesh(Vec3d(-1.0), Vec3d(1.0)), Boundary{}, &media);
  scene.lights.push_back(PointLight{Vec3(0.2f, 1.5f, -0.3f), Rgb(1.0f)});
  scene.geometry.commit();
  finish(scene);
  const auto by = [&](std::unique_ptr<VolumeEstimator> estimator) {
    Estimators estimators;
    estimators.volume.push_back(std::move(estimator));
    const EyeContext context{scene, estimators};
    return sample_moments(3, 4'000, 3, [&](Rng& rng, double* out) {
      EyeScratch scratch;
      EyeCounters counters;
      EyeWork work{rng, counters, scratch};
      const Rgb radiance = eye_radiance(context, {Vec3(0.1f, 0.2f, -3.0f), Vec3(0, 0, 1)}, work).value;
      for (int c = 0; c < 3; ++c) out[c] = radiance[c];
    });
  };
  expect_same_means(by(std::make_unique<SingleEquiangular>(equiangular(scene, 8))),
                    by(std::make_unique<MarchedLight>(marched(scene, 0.5f))), kFalseAlarms, "two media");
}

}  // namespace
}  // namespace vpm
