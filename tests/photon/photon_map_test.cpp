// Photon maps against their brute-force twins, on spread, flat, clustered and coinciding photons.
#include <gtest/gtest.h>

#include "support/photon_layouts.h"
#include "support/statistics.h"
#include "vpm/base/rng.h"
#include "vpm/base/warp.h"
#include "vpm/estimate/surface_estimate.h"
#include "vpm/estimate/volume_estimate.h"

namespace vpm {
namespace {

Hit hit_at(const Vec3& position, const Vec3& normal) {
  Hit hit;
  hit.position = position;
  hit.normal = hit.shading_normal = normal;
  return hit;
}

/// But for rounding: of sums, and of packed powers, in shares of the largest channel.
void expect_near(const Rgb& a, const Rgb& b, const char* what) {
  const float packed = 4e-6f * max_channel(b);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 1e-4f * (1e-3f + std::abs(b[c])) + packed) << what;
}

TEST(PackedDirection, IsAccurate) {
  for (uint64_t i = 0; i < 100000; ++i) {
    Rng rng(4, rng_stream(RngUse::test, 20), i);
    Vec3 d = uniform_sphere(rng.uniform2());
    if (i < 6) d = Vec3(i == 0, i == 1, i == 2) - Vec3(i == 3, i == 4, i == 5);
    const Vec3 back = PackedDirection(d).unpack();
    ASSERT_NEAR(glm::length(back), 1.0f, 1e-6f);
    ASSERT_LT(glm::length(back - d), 7e-5f);
  }
}

TEST(PackedPower, IsAccurate) {
  const auto off = [](const Rgb& power) { return max_channel(glm::abs(PackedPower(power).unpack() - power)); };
  for (uint64_t i = 0; i < 100000; ++i) {
    Rng rng(4, rng_stream(RngUse::test, 21), i);
    const float scale = std::pow(10.0f, 70.0f * rng.uniform() - 37.0f);
    const Rgb power = scale * Rgb(rng.uniform(), rng.uniform(), rng.uniform());
    ASSERT_LE(off(power), std::max(4e-6f * max_channel(power), 1e-38f));
  }
  // Powers of two are exact; what would round up to the next one takes its exponent.
  for (int e = -125; e <= 127; ++e) ASSERT_EQ(off(Rgb(std::ldexp(1.0f, e), 0.0f, std::ldexp(1.0f, e - 1))), 0.0f);
  for (int e = -100; e <= 127; ++e)
    ASSERT_LE(off(Rgb(std::nextafter(std::ldexp(1.0f, e), 0.0f))), std::ldexp(1.0f, e - 24));
  EXPECT_EQ(off(Rgb(0.0f)), 0.0f);
}

TEST(PhotonMap, EstimatesEqualTheBruteForceTwin) {
  const Phase phase = HenyeyGreenstein{0.6f};
  const Vec3 towards = glm::normalize(Vec3(1, 2, 3));
  for (const Layout layout : kLayouts) {
    const std::vector<Photon> all = photons(layout, 5000);
    for (const GatherMode mode : {GatherMode::radius, GatherMode::nearest})
      for (const auto& [kernel, kernel_name, disc_norm, ball_norm] : kKernels)
        for (const float radius : {0.02f, 0.11f, 3.0f}) {
          const GatherSettings settings{mode, radius, 40, kernel};
          const PhotonMap map = make_photon_map(all, settings, 1000);
          SCOPED_TRACE(testing::Message()
                       << "layout " << static_cast<int>(layout) << ", by count " << (mode == GatherMode::nearest)
                       << ", " << kernel_name << ", " << radius << " m");
          for (uint64_t i = 0; i < 20; ++i) {
            Rng rng(4, rng_stream(RngUse::test, 10), i);
            const Vec3 at = all[static_cast<size_t>(rng.uniform() * 5000)].position +
                            0.3f * radius * uniform_sphere(rng.uniform2());
            expect_near(volume_sum(phase, at, towards, map).value,
                        volume_sum(phase, at, towards, all, settings, uint64_t{1000}).value, "volume");
            expect_near(surface_irradiance(at, Vec3(0, 1, 0), map).value,
                        surface_irradiance(at, Vec3(0, 1, 0), all, settings, uint64_t{1000}).value, "surface");
            for (const Material& rough : {Material(Phong{}), Material(RoughDielectric{1.5f, 0.5f})})
              expect_near(
                  scattered_radiance(rough, hit_at(at, Vec3(0, 1, 0)), towards, map).value,
                  scattered_radiance(rough, hit_at(at, Vec3(0, 1, 0)), towards, all, settings, uint64_t{1000}).value,
                  "rough surface");
          }
        }
  }
}

TEST(PhotonMap, TakesAtMost28BytesAPhoton) {
  for (const Layout layout : kLayouts)
    for (const GatherMode mode : {GatherMode::radius, GatherMode::nearest})
      for (const float radius : {1e-3f, 0.1f, 10.0f}) {
        const PhotonMap map = make_photon_map(photons(layout, 20000), {mode, radius, 40}, 1);
        EXPECT_LE(static_cast<double>(map.memory_bytes()) / 20000.0, 28.0 + 0.05);  // what a map takes beside photons
      }
}

TEST(PhotonMap, OnePhotonCountsAsTheEstimatesSay) {
  // A photon of 1 W among 4 emitted, off the point by 0.3 radii; Epanechnikov kernels of radius 0.1 m.
  const Vec3 at(1.0f, 2.0f, 3.0f), travel = glm::normalize(Vec3(0.0f, -0.8f, 0.6f)), up(0.0f, 1.0f, 0.0f);
  const GatherSettings settings{GatherMode::radius, 0.1f, 0, KernelKind::epanechnikov};
  const auto map = [&](const Vec3& off, const Vec3& d) {
    return make_photon_map({{at + off, PackedDirection(d), Rgb(1.0f)}}, settings, 4);
  };
  const float ball = 15.0f / (8.0f * kPi * 1e-3f) * 0.91f / 4.0f, disc = 2.0f / (kPi * 1e-2f) * 0.91f / 4.0f;
  const PhotonMap beside = map(Vec3(0.03f, 0.0f, 0.0f), travel);
  // Forward scattering: most goes on along the photon's direction of travel.
  const HenyeyGreenstein phase{0.6f};
  EXPECT_NEAR(volume_sum(phase, at, travel, beside).value.r / (phase.value(1.0f) * ball), 1.0f, 1e-3f);
  EXPECT_NEAR(volume_sum(phase, at, -travel, beside).value.r / (phase.value(-1.0f) * ball), 1.0f, 1e-3f);
  expect_near(fluence(Rgb(0.5f, 1.0f, 2.0f), at, beside), Rgb(2.0f, 1.0f, 0.5f) * ball, "fluence");
  // Surfaces: photons that arrive at the normal's side, near the plane.
  expect_near(surface_irradiance(at, up, beside).value, Rgb(disc), "from before");
  expect_near(surface_irradiance(at, -up, beside).value, Rgb(0.0f), "from behind");
  // Towards the eye goes the BSDF's share: from the eye's side, and from the other one through rough glass alone.
  const Vec3 eye = glm::normalize(Vec3(0.1f, 0.8f, 0.5f)), stored = PackedDirection(travel).unpack();
  const PackedDirection rising(glm::normalize(Vec3(0.0f, 0.8f, 0.3f)));
  const PhotonMap behind = map(Vec3(0.03f, 0.0f, 0.0f), rising.unpack());
  const Material diffuse = Lambertian{Rgb(0.5f)}, glass = RoughDielectric{1.5f, 0.5f}, metal = RoughConductor{};
  for (const Material& m : {diffuse, glass, metal})
    expect_near(scattered_radiance(m, hit_at(at, up), eye, beside).value,
                scatter_value(m, up, stored, eye).value / eye.y * disc, "scattered");
  for (const Material& m : {diffuse, metal})
    expect_near(scattered_radiance(m, hit_at(at, -up), eye, behind).value, Rgb(0.0f), "behind");
  const Rgb passed = scattered_radiance(glass, hit_at(at, up), eye, behind).value;
  expect_near(passed, scatter_value(glass, up, rising.unpack(), eye).value / eye.y * disc, "through glass");
  EXPECT_GT(passed.r, 0.0f);
  const float low = 0.01f, high = 0.02f;
  expect_near(surface_irradiance(at, up, map(Vec3(std::sqrt(9e-4f - low * low), low, 0.0f), travel)).value, Rgb(disc),
              "near the plane");
  expect_near(surface_irradiance(at, up, map(Vec3(std::sqrt(9e-4f - high * high), high, 0.0f), travel)).value,
              Rgb(0.0f), "off the plane");
}

// Where k photons lie within a small radius, looking for them in a large one finds the same, before a wall and above
// another floor, whose photons are stronger.
TEST(PhotonMap, TheNearestOnASurfaceAreTheSameForAnyLargestRadius) {
  constexpr int kSide = 100;  // photons along 1 m
  const PackedDirection travel(glm::normalize(Vec3(-1.0f, -1.0f, 0.2f)));
  std::vector<Photon> corner;
  for (int i = 0; i < kSide * kSide; ++i) {
    Rng rng(4, rng_stream(RngUse::test, 12), static_cast<uint64_t>(i));
    const float a = rng.uniform(), b = rng.uniform();
    corner.push_back({Vec3(a, 0.0f, b), travel, Rgb(1.0f)});
    corner.push_back({Vec3(0.0f, a, b), travel, Rgb(10.0f)});   // wall
    corner.push_back({Vec3(a, -0.1f, b), travel, Rgb(10.0f)});  // the other floor
  }
  const auto irradiance = [&](const Vec3& at, float largest_radius) {
    const GatherSettings settings{GatherMode::nearest, largest_radius, 50, KernelKind::epanechnikov};
    return surface_irradiance(at, Vec3(0, 1, 0), make_photon_map(corner, settings, kSide * kSide)).value;
  };
  for (const float off_the_wall : {0.01f, 0.03f, 0.5f}) {
    const Vec3 at(off_the_wall, 0.0f, 0.5f);
    expect_near(irradiance(at, 10.0f), irradiance(at, 0.1f), "any radius");
  }
}

TEST(PhotonMap, SmallAndEmptyMapsAnswer) {
  for (const GatherMode mode : {GatherMode::radius, GatherMode::nearest})
    for (const size_t count : {0u, 1u, 2u, 3u, 39u, 40u, 41u}) {
      const std::vector<Photon> all = photons(Layout::spread, count);
      const GatherSettings settings{mode, 0.9f, 40, KernelKind::constant};
      const PhotonMap map = make_photon_map(all, settings, 10);
      EXPECT_EQ(map.size(), count);
      expect_near(volume_sum(Isotropic{}, Vec3(0.5f), Vec3(0, 0, 1), map).value,
                  volume_sum(Isotropic{}, Vec3(0.5f), Vec3(0, 0, 1), all, settings, uint64_t{10}).value, "few photons");
    }
}

TEST(PhotonMap, CountsWhatQueriesVisitAndUse) {
  const std::vector<Photon> all = photons(Layout::spread, 5000);
  const Vec3 at(0.5f);
  const auto count = [&](const PhotonMap& map) {
    GatherCounters counters;
    Neighbours near;
    volume_sum(Isotropic{}, at, Vec3(0, 0, 1), CountedMap{map, GatherWork{counters, near}}).value;
    return counters;
  };
  const GatherSettings by_radius{GatherMode::radius, 0.2f, 0, KernelKind::constant};
  const GatherCounters near = count(make_photon_map(all, by_radius, 1));
  const auto within = [&](const Photon& p) { return glm::distance(p.position, at) < by_radius.radius; };
  EXPECT_EQ(near.used, static_cast<uint64_t>(std::count_if(all.begin(), all.end(), within)));
  EXPECT_EQ(near.searches, 1u);
  EXPECT_GE(near.visited, near.used);
  EXPECT_LT(near.visited, 8 * near.used);  // the 27 cells of a radius around the point have the volume of 6.4 balls
  const GatherCounters nearest = count(make_photon_map(all, {GatherMode::nearest, 1.0f, 40, KernelKind::constant}, 1));
  EXPECT_EQ(nearest.used, 39u);  // the k-th sets the radius
  EXPECT_GE(nearest.visited, 40u);
  EXPECT_LT(nearest.visited, 2000u);  // a tree does not look at all
  const std::vector<Photon> none;
  EXPECT_EQ(count(make_photon_map(none, by_radius, 1)).visited, 0u);
}

/// Cells twice as wide are the worst: 64 radii cubed in the place of 27.
TEST(PhotonMap, APhotonFarAwayDoesNotWidenTheCells) {
  std::vector<Photon> all = photons(Layout::spread, 5000);
  const GatherSettings settings{GatherMode::radius, 0.1f, 0, KernelKind::constant};
  const auto visited = [&] {
    const PhotonMap map = make_photon_map(all, settings, 1);
    GatherCounters counters;
    Neighbours near;
    for (uint64_t i = 0; i < 200; ++i) {
      Rng rng(4, rng_stream(RngUse::test, 13), i);
      const Vec3 at(rng.uniform(), rng.uniform(), rng.uniform());
      volume_sum(Isotropic{}, at, Vec3(0, 0, 1), CountedMap{map, GatherWork{counters, near}});
    }
    return static_cast<double>(counters.visited);
  };
  const double close = visited();
  for (const float far : {1e2f, 1e4f}) {
    all.push_back({Vec3(far, -far, 2.0f * far), PackedDirection(Vec3(0, 0, 1)), Rgb(1.0f)});
    EXPECT_LT(visited(), 4.0 * close) << far << " m";
  }
}

TEST(Kernel, KnowsItsIntegralUpToAnyRadius) {
  constexpr int kSteps = 10000;
  for (const auto& [kind, kernel_name, disc_norm, ball_norm] : kKernels)
    with_kernel<3>(kind, [kind = kind, name = kernel_name](auto profile) {
      double disc = 0.0, ball = 0.0;
      for (int i = 0; i < kSteps; ++i) {
        const double t = (i + 0.5) / kSteps;
        const double value = profile(static_cast<float>(t * t)).value / kSteps;
        disc += value * 2.0 * kPiD * t * kernel_norm_2d(kind, 1.0f);
        ball += value * 4.0 * kPiD * t * t * kernel_norm_3d(kind, 1.0f);
        const double end = (i + 1.0) / kSteps;
        EXPECT_NEAR(kernel_within_2d(kind, end), disc, 1e-5) << name;
        EXPECT_NEAR(kernel_within_3d(kind, end), ball, 1e-5) << name;
      }
      EXPECT_EQ(kernel_within_2d(kind, 1.0), 1.0);
      EXPECT_EQ(kernel_within_3d(kind, 1.0), 1.0);
      return 0;
    });
}

/// The kernel and its correction together integrate to 1 and have no second moment.
template <int Dimension>
void check_correction(KernelKind kind, const char* name) {
  constexpr int kSteps = 20000;
  with_kernel<Dimension>(kind, [&](auto profile) {
    KernelPair<double> within;
    double second_moment = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const double t = (i + 0.5) / kSteps, end = (i + 1.0) / kSteps;
      const double shell =
          (Dimension == 2 ? 2.0 * t : 4.0 * t * t) * kPiD / kSteps * kernel_norm<Dimension>(kind, 1.0f);
      const KernelPair<float> weight = profile(static_cast<float>(t * t));
      within += {weight.value * shell, weight.correction * shell};
      second_moment += (weight.value + weight.correction) * t * t * shell;
      const KernelPair<double> told = kernel_within(kind, Dimension, end);
      EXPECT_NEAR(told.value, within.value, 2e-4) << name << " " << end;
      EXPECT_NEAR(told.correction, within.correction, 3e-4) << name << " " << end;
    }
    EXPECT_NEAR(within.correction, 0.0, 1e-4) << name;
    EXPECT_NEAR(second_moment, 0.0, 1e-4) << name;
    return 0;
  });
}

