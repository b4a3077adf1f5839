// Crossings of beams and rays against their brute-force twin.
#include "vpm/photon/map/photon_beam_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "support/statistics.h"
#include "vpm/base/parallel.h"
#include "vpm/base/rng.h"
#include "vpm/base/warp.h"
#include "vpm/photon/photon_beam.h"

namespace vpm {
namespace {

enum class Bundle { scattered, parallel, far, short_ones };

std::vector<PhotonBeam> beams_of(Bundle bundle, int count) {
  std::vector<PhotonBeam> beams;
  Rng rng(7, rng_stream(RngUse::test, static_cast<uint64_t>(bundle)), 0);
  for (int i = 0; i < count; ++i) {
    PhotonBeam beam;
    beam.direction = uniform_sphere(rng.uniform2());
    beam.origin = Vec3(rng.uniform(), rng.uniform(), rng.uniform());
    beam.length = rng.uniform();
    beam.power = Rgb(1.0f + static_cast<float>(i));
    if (bundle == Bundle::parallel) beam.direction = Vec3(0.0f, 0.0f, 1.0f);
    if (bundle == Bundle::short_ones) beam.length *= 1e-3f;
    if (bundle == Bundle::far && i % 50 == 0) {
      beam.origin -= 1e3f * beam.direction;
      beam.length = 1e6f;
    }
    beams.push_back(beam);
  }
  return beams;
}

/// How the lines of a beam and a ray pass each other, in doubles.
struct Pass {
  double t, s, distance, sine;  // as in BeamCrossings
};

Pass pass_of(const PhotonBeam& beam, const Ray& ray) {
  const Vec3d from = Vec3d(beam.origin) - Vec3d(ray.origin), w(ray.direction), b(beam.direction);
  const Vec3d normal = glm::cross(b, w);
  const double sine = glm::length(normal);
  const Vec3d beside = from - glm::dot(from, w) * w, turned = b - glm::dot(b, w) * w;
  const double s = -glm::dot(beside, turned) / glm::dot(turned, turned);
  return {glm::dot(from, w) + s * glm::dot(b, w), s, std::abs(glm::dot(from, normal)) / sine, sine};
}

/// How far inside its limits a crossing lies, m: below 0 where there is none.
double depth_of(const Pass& pass, const PhotonBeam& beam, const Interval& interval, float radius) {
  return std::min({pass.t - double{interval.t0}, double{interval.t1} - pass.t, pass.s, double{beam.length} - pass.s,
                   double{radius} - pass.distance});
}

TEST(PhotonBeamMap, FindsEachCrossingOnce) {
  uint64_t met = 0;
  for (const Bundle bundle : {Bundle::scattered, Bundle::parallel, Bundle::far, Bundle::short_ones})
    for (const float radius : {0.005f, 0.1f, 2.0f}) {
      const std::vector<PhotonBeam> all = beams_of(bundle, 2000);
      const PhotonBeamMap map(all, radius, 0.5f);
      const float resolved = bundle == Bundle::far ? 3e-3f : 3e-5f;  // m: of floats, 1 km from the origin
      for (uint64_t i = 0; i < 30; ++i) {
        Rng rng(8, rng_stream(RngUse::test, 3), i);
        const Ray ray{Vec3(rng.uniform(), rng.uniform(), rng.uniform()), uniform_sphere(rng.uniform2())};
        const Interval interval{-0.5f * rng.uniform(), i % 3 == 0 ? kInfinity : rng.uniform()};
        std::map<uint32_t, int> found;
        map.visit_crossings(ray, interval, [&](const BeamCrossings& crossings) {
          for (size_t k = 0; k < crossings.size; ++k) {
            const auto number = static_cast<uint32_t>(2.0f * crossings.r[k] - 1.0f);  // its power is half of that and 1
            const PhotonBeam& beam = all.at(number);
            const Pass pass = pass_of(beam, ray);
            EXPECT_GT(depth_of(pass, beam, interval, radius), -double{resolved} / pass.sine);
            EXPECT_NEAR(crossings.t[k], pass.t, resolved / pass.sine);
            EXPECT_NEAR(crossings.s[k], pass.s, resolved / pass.sine + 1e-7 * beam.length);
            EXPECT_NEAR(std::sqrt(crossings.distance2[k]), pass.distance, resolved / pass.sine);
            EXPECT_NEAR(crossings.sine[k], pass.sine, 1e-5);
            EXPECT_EQ(Rgb(crossings.r[k], crossings.g[k], crossings.b[k]), 0.5f * beam.power);
            EXPECT_EQ(Vec3(crossings.dx[k], crossings.dy[k], crossings.dz[k]), beam.direction);
            ++found[number];
          }
        });
        for (uint32_t b = 0; b < all.size(); ++b) {
          const Pass pass = pass_of(all[b], ray);
          EXPECT_LE(found[b], 1);
          if (depth_of(pass, all[b], interval, radius) > double{resolved} / pass.sine) {
            EXPECT_EQ(found[b], 1) << b;
          }
          met += static_cast<uint64_t>(found[b]);
        }
      }
    }
  EXPECT_GT(met, 10'000u);
}

TEST(PhotonBeamMap, FindsEachBeamNearAPointOnce) {
  uint64_t met = 0;
  for (const Bundle bundle : {Bundle::scattered, Bundle::parallel, Bundle::far, Bundle::short_ones})
    for (const float radius : {0.01f, 0.1f, 2.0f}) {
      const std::vector<PhotonBeam> all = beams_of(bundle, 2000);
      const PhotonBeamMap map(all, radius, 0.5f);
      const double resolved = bundle == Bundle::far ? 3e-3 : 3e-5;  // m: of floats, 1 km from the origin
      for (uint64_t i = 0; i < 100; ++i) {
        Rng rng(8, rng_stream(RngUse::test, 4), i);
        const Vec3 point(rng.uniform(), rng.uniform(), rng.uniform());
        std::map<uint32_t, int> found;
        map.visit_near(point, [&](const BeamPlaces& places) {
          for (size_t k = 0; k < places.size; ++k) {
            const auto number = static_cast<uint32_t>(2.0f * places.r[k] - 1.0f);  // its power is half of that and 1
            const PhotonBeam& beam = all.at(number);
            const Vec3d place = Vec3d(beam.origin) - Vec3d(point) + double{places.s[k]} * Vec3d(beam.direction);
            EXPECT_EQ(places.beam[k], number);
            EXPECT_NEAR(glm::length(place - Vec3d(places.x[k], places.y[k], places.z[k])), 0.0, resolved);
            EXPECT_NEAR(glm::dot(place, Vec3d(beam.direction)), 0.0, resolved);
            EXPECT_NEAR(std::sqrt(places.distance2[k]), glm::length(place), resolved);
            EXPECT_EQ(Vec3(places.dx[k], places.dy[k], places.dz[k]), beam.direction);
            EXPECT_EQ(Rgb(places.r[k], places.g[k], places.b[k]), 0.5f * beam.power);
            ++found[number];
          }
        });
        for (uint32_t b = 0; b < all.size(); ++b) {
          const Vec3d from = Vec3d(all[b].origin) - Vec3d(point), d(all[b].direction);
          const double s = -glm::dot(from, d), distance = glm::length(from + s * d);
          const double depth = std::min({s, double{all[b].length} - s, double{radius} - distance});
          EXPECT_LE(found[b], 1);
          if (std::abs(depth) > resolved) {
            EXPECT_EQ(found[b], depth > 0.0 ? 1 : 0) << b;
          }
          met += static_cast<uint64_t>(found[b]);
        }
      }
    }
  EXPECT_GT(met, 100'000u);
}

// Each flight is kept as often, with the power of those that it stands for.
TEST(ThinFlights, KeepsSumsInTheMean) {
  constexpr int kBeams = 1000, kMost = 37, kDraws = 4000;
  std::vector<int> kept(kBeams, 0);
  for (uint64_t i = 0; i < kDraws; ++i) {
    std::vector<std::vector<PhotonBeam>> by_medium(2);
    for (int b = 0; b < kBeams; ++b)
      by_medium[b < 300 ? 0 : 1].push_back({Vec3(0.0f), 1.0f + b, Vec3(1, 0, 0), Rgb(1)});
    Rng rng(3, rng_stream(RngUse::test, 12), i);
    thin(by_medium, kMost, rng);
    int stretches = 0;
    for (const std::vector<PhotonBeam>& beams : by_medium)
      for (const PhotonBeam& beam : beams) {
        const auto times = static_cast<int>(std::lround(beam.power.g * kMost / 1000.0f));
        ASSERT_FLOAT_EQ(beam.power.g, static_cast<float>(times) * 1000.0f / kMost);
        kept[static_cast<size_t>(beam.length - 1.0f)] += times;
        stretches += times;
      }
    ASSERT_EQ(stretches, kMost);
  }
  const double expected = 1.0 * kDraws * kMost / kBeams;  // 148, binomial: six standard deviations are one in 1e6 runs
  for (const int count : kept) EXPECT_NEAR(count, expected, 6.0 * std::sqrt(expected));
}

// Which are kept in one stretch does not tell which are in the next: at equal distances all would be of the same half
// of a list whose records are by turns from one half of a lamp and the other.
TEST(ThinFlights, KeepsAsManyOfEitherHalf) {
  constexpr int kBeams = 4096, kMost = 1024, kDraws = 400;
  Moments odd;
  for (uint64_t i = 0; i < kDraws; ++i) {
    std::vector<std::vector<PhotonBeam>> by_medium(1);
    for (int b = 0; b < kBeams; ++b) by_medium[0].push_back({Vec3(0.0f), 1.0f + (b & 1), Vec3(1, 0, 0), Rgb(1)});
    Rng rng(4, rng_stream(RngUse::test, 12), i);
    thin(by_medium, kMost, rng);
    double of_odd = 0.0;
    for (const PhotonBeam& beam : by_medium[0]) of_odd += beam.length > 1.5f ? beam.power.g : 0.0;
    odd.add(of_odd / kBeams);
  }
  expect_mean(odd, 0.5, kFalseAlarms);
  EXPECT_LT(odd.variance(),
            2.0 * 0.25 / kMost);  // that of so many coins is 0.25 / kMost; at equal distances it is 0.25
}

TEST(ThinFlights, KeepsAllWhereTheyAreFew) {
  std::vector<std::vector<PhotonBeam>> by_medium{{{Vec3(0.0f), 1.0f, Vec3(1, 0, 0), Rgb(2.0f)}}, {}};
  Rng rng(1, 0, 0);
  for (const uint64_t most : {0, 1, 5}) {
    thin(by_medium, most, rng);
    ASSERT_EQ(by_medium[0].size(), 1u);
    EXPECT_EQ(by_medium[0][0].power, Rgb(2.0f));
  }
}

// Beams are cut where that makes boxes smaller, and no more finely. Leaves are full: 768 bytes of 16 pieces each, and
// 24 of their box and those above.
TEST(PhotonBeamMap, CutsLongBeamsOnly) {
  constexpr int kBeams = 16384;
  const auto leaves = [](Bundle bundle, float radius) {
    return static_cast<double>(PhotonBeamMap(beams_of(bundle, kBeams), radius, 1.0f).memory_bytes()) / (768 + 26);
  };
  EXPECT_NEAR(leaves(Bundle::short_ones, 1e-4f), kBeams / 16, 8);
  EXPECT_NEAR(leaves(Bundle::scattered, 1.0f), kBeams / 16, 8);
  EXPECT_NEAR(leaves(Bundle::scattered, 1e-4f), 2 * kBeams / 16, 16);
  EXPECT_NEAR(leaves(Bundle::far, 1e-4f), 8 * kBeams / 16, 64);
}

TEST(PhotonBeamMap, IsTheSameOnAnyNumberOfThreads) {
  const std::vector<PhotonBeam> all = beams_of(Bundle::scattered, 50'000);
  const auto found = [&](int threads) {
    set_threads(threads);
    const PhotonBeamMap map(all, 0.01f, 1.0f);
    std::vector<float> numbers;
    map.visit_crossings({Vec3(0.1f), glm::normalize(Vec3(1.0f, 2.0f, 3.0f))}, {0.0f, 1.0f}, [&](const auto& crossings) {
      for (const float* values : {crossings.t, crossings.s, crossings.distance2, crossings.r})
        numbers.insert(numbers.end(), values, values + crossings.size);
    });
    return numbers;
  };
  const std::vector<float> on_one = found(1), on_two = found(2);
  set_threads(0);
  EXPECT_GT(on_one.size(), 1000u);
  EXPECT_EQ(on_one, on_two);
}

TEST(PhotonBeamMap, OfNoBeamsFindsNone) {
  const PhotonBeamMap map({}, 0.1f, 1.0f);
  EXPECT_EQ(
      map.visit_crossings({Vec3(0.0f), Vec3(0.0f, 0.0f, 1.0f)}, {0.0f, 1.0f}, [](const BeamCrossings&) { FAIL(); }),
      0u);
}

// A ray along a beam has no common perpendicular with it.
TEST(PhotonBeamMap, ParallelLinesDoNotCross) {
  const Vec3 along(0.6f, 0.0f, 0.8f);
  const PhotonBeamMap map({{Vec3(0.0f), 1.0f, along, Rgb(1.0f)}}, 0.1f, 1.0f);
  map.visit_crossings({Vec3(0.0f, 0.05f, 0.0f), along}, {0.0f, 1.0f}, [](const BeamCrossings& crossings) {
    for (size_t i = 0; i < crossings.size; ++i) EXPECT_GT(crossings.sine[i], 0.0f);  // as they are rounded
  });
  const Vec3 axis(0.0f, 0.0f, 1.0f);
  const PhotonBeamMap exact({{Vec3(0.0f), 1.0f, axis, Rgb(1.0f)}}, 0.1f, 1.0f);
  exact.visit_crossings({Vec3(0.0f, 0.05f, 0.0f), axis}, {0.0f, 1.0f}, [](const BeamCrossings&) { FAIL(); });
}

}  // namespace
}  // namespace vpm
