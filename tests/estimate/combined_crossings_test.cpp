// One path of light that the eye's ray finds as a plane, as a short beam and as a long one: each has the share in it
// that its density says, so that what they find by their shares is the same.
#include <gtest/gtest.h>

#include "support/grids.h"
#include "support/scenes.h"
#include "vpm/integrators/combined/combined.h"

namespace vpm {
namespace {

constexpr float kWidth = 0.1f;  // the radius of beams, m
const Ray kSight{{-0.9f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}};
const Vec3 kFirst = glm::normalize(Vec3(0.3f, 0.4f, 0.5f)), kSecond = glm::normalize(Vec3(-0.2f, 0.9f, -0.4f));
const Vec3 kMet(0.1f, 0.0f, 0.0f), kTurn = kMet - 0.5f * kSecond, kStart = kTurn - 0.3f * kFirst;
const Rgb kPhoton(3.0f, 2.0f, 1.0f);

TechniqueCounts counts_of_crossings() {
  const double width = kernel_size_1d(KernelKind::epanechnikov, kWidth);
  TechniqueCounts counts;
  counts.short_beams = counts.long_beams = width;
  counts.planes = 1.0;
  return counts;
}

/// A light sub-path that flies from a point light to the turn, and on from there.
LightSubPaths one_light_path(const Scene& scene, const TechniqueCounts& counts) {
  const Medium& medium = scene.media[0];
  const Light& light = scene.lights[0];
  const Ray ray{kStart, kFirst};
  const Departure start =
      depart_from_light(counts, light, 1.0, emission_density(light, scene.bounds, {}, kFirst), ray, {});
  Arrival turn;
  turn.vertex.point = kTurn;
  turn.vertex.travel = kFirst;
  turn.vertex.medium = 0;
  turn.vertex.density = medium.density(kTurn);
  turn.junction = junction_of(counts, scene, turn.vertex);
  turn.leg = leg_to(start, kTurn, transmittance(medium, density_integral(medium, ray, {0.0f, 0.3f}).value));
  turn.sums = arrive(counts, start, turn.leg, turn.junction, kTurn);
  const double phase = phase_density(medium, kFirst, kSecond);
  const Departure from_turn = depart(counts, turn, {kSecond, phase, phase}, SubPath::light, false);
  LightSubPaths paths(1);
  paths.planes.push_back({kStart, 0.4f, kFirst, kSecond, kPhoton, 0});
  paths.plane_starts.push_back({start, Rgb(1.0f)});
  for (LightFlights* flights : {&paths.short_beams, &paths.long_beams}) {
    flights->beams[0].push_back({kTurn, 0.8f, kSecond, kPhoton * medium.albedo(), {}, 0.0f});
    flights->flights[0].push_back(flight_terms(counts, from_turn, Rgb(1.0f), kTurn));
  }
  paths.ledger.emitted_count = 1;
  return paths;
}

/// What the ray finds in a grey grid.
TechniqueParts parts_of(const Medium& medium) {
  Scene scene = boxed_medium(medium, PointLight{kStart, Rgb(1.0f)});
  scene.camera = make_camera(kSight.origin, kMet, Vec3(0, 1, 0), 40.0f, {1, 1});
  const TechniqueCounts counts = counts_of_crossings();
  const MergeKernels kernels{KernelKind::epanechnikov, KernelKind::epanechnikov, kWidth, kWidth, kWidth, kWidth};
  const SortedLight light(scene, counts, kernels, one_light_path(scene, counts));
  const auto strategy = make_distance_strategy({}, {});
  const auto exact = make_transmittance_estimator({});
  EyeCounters counters;
  EyeScratch scratch;
  Rng rng(1, 0, 0);
  EyeWork work{rng, counters, scratch};
  scene.camera_medium = 0;
  TechniqueParts parts;
  combined_radiance({scene, *strategy, *exact, counts, kernels, light}, kSight, work, &parts);
  return parts;
}

TEST(CombinedCrossings, PlanesAndBeamsFindAsMuchOfAPathAsTheirDensitiesSay) {
  const auto density = [](int x, int y, int z) { return 0.4 + lattice_noise(x, y, z); };
  Medium medium = make_medium(make_grid(centred_frame(8, 0.125), density), Rgb(1.4f), 0.8f);
  medium.phase = HenyeyGreenstein{0.4f};
  const TechniqueParts parts = parts_of(medium);
  const auto weighted = [&](Technique t) { return parts.weighted[static_cast<size_t>(t)]; };
  const Rgb plane = weighted(Technique::planes);
  // The beams' kernel has its greatest value at the crossing.
  const float peak =
      kernel_norm_1d(KernelKind::epanechnikov, kWidth) * kernel_size_1d(KernelKind::epanechnikov, kWidth);
  for (int c = 0; c < 3; ++c) {
    EXPECT_GT(plane[c], 0.0f);
    EXPECT_NEAR(weighted(Technique::short_beams)[c] / peak, plane[c], 1e-4f * plane[c]);
    EXPECT_NEAR(weighted(Technique::long_beams)[c] / peak, plane[c], 1e-4f * plane[c]);
  }
  // Of a path that each of the three finds in one way alone, the shares sum to 1.
  double sum = 0.0;
  for (const Technique t : {Technique::planes, Technique::short_beams, Technique::long_beams})
    sum += double{weighted(t).g} / double{parts.unweighted[static_cast<size_t>(t)].g};
  EXPECT_NEAR(sum, 1.0, 1e-5);
}

}  // namespace
}  // namespace vpm
