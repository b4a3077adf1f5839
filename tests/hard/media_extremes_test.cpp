// Media from nothing to opaque, from black to white, from forward to backward: against closed forms.
#include "hard/hard_scenes.h"
#include "vpm/base/statistics/tails.h"
#include "vpm/base/warp.h"
#include "vpm/estimate/march.h"
#include "vpm/integrators/path/path_tracer.h"
#include "vpm/medium/transmittance/estimator.h"
#include "vpm/study/careful_settings.h"
#include "vpm/study/exact/slab.h"

namespace vpm {
namespace {

/// A medium in z of [-1, 1] between a panel of radiance 1 at z = -2 and the eye at z = 3.
Scene window(const Medium& medium) {
  Scene scene;
  scene.media.push_back(medium);
  const Interface media{0, kVacuum};
  add_shape(scene, box_mesh(Vec3d(-1.0), Vec3d(1.0)), Boundary{}, &media);
  const QuadLight panel{Vec3(-5, -5, -2), Vec3(10, 0, 0), Vec3(0, 10, 0), Rgb(1.0f)};
  scene.lights.push_back(panel);
  add_shape(scene, quad_mesh(panel.corner, panel.edge_u, panel.edge_v), Lambertian{Rgb(0.0f)}, nullptr, 0);
  scene.camera = make_camera(Vec3(0, 0, 3), Vec3(0.0f), Vec3(0, 1, 0), 1e-3f, {4, 4});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

/// A grid of that density, constant in all of [-2, 2]^3.
std::shared_ptr<const DensityGrid> constant_grid(float density) {
  const GridFrame frame = centered_frame(9, 0.25);
  return make_grid(frame, [&](int, int, int) { return density; });
}

constexpr float kSigmas[] = {0.0f, 1e-9f, 1e-3f, 1.0f, 1e2f, 1e6f, 1e9f};  // 1/m

TEST(MediaExtremes, ABlackMediumDimsByItsExtinctionAlone) {
  Worst worst("relative error of the panel through the medium");
  for (const float sigma : kSigmas)
    for (const auto& grid : {std::shared_ptr<const DensityGrid>(), constant_grid(1.0f)}) {
      const Scene scene = window(make_medium(grid, Rgb(sigma), 0.0f));
      const double exact = std::exp(-2.0 * double(sigma));
      for (const Rgb& pixel : clean_image(scene, settings_of(1000, 0.1f)).pixels) {
        EXPECT_NEAR(pixel.r, exact, 1e-5 * exact + 1e-38) << sigma;
        if (exact > 1e-30) worst.see(pixel.r / exact - 1.0);
      }
    }
}

TEST(MediaExtremes, EstimatorsAndFlightsAgreeFromNothingToOpaque) {
  const Ray ray{Vec3(-1.5f, 0.1f, 0.2f), Vec3(1, 0, 0)};
  constexpr uint64_t kFlights = 4000;
  Worst worst("relative error of weights that should be 1");
  for (const float sigma : {0.0f, 1e-12f, 1e-9f, 1e-3f, 1.0f, 10.0f, 1e6f, 1e9f}) {
    for (const auto& grid : {std::shared_ptr<const DensityGrid>(), constant_grid(1.0f)}) {
      const Medium medium = make_medium(grid, Rgb(sigma));
      const double exact = std::exp(-double(sigma));
      for (const EstimatorInfo& info : transmittance_estimators()) {
        const auto estimator = make_transmittance_estimator({.estimator = std::string(info.name)});
        const auto value = [&](uint64_t i) {
          Rng rng(1, rng_stream(RngUse::test, 0), i);
          return estimator->estimate(medium, ray, {0.5f, 1.5f}, rng).value.r;
        };
        if (info.name != "ratio" && info.name != "ratio-local") {
          EXPECT_NEAR(value(0), exact, 1e-6 * exact + 1e-38) << info.name << " " << sigma;
          continue;
        }
        double passed = 0.0;  // where the density is its majorant ratio tracking gives 0 or 1
        for (uint64_t i = 0; i < kFlights; ++i) passed += value(i);
        expect_share(passed / kFlights, exact, kFlights, std::string(info.name));
      }
      for (const StrategyInfo& info : distance_strategies()) {
        if (grid && (!info.heterogeneous || info.name == "mean-extinction")) continue;  // its rate is another
        if (!info.positive) continue;  // its weights are not 1 under majorants that do not bound
        uint64_t passed = 0;
        double farthest = 0.0;
        const auto strategy = make_distance_strategy(careful_settings(info.name));
        for (uint64_t i = 0; i < kFlights; ++i) {
          Rng rng(1, rng_stream(RngUse::test, 1), i);
          const Flight flight = strategy->sample(medium, ray, {0.5f, 1.5f}, Rgb(1.0f), rng);
          passed += !flight.collided;
          farthest = std::max(farthest, double(flight.collided ? flight.t : 0.5f));
          worst.see(flight.weight.r - 1.0);
          EXPECT_NEAR(flight.weight.r, 1.0, 1e-5) << info.name << " " << sigma;
          EXPECT_TRUE(!flight.collided || flight.density > 0.0f);
        }
        expect_share(double(passed) / kFlights, exact, kFlights, std::string(info.name));
        EXPECT_LE(farthest, 1.5);
      }
    }
  }
}

TEST(MediaExtremes, TheMarchKeepsItsDigitsFromNothingToOpaque) {
  Worst worst("relative error of 1 - exp(-tau) up to tau = 1, where no roulette is played");
  const Ray ray{Vec3(0.0f), Vec3(0, 0, 1)};
  for (const double tau : {1e-12, 1e-9, 1e-3, 1.0, 1e3, 1e6, 1e9})
    for (const float length : {1e-4f, 1.0f, 1e7f}) {
      const auto sigma = static_cast<float>(tau / length);
      Moments sums;
      Marcher marcher;
      for (uint64_t i = 0; i < 200; ++i) {
        Rng rng(2, rng_stream(RngUse::test, 2), i);
        double sum = 0.0;
        const Marched marched = marcher.march(make_medium(nullptr, Rgb(sigma)), ray, {0.0f, length},
                                              {0.1f * length, 0.5f}, rng, [&](const Vec3& p, const Rgb& w) {
                                                sum += w.r * sigma;
                                                EXPECT_TRUE(p.z >= 0.0f && p.z <= length);
                                              });
        EXPECT_FLOAT_EQ(static_cast<float>(marched.integral), length);
        EXPECT_LT(marched.steps, 200u);
        sums.add(sum);
      }
      const double exact = -std::expm1(-double(sigma) * length);
      const double error = std::sqrt(sums.variance_of_mean());
      if (tau <= 1.0) worst.see(sums.mean() / exact - 1.0);
      EXPECT_NEAR(sums.mean() / exact, 1.0, 1e-6 + normal_quantile(kFalseAlarms) * error / exact)
          << tau << " " << length;
    }
}

TEST(MediaExtremes, SingleScatteringIsExactWhereNoPhotonCollides) {
  // Light along -z into a slab, the eye looks along -z too: j = sigma_s E / (4 pi), dimmed both ways, so that L =
  // a E / (8 pi) (1 - exp(-2 tau)). The slab's lit face lies at 0, where floats are dense.
  Worst worst("relative error of single scattering");
  for (const float sigma : {1e-12f, 1e-9f, 1e-3f, 1.0f, 1e3f, 1e6f, 1e9f}) {
    Scene scene;
    scene.media.push_back(make_medium(nullptr, Rgb(sigma), 0.5f));
    const Interface media{0, kVacuum};
    add_shape(scene, box_mesh(Vec3d(-1, -1, -1), Vec3d(1, 1, 0)), Boundary{}, &media);
    scene.lights.push_back(DirectionalLight{Vec3(0, 0, -1), Rgb(1.0f)});
    scene.camera = make_camera(Vec3(0, 0, 3), Vec3(0.0f), Vec3(0, 1, 0), 1e-3f, {8, 8});
    scene.geometry.commit();
    finish(scene);
    RenderSettings settings = settings_of(1, 0.01f);
    settings.single_scattering.type = DirectLight::shadow_rays;
    const Moments mean = clean_means(scene, settings, 64);
    const double exact = 0.5 / (8.0 * kPiD) * -std::expm1(-2.0 * sigma);
    worst.see(mean.mean() / exact - 1.0);
    EXPECT_NEAR(mean.mean() / exact, 1.0,
                1e-5 + normal_quantile(kFalseAlarms) * std::sqrt(mean.variance_of_mean()) / exact)
        << sigma;
  }
}

/// A pencil of light straight down on a medium that fills z of [-depth, 0] and as much to the sides.
Scene half_space(const Medium& medium, double depth) {
  Scene scene;
  scene.media.push_back(medium);
  const Interface media{0, kVacuum};
  add_shape(scene, box_mesh(Vec3d(-depth), Vec3d(depth, depth, 0.0)), Boundary{}, &media);
  scene.lights.push_back(BeamLight{Vec3(0, 0, static_cast<float>(depth)), Vec3(0, 0, -1), 1e-6f, Rgb(1.0f)});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

TEST(MediaExtremes, AHalfSpaceReflectsByItsAlbedoWhateverItsExtinction) {
  constexpr uint64_t kPhotons = 20000;
  Worst worst("error of the reflected share");
  for (const float albedo : {0.5f, 0.9f}) {
    const double exact = 1.0 - exact::chandrasekhar_h(albedo, 1.0).value * std::sqrt(1.0 - double(albedo));
    for (const auto& [sigma, depth] : {std::pair(1e-7f, 1e9), std::pair(1e-3f, 1e5), std::pair(1.0f, 1e2),
                                       std::pair(1e3f, 1.0), std::pair(1e6f, 1.0), std::pair(1e9f, 1e-4)}) {
      const Ledger ledger =
          clean_ledger(half_space(make_medium(nullptr, Rgb(sigma), albedo), depth), "regular", kPhotons);
      worst.see(ledger.escaped.r / ledger.emitted.r - exact);
      expect_share(ledger.escaped.r / ledger.emitted.r, exact, kPhotons, "sigma_t " + std::to_string(sigma));
      EXPECT_EQ(ledger.walk.medium_mismatches, 0u);
    }
  }
}

TEST(MediaExtremes, AnAlbedoOfOneLosesNothingAndOfZeroSendsNothingOn) {
  for (const float sigma : {1e-9f, 1.0f, 8.0f}) {
    const Light light = PointLight{Vec3(0.2f, 0.1f, 0.0f), Rgb(1.0f)};
    const Ledger white = clean_ledger(boxed_medium(make_medium(nullptr, Rgb(sigma), 1.0f), light), "regular", 3000);
    EXPECT_EQ(white.absorbed_in_media, Rgbd(0.0));
    EXPECT_NEAR(white.escaped.r / white.emitted.r, 1.0, 1e-6);
    const Scene black = boxed_medium(make_medium(nullptr, Rgb(sigma), 0.0f), light);
    EXPECT_FALSE(facts_of(black).scattering_media);
    const Ledger gone = clean_ledger(black, "regular", 3000);
    EXPECT_NEAR((gone.absorbed_in_media.r + gone.escaped.r) / gone.emitted.r, 1.0, 1e-6);
    EXPECT_EQ(trace_with(black, "regular", {{.emitted = 100}}).volume[0].size(), 0u);
  }
}

TEST(MediaExtremes, AnAlbedoNextToOneAbsorbsWhatFloatKeepsOfIt) {
  // 1 - 1e-7 in float is 1 - 2^-23, 19 % more absorption: exactly that much is absorbed at each collision.
  const float albedo = 1.0f - 1e-7f;
  EXPECT_EQ(albedo, 1.0f - 0x1p-23f);
  const Scene scene = boxed_medium(make_medium(nullptr, Rgb(4.0f), albedo), PointLight{Vec3(0.0f), Rgb(1.0f)});
  EXPECT_EQ(scene.media[0].albedo(), Rgb(albedo));
  // So rarely that none of these photons is: their imbalance is all that absorption, which is as it must be.
  const Ledger ledger = trace_with(scene, "regular", {{.emitted = 20000}}).ledger;
  const double collided = static_cast<double>(ledger.collisions) * ledger.emitted.r / 20000.0;
  EXPECT_NEAR(ledger.absorbed_in_media.r / collided / 0x1p-23, 1.0, 1e-5);
}

/// A ball that scatters all, in a sky of radiance 1, seen by a camera that it fills.
Scene furnace_ball(float sigma, float g, float radius) {
  Scene scene;
  Medium medium = make_medium(nullptr, Rgb(sigma), 1.0f);
  medium.phase = HenyeyGreenstein{g};
  scene.media.push_back(medium);
  const Interface media{0, kVacuum};
  add_shape(scene, SphereShape{Vec3(0.0f), radius}, Boundary{}, &media);
  scene.lights.push_back(ConstantEnvironment{Rgb(1.0f)});
  scene.camera = make_camera(Vec3(0, 0, 4 * radius), Vec3(0.0f), Vec3(0, 1, 0), 10.0f, {8, 8});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

TEST(MediaExtremes, TheWhiteFurnaceIsOneWhateverTheExtinctionAndTheAnisotropy) {
  Worst worst("error of the furnace's 1");
  // A thin ball: what it takes from the light behind it, it must scatter in from everywhere.
  for (const float g : {-0.9f, 0.0f, 0.9f})
    for (const float sigma : {0.0f, 1e-9f, 1e-2f, 0.3f}) {
      const Scene scene = furnace_ball(sigma, g, 1.0f);
      RenderSettings settings = settings_of(20000, 0.2f);
      settings.single_scattering.type = DirectLight::photons;
      const Moments mean = clean_means(scene, settings, 8);
      worst.see(mean.mean() - 1.0);
      const double noise = 1e-6 + normal_quantile(kFalseAlarms) * std::sqrt(mean.variance_of_mean());
      EXPECT_LT(mean.mean(), 1.0 + noise) << g << " " << sigma;
      // The kernel's darkening within 0.2 m of the surface takes below 5 % of what is scattered, 1 - exp(-2 sigma).
      EXPECT_GT(mean.mean(), 1.0 - 0.05 * (1.0 - std::exp(-2.0 * sigma)) - noise) << g << " " << sigma;
    }
}

TEST(MediaExtremes, TheWhiteFurnaceIsOneInBallsOfAllSizes) {
  // From a third of a nanometre at 1e9 per metre to 300000 km at 1e-9: the same optical thickness.
  Worst worst("error of the furnace's 1, in balls of all sizes");
  for (const float sigma : {1e-9f, 1e-3f, 1e3f, 1e6f, 1e9f}) {
    const float radius = 0.3f / sigma;
    const Scene scene = furnace_ball(sigma, 0.0f, radius);
    RenderSettings settings = settings_of(20000, 0.2f * radius);
    for (const DirectLight direct : {DirectLight::photons, DirectLight::shadow_rays}) {
      settings.single_scattering.type = direct;
      const Moments mean = clean_means(scene, settings, 16);
      const double error = std::sqrt(mean.variance_of_mean());
      worst.see(mean.mean() - 1.0);
      // The kernel's darkening within 0.2 radii of the surface takes below 5 % of what is scattered.
      const double darkening = 0.05 * -std::expm1(-0.6);
      const double beyond = std::max({0.0, mean.mean() - 1.0, 1.0 - darkening - mean.mean()});
      EXPECT_GT(student_tail(beyond / error, 15.0), kFalseAlarms) << sigma;
      EXPECT_GT(error, 0.0) << "nothing scattered, " << sigma;
      EXPECT_LT(error, 0.02) << sigma;
    }
  }
}

TEST(MediaExtremes, ThePathTracersWhiteFurnaceIsOneInTheNarrowestPeak) {
  Worst worst("error of the path tracer's 1");
  // No photon map resolves a peak of 1e-4 rad; paths that combine both ways of sampling do, up to thousands of
  // scatterings.
  for (const float g : {-0.9999f, 0.9999f})
    for (const float sigma : {0.3f, 20.0f}) {
      Medium medium = make_medium(nullptr, Rgb(sigma), 1.0f);
      medium.phase = HenyeyGreenstein{g};
      Scene scene = boxed_medium(medium, ConstantEnvironment{Rgb(1.0f)});
      scene.camera = make_camera(Vec3(0, 0, 4), Vec3(0.0f), Vec3(0, 1, 0), 10.0f, {8, 8});
      Moments mean;
      for (int pass = 0; pass < 16; ++pass) {
        const Pass done = render_path_pass(scene, settings_of(1, 1.0f), pass);
        EXPECT_EQ(done.statistics.eye.non_finite + done.statistics.eye.cut_paths, 0u);
        mean.add(mean_of(done.image));
      }
      const double error = std::sqrt(mean.variance_of_mean());
      EXPECT_NEAR(mean.mean(), 1.0, 1e-5 + normal_quantile(kFalseAlarms) * error) << g << " " << sigma;
      EXPECT_LT(error, 0.1);
      worst.see(mean.mean() - 1.0);
    }
}

TEST(MediaExtremes, AThousandScatteringsKeepTheirMeanCosine) {
  // The mean cosine to the first direction after n scatterings is g^n; the mean way along it, in free paths, is the sum
  // of those.
  constexpr int kEvents = 1000;
  Worst worst("error of the mean cosine after 1000 scatterings");
  for (const float g : {0.9999f, -0.9999f}) {
    const Phase phase = HenyeyGreenstein{g};
    Moments cosine;
    float longest = 0.0f;
    for (uint64_t i = 0; i < 2000; ++i) {
      Rng rng(3, rng_stream(RngUse::test, 3), i);
      Vec3 d(0, 0, 1);
      for (int k = 0; k < kEvents; ++k) d = phase_sample(phase, d, rng.uniform2());
      cosine.add(d.z);
      longest = std::max(longest, std::abs(glm::length(d) - 1.0f));
    }
    worst.see(cosine.mean() - std::pow(double(g), kEvents));
    expect_mean(cosine, std::pow(double(g), kEvents), kFalseAlarms, "mean cosine after 1000 scatterings");
    EXPECT_LT(longest, 1e-6f);
  }
}

TEST(MediaExtremes, ANarrowPeakIsNormalisedForDirectionsInSinglePrecision) {
  Worst worst("relative error of the peak's integral");
  // The integral of the phase function over a cone that holds half of it, by uniform directions in the cone: the value
  // must not feel that 1 - cos is far below what a float cosine keeps.
  for (const float g : {0.9999f, -0.9999f})
    for (const Vec3& axis : {Vec3(0, 0, 1), glm::normalize(Vec3(0.3f, -0.8f, 0.5f))}) {
      const double e = 1.0 - 0.9999f;
      // The share with 1 - cos <= away, from the cumulative distribution in s^2 = e^2 + 2 g away [Henyey1941].
      const double away = 1e-7, gg = 0.9999f;
      const double share = (1.0 - gg * gg) / (2.0 * gg) * (1.0 / e - 1.0 / std::sqrt(e * e + 2.0 * gg * away));
      Moments integral;
      for (uint64_t i = 0; i < 200000; ++i) {
        Rng rng(4, rng_stream(RngUse::test, 4), i);
        const Vec3 d = uniform_cone(g > 0.0f ? axis : -axis, static_cast<float>(away), rng.uniform2());
        integral.add(phase_value(HenyeyGreenstein{g}, axis, d) * 2.0 * kPiD * away);
      }
      worst.see(integral.mean() / share - 1.0);
      expect_mean(integral, share, kFalseAlarms, "peak");
    }
}

TEST(MediaExtremes, LightStraightThroughForwardScatteringIsExact) {
  // As above with the light behind the medium and the eye before it: every path has the length 2 m, whatever the place
  // of scattering, so L = a p(1) E tau exp(-tau) in the peak of the phase function.
  const float g = 0.9999f, sigma = 0.5f;
  Medium medium = make_medium(nullptr, Rgb(sigma), 1.0f);
  medium.phase = HenyeyGreenstein{g};
  Scene scene;
  scene.media.push_back(medium);
  const Interface media{0, kVacuum};
  add_shape(scene, box_mesh(Vec3d(-1.0), Vec3d(1.0)), Boundary{}, &media);
  scene.lights.push_back(DirectionalLight{glm::normalize(Vec3(1e-4f, 0, 1)), Rgb(1.0f)});
  scene.camera = make_camera(Vec3(0, 0, 4e3f), Vec3(0.0f), Vec3(0, 1, 0), 1e-4f, {4, 4});
  scene.geometry.commit();
  finish(scene);
  RenderSettings settings = settings_of(1, 1e-3f);
  settings.single_scattering.type = DirectLight::shadow_rays;
  const double e = 1.0 - g, away = 5e-9;  // 1 - cos of 1e-4
  const double peak = e * (1.0 + g) / (4.0 * kPiD * std::pow(e * e + 2.0 * g * away, 1.5));
  const double exact = peak * 2.0 * sigma * std::exp(-2.0 * sigma);
  const Moments mean = clean_means(scene, settings, 100);
  EXPECT_NEAR(mean.mean() / exact, 1.0,
              1e-3 + normal_quantile(kFalseAlarms) * std::sqrt(mean.variance_of_mean()) / exact);
}

}  // namespace
}  // namespace vpm
