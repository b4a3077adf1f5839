// Strategies and estimators where they are known to fail, and along rays that are hard for all.
#include <fmt/format.h>

#include "hard/hard_scenes.h"
#include "vpm/base/fnv.h"
#include "vpm/base/statistics/tails.h"
#include "vpm/medium/transmittance/estimator.h"
#include "vpm/study/careful_settings.h"

namespace vpm {
namespace {

/// A cloud along x: a dense core of density 20 in the voxels 0 to 9, then thin edges of 0.05 up to voxel 89.
Medium cloud_with_thin_edges() {
  GridFrame frame;
  frame.lo = Vec3i(-1, -1, -1);
  frame.hi = Vec3i(90, 1, 1);
  frame.interpolation = Interpolation::nearest;
  return make_medium(make_grid(frame, [](int x, int, int) { return x < 0 || x > 89 ? 0.0
                                                                   : x < 10        ? 20.0
                                                                                   : 0.05; }),
                     Rgb(0.05f), 0.9f);
}

TEST(StrategiesExtremes, MeanExtinctionInThinEdgesIsUnbiasedAndItsSampleSizeTellsItsVariance) {
  const Medium cloud = cloud_with_thin_edges();
  const Ray ray{Vec3(10.0f, 0.0f, 0.0f), Vec3(1, 0, 0)};
  const Interval edge{0.0f, 79.0f};
  const double sigma = cloud.sigma_t.r, rate = sigma * cloud.mean_density(), thin = sigma * 0.05;
  const double through = std::exp(-thin * 79.0), drawn = std::exp(-rate * 79.0);
  EXPECT_LT(thin, 0.1 * rate);
  const auto strategy = make_distance_strategy({.strategy = "mean-extinction"});
  constexpr uint64_t kFlights = 1'000'000;
  double sum = 0.0, squares = 0.0;
  Moments left;
  for (uint64_t i = 0; i < kFlights; ++i) {
    Rng rng(1, rng_stream(RngUse::test, 0), i);
    const Flight flight = strategy->sample(cloud, ray, edge, Rgb(1.0f), rng);
    left.add(flight.collided ? 0.0 : flight.weight.r);
    if (flight.collided) continue;
    EXPECT_NEAR(flight.weight.r / (through / drawn), 1.0, 1e-4);
    sum += flight.weight.r;
    squares += double(flight.weight.r) * flight.weight.r;
  }
  // The variance is known: a weight through/drawn with probability drawn.
  const double error = through * std::sqrt((1.0 / drawn - 1.0) / kFlights);
  EXPECT_LT(std::abs(left.mean() - through), normal_quantile(kFalseAlarms) * error);
  const double sample_size = sum * sum / squares;
  std::printf("mean-extinction: transmittance %.5f, exact %.5f +- %.5f; effective sample size %.0f of %d\n",
              left.mean(), through, error, sample_size, int(kFlights));
  EXPECT_NEAR(sample_size, drawn * kFlights, 6.0 * std::sqrt(drawn * kFlights));
}

TEST(StrategiesExtremes, TheLedgerReportsHeavyTails) {
  // The same cloud in a box, lit along its length from its thin end: analog flights all weigh the same, those at the
  // mean rate do not, and both close the ledger.
  Scene scene;
  scene.media.push_back(cloud_with_thin_edges());
  const Interface media{0, kVacuum};
  add_shape(scene, box_mesh(Vec3d(-0.5), Vec3d(89.5, 0.5, 0.5)), Boundary{}, &media);
  scene.lights.push_back(BeamLight{Vec3(100, 0, 0), Vec3(-1, 0, 0), 0.4f, Rgb(1.0f)});
  scene.geometry.commit();
  finish(scene);
  const Ledger analog = clean_ledger(scene, "regular", 20000);
  EXPECT_FLOAT_EQ(static_cast<float>(analog.weights.largest), 1.0f);
  EXPECT_NEAR(analog.weights.effective_sample_size() / 20000.0, 1.0, 1e-6);
  ListSettings settings;
  settings.emitted = 20000;
  const Ledger weighted = trace_with(scene, "mean-extinction", settings).ledger;
  EXPECT_EQ(weighted.non_finite, 0u);
  std::printf("mean-extinction: largest weight %.3g, effective sample size %.0f of 20000 photons\n",
              weighted.weights.largest, weighted.weights.effective_sample_size());
  EXPECT_GT(weighted.weights.largest, 5.0);
  EXPECT_LT(weighted.weights.effective_sample_size(), 0.5 * 20000.0);
}

/// A ray through a medium along which the optical thickness is known.
struct HardRay {
  std::string name;
  Medium medium;
  Ray ray;
  Interval interval;
  double thickness = 0.0;
  bool spike = false;  // so heavy a tail that estimators which look at few places are not determined
};

/// A grid of that many cells along each axis, voxels of that size, densities by the lattice point.
template <class Density>
std::shared_ptr<const DensityGrid> cells_of(const Vec3i& cells, const Vec3d& voxel, Interpolation kind,
                                            Density density) {
  GridFrame frame;
  frame.lo = Vec3i(0);
  frame.hi = cells;
  frame.index_to_world = glm::scale(Mat4d(1.0), voxel);
  frame.interpolation = kind;
  return make_grid(frame, density);
}

/// Density integrals that follow from the field's formula: spikes, needles, plates, faces, edges, directions next to an
/// axis.
std::vector<HardRay> hard_rays() {
  const auto spike = [](int x, int, int) { return x == 100 ? 1e6 : 1e-6; };
  const auto linear = [](int x, int y, int z) { return 1.0 + x + 2.0 * y + 3.0 * z; };
  const Vec3d unit(1.0), needle(1.0, 1e-3, 1e-3), plate(1e-3, 1.0, 1.0);
  const auto box = cells_of(Vec3i(200, 40, 2), unit, Interpolation::nearest, spike);
  const auto tent = cells_of(Vec3i(200, 40, 2), unit, Interpolation::trilinear, spike);
  const auto field = cells_of(Vec3i(24), unit, Interpolation::trilinear, linear);
  const auto needles = cells_of(Vec3i(24), needle, Interpolation::trilinear, linear);
  const auto plates = cells_of(Vec3i(24), plate, Interpolation::trilinear, linear);
  const auto denormal = cells_of(Vec3i(24), unit, Interpolation::nearest, [](int, int, int) { return 0x1p-130; });
  const Vec3 x(1, 0, 0), almost_x(1.0f, 1e-38f, -1e-38f), aslant(1.0f, 0.5f, 0.0f), through(12.0f, 12e-3f, 12e-3f);
  const Interval whole{0.0f, 210.0f}, part{0.0f, 7.0f};
  const float way = glm::length(through);
  return {
      {"a spike of one voxel", make_medium(box, Rgb(2e-6f)), {Vec3(-5, 1, 1), x}, whole, 2.0, true},
      {"the same, interpolated", make_medium(tent, Rgb(2e-6f)), {Vec3(-5, 1, 1), x}, whole, 2.0, true},
      {"a spike aslant",
       make_medium(box, Rgb(1e-6f)),
       {Vec3(60, -5, 1), glm::normalize(aslant)},
       {0.0f, 90.0f},
       std::sqrt(1.25),
       true},
      {"along an edge", make_medium(field, Rgb(0.004f)), {Vec3(2, 8, 8), x}, part, 0.004 * 7.0 * 46.5},
      {"next to a face", make_medium(field, Rgb(0.004f)), {Vec3(2, 8, 8.5f), almost_x}, part, 0.004 * 7.0 * 48.0},
      {"along needles", make_medium(needles, Rgb(0.004f)), {Vec3(2, 8e-3f, 8e-3f), x}, part, 0.004 * 7.0 * 46.5},
      {"across needles",
       make_medium(needles, Rgb(0.003f)),
       {Vec3(4, 4e-3f, 4e-3f), glm::normalize(through)},
       {0.0f, way},
       0.003 * way * 61.0},
      {"across plates", make_medium(plates, Rgb(4.0f)), {Vec3(2e-3f, 8, 8), x}, {0.0f, 7e-3f}, 4.0 * 7e-3 * 46.5},
      {"denormal densities", make_medium(denormal, Rgb(0x1p126f)), {Vec3(2, 8, 8), x}, {0.0f, 16.0f}, 1.0},
  };
}

/// The mean of draws against what gets through: exact where all are one value, not determined where they have heavy
/// tails.
template <class Draw>
Check check_draws(const std::string& name, double through, const Draw& draw) {
  constexpr uint64_t kDraws = 40000;
  Fnv1a seed;
  seed.add(name);
  Moments draws;
  for (uint64_t i = 0; i < kDraws; ++i) {
    Rng rng(seed.value(), rng_stream(RngUse::test, 1), i);
    draws.add(draw(rng));
  }
  EXPECT_TRUE(std::isfinite(draws.variance())) << name;
  if (std::sqrt(draws.variance()) < 1e-6 * draws.mean())
    return check_bound(name, draws.mean(), through, 1e-6 * through);
  return check_weighted_mean(name, draws, through);
}

TEST(StrategiesExtremes, HardRaysAreCrossedByAllThatHaveNoBias) {
  std::vector<Check> checks;
  for (const HardRay& hard : hard_rays()) {
    const double through = std::exp(-hard.thickness);
    for (const StrategyInfo& info : distance_strategies()) {
      // progressive-null has no bias with the majorant that careful_settings() gives it.
      if (!info.heterogeneous || info.marches) continue;
      const auto strategy = make_distance_strategy(careful_settings(info.name));
      checks.push_back(check_draws(fmt::format("{}: {}", hard.name, info.name), through, [&](Rng& rng) {
        const Flight flight = strategy->sample(hard.medium, hard.ray, hard.interval, Rgb(1.0f), rng);
        EXPECT_TRUE(std::isfinite(flight.weight.r));
        return flight.collided ? 0.0 : double(flight.weight.r);
      }));
      EXPECT_TRUE(checks.back().value > 0.0 || !info.positive) << checks.back().name;
      const bool may_be_unknown = hard.spike && !info.bounded_weight;
      EXPECT_TRUE(may_be_unknown || checks.back().kind != CheckKind::undetermined) << checks.back().name;
    }
    for (const EstimatorInfo& info : transmittance_estimators()) {
      if (!info.unbiased) continue;
      const auto estimator = make_transmittance_estimator({.estimator = std::string(info.name)});
      checks.push_back(check_draws(fmt::format("{}: {}", hard.name, info.name), through, [&](Rng& rng) {
        return double(estimator->estimate(hard.medium, hard.ray, hard.interval, rng).value.r);
      }));
      if (hard.spike && (info.name == "residual-ratio" || info.name == "unbiased-ray-march")) continue;
      EXPECT_GT(checks.back().value, 0.0) << checks.back().name;
      EXPECT_NE(checks.back().kind, CheckKind::undetermined) << checks.back().name;
    }
  }
  judge(checks, kFalseAlarms);
  int passed = 0;
  for (const Check& check : checks) {
    passed += check.verdict == Verdict::pass;
    EXPECT_NE(check.verdict, Verdict::fail)
        << check.name << ": " << check.value << ", exact " << check.exact << " +- " << check.error;
    if (check.verdict == Verdict::undetermined) std::printf("%s: %s\n", check.name.c_str(), check.note.c_str());
  }
  std::printf("hard rays: %d of %d passed\n", passed, int(checks.size()));
}

TEST(StrategiesExtremes, ASpikeOfOneVoxelIsSeenByAllButTheMarch) {
  GridFrame frame;
  frame.lo = Vec3i(0);
  frame.hi = Vec3i(200, 2, 2);
  frame.interpolation = Interpolation::nearest;
  const Medium medium =
      make_medium(make_grid(frame, [](int x, int, int) { return x == 100 ? 1e6 : 1e-6; }), Rgb(2e-6f));
  const Ray ray{Vec3(-5.0f, 1.0f, 1.0f), Vec3(1, 0, 0)};
  const double through = std::exp(-2.0);
  constexpr uint64_t kFlights = 20000;
  const auto share = [&](const DistanceSettings& settings) {
    double passed = 0.0;
    const auto strategy = make_distance_strategy(settings);
    for (uint64_t i = 0; i < kFlights; ++i) {
      Rng rng(1, rng_stream(RngUse::test, 1), i);
      const Flight flight = strategy->sample(medium, ray, {}, Rgb(1.0f), rng);
      EXPECT_TRUE(std::isfinite(flight.weight.r));
      EXPECT_TRUE(settings.strategy == "ray-march" || !flight.collided || std::abs(flight.t - 105.0f) < 0.5001f);
      passed += flight.collided ? 0.0 : flight.weight.r;
    }
    return passed / kFlights;
  };
  for (const char* strategy : {"regular", "delta", "delta-local", "decomposition"})
    expect_share(share({.strategy = strategy}), through, kFlights, strategy);
  EXPECT_NEAR(share({"ray-march", {{"step", 2.0f}}}), 1.0, 1e-4) << "its middles miss the spike: documented";
}

}  // namespace
}  // namespace vpm