TEST(Kernel, ItsCorrectionTakesTheSecondMomentAway) {
  for (const KernelInfo& kernel : kKernels) {
    check_correction<2>(kernel.kind, kernel.name);
    check_correction<3>(kernel.kind, kernel.name);
  }
}

/// The correction of a sum is -(r/2) d/dr of it: compared with the difference of sums of the same photons.
TEST(PhotonMap, TheCorrectionOfASumIsItsSlopeOverTheRadius) {
  std::vector<Photon> photons;
  Rng rng(11, 0, 0);
  for (int i = 0; i < 4000; ++i)
    photons.push_back({Vec3(rng.uniform(), rng.uniform(), rng.uniform()),
                       PackedDirection(uniform_sphere(rng.uniform2())), Rgb(0.5f + rng.uniform(), 1.0f, 2.0f)});
  const auto value = [](const Vec3&, const Rgb& power) { return power; };
  const auto sum = [&](KernelKind kernel, double radius) {
    const GatherSettings settings{GatherMode::radius, static_cast<float>(radius), 0, kernel};
    return kernel_sum<3>(make_photon_map(photons, settings, 1), Vec3(0.5f), AnyPhoton{}, value);
  };
  for (const KernelKind kernel :
       {KernelKind::cone, KernelKind::epanechnikov, KernelKind::biweight, KernelKind::triweight}) {
    constexpr double kRadius = 0.3, kStep = 1e-3;
    const KernelEstimate at = sum(kernel, kRadius);
    const Rgb slope =
        (sum(kernel, kRadius + kStep).value - sum(kernel, kRadius - kStep).value) / static_cast<float>(2 * kStep);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(at.correction[c], -0.5 * kRadius * slope[c], 0.003 * at.value[c]) << static_cast<int>(kernel);
  }
}

}  // namespace
}  // namespace vpm
