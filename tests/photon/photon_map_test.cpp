// Photon maps against their brute-force twins, on spread, flat, clustered and coinciding photons.
#include <gtest/gtest.h>

#include "support/photons.h"
#include "support/statistics.h"
#include "vpm/base/rng.h"
#include "vpm/base/warp.h"
#include "vpm/estimate/surface_estimate.h"
#include "vpm/estimate/volume_estimate.h"

namespace vpm {
namespace {

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
      for (const KernelInfo& kernel : kKernels)
        for (const float radius : {0.02f, 0.11f, 3.0f}) {
          const GatherSettings settings{mode, radius, 40, kernel.kind};
          const PhotonMap map = make_photon_map(all, settings, 1000);
          SCOPED_TRACE(testing::Message()
                       << "layout " << static_cast<int>(layout) << ", by count " << (mode == GatherMode::nearest)
                       << ", " << kernel.name << ", " << radius << " m");
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
  EXPECT_EQ(near.by_count, 0u);
  EXPECT_EQ(nearest.by_count, 1u);
  EXPECT_EQ(nearest.short_of, 0u);
  for (const uint32_t count_asked : {1000u, 4000u}) {  // one by one, and by nodes
    GatherSettings few{GatherMode::nearest, 0.2f, count_asked, KernelKind::epanechnikov};
    EXPECT_EQ(count(make_photon_map(all, few, 1)).short_of, 1u);
    few.radius = 2.0f;
    EXPECT_EQ(count(make_photon_map(all, few, 1)).short_of, 0u);
  }
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

/// Compares kernel_within_1d(), _2d() or _3d() with sums over shells.
template <int Dimension, class Within>
void expect_within(const KernelInfo& kernel, Within&& within) {
  constexpr int kSteps = 10000;
  with_kernel<Dimension>(kernel.kind, [&](auto profile) {
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      constexpr double kSphere = Dimension == 1 ? 2.0 : 2.0 * (Dimension - 1) * kPiD;  // of radius 1
      const double t = (i + 0.5) / kSteps, shell = kSphere * std::pow(t, Dimension - 1) / kSteps;
      sum += profile(static_cast<float>(t * t)).value * shell * kernel_norm<Dimension>(kernel.kind, 1.0f);
      const double end = (i + 1.0) / kSteps;
      EXPECT_NEAR(within(kernel.kind, end), sum, 1e-5) << kernel.name;
      EXPECT_GT(within(kernel.kind, end), 0.0) << kernel.name;
    }
    EXPECT_EQ(within(kernel.kind, 1.0), 1.0);
    return 0;
  });
}

TEST(Kernel, KnowsItsIntegralUpToAnyRadius) {
  for (const KernelInfo& kernel : kKernels) {
    expect_within<1>(kernel, kernel_within_1d);
    expect_within<2>(kernel, kernel_within_2d);
    expect_within<3>(kernel, kernel_within_3d);
  }
}

/// Integrals over the unit ball of profile^power |x|^moment over that of the profile.
template <int Dimension>
double integral_of_order_4(int power, int moment) {
  constexpr int kSteps = 20000;
  double sum = 0.0, all = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) / kSteps, shell = std::pow(t, Dimension - 1) / kSteps;
    const double value = kernel_profile<KernelKind::order_4, Dimension>(static_cast<float>(t * t));
    sum += std::pow(value, power) * std::pow(t, moment) * shell;
    all += value * shell;
  }
  const double sphere = Dimension == 1 ? 2.0 : 2.0 * (Dimension - 1) * kPiD;
  return power == 1 ? sum / all : sum / (all * all * sphere);
}

// By hand: the roughness is 5/4 on a line, 24/(5 pi) on a plane, 525/(88 pi) in space; the fourth moment -1/21, -1/10,
// -5/33; all of a radius of 1.
TEST(Kernel, OfOrderFourHasNoSecondMoment) {
  EXPECT_NEAR(integral_of_order_4<1>(1, 2), 0.0, 1e-6);
  EXPECT_NEAR(integral_of_order_4<2>(1, 2), 0.0, 1e-6);
  EXPECT_NEAR(integral_of_order_4<3>(1, 2), 0.0, 1e-6);
  EXPECT_NEAR(integral_of_order_4<1>(1, 4), -1.0 / 21.0, 1e-6);
  EXPECT_NEAR(integral_of_order_4<2>(1, 4), -1.0 / 10.0, 1e-6);
  EXPECT_NEAR(integral_of_order_4<3>(1, 4), -5.0 / 33.0, 1e-6);
  EXPECT_NEAR(integral_of_order_4<1>(2, 0), 5.0 / 4.0, 1e-5);
  EXPECT_NEAR(integral_of_order_4<2>(2, 0), 24.0 / (5.0 * kPiD), 1e-5);
  EXPECT_NEAR(integral_of_order_4<3>(2, 0), 525.0 / (88.0 * kPiD), 1e-5);
}

double plain_sum(int dimension, const PhotonMap& map) {
  const auto power = [](const Vec3&, const Rgb& p) { return p; };
  return dimension == 2 ? kernel_sum<2>(map, Vec3(0.0f), AnyPhoton{}, power).value.r
                        : kernel_sum<3>(map, Vec3(0.0f), AnyPhoton{}, power).value.r;
}

/// How far the mean estimate of the density cos(x) at its crest is off, by a lattice of photons.
double bias_at_crest(int dimension, KernelKind kernel, float radius) {
  const int reach = dimension == 2 ? 100 : 28;  // photons along a radius
  std::vector<Photon> wave, even;
  const PackedDirection travel(Vec3(0, 0, 1));
  for (int z = dimension == 2 ? 0 : -reach; z <= (dimension == 2 ? 0 : reach); ++z)
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x) {
        const Vec3 at = radius / static_cast<float>(reach) * Vec3(x, y, z);
        wave.push_back({at, travel, Rgb(std::cos(at.x))});
        even.push_back({at, travel, Rgb(1.0f)});
      }
  const GatherSettings settings{GatherMode::radius, radius, 0, kernel};
  return plain_sum(dimension, make_photon_map(wave, settings, 1)) /
             plain_sum(dimension, make_photon_map(even, settings, 1)) -
         1.0;
}

// Twice the radius makes 4 times the error, or 16 times; less what higher orders take, a tenth here. The error of order
// 4 is E[x^4]/4! = -r^4/640 on a plane and -r^4/792 in space.
TEST(Kernel, BiasGoesWithItsPowerOfTheRadius) {
  for (const int dimension : {2, 3})
    for (const KernelInfo& kernel : kKernels) {
      const double narrow = bias_at_crest(dimension, kernel.kind, 0.8f);
      const double slope = std::log2(bias_at_crest(dimension, kernel.kind, 1.6f) / narrow);
      EXPECT_NEAR(slope, kernel_order(kernel.kind), 0.2) << kernel.name << " in " << dimension << " dimensions";
      if (kernel.kind != KernelKind::order_4) continue;
      EXPECT_NEAR(narrow / std::pow(0.8, 4.0), dimension == 2 ? -1.0 / 640.0 : -1.0 / 792.0, 1.5e-4);
    }
}

/// The variance of estimates from `kPhotons` photons that are uniform over the square or cube around the point, 2 m
/// wide.
double variance_of(int dimension, KernelKind kernel) {
  constexpr size_t kPhotons = 400, kMaps = 4000;
  double sum = 0.0, squares = 0.0;
  for (size_t m = 0; m < kMaps; ++m) {
    Rng rng(4, rng_stream(RngUse::test, 14), m);
    std::vector<Photon> even(kPhotons);
    for (Photon& p : even) {
      p.position = 2.0f * Vec3(rng.uniform(), rng.uniform(), dimension == 2 ? 0.5f : rng.uniform()) - 1.0f;
      p.power = Rgb(1.0f);
      p.travel = PackedDirection(Vec3(0, 0, 1));
    }
    const double found = plain_sum(dimension, make_photon_map(even, {GatherMode::radius, 0.8f, 0, kernel}, kPhotons));
    sum += found / kMaps;
    squares += found * found / kMaps;
  }
  return squares - sum * sum;
}

// n photons over a volume V make a variance of (R/V - 1/V^2) / n, R the roughness. Ratios of variances of 4000 maps of
// the same photons are off by 3 % or so: false alarms are below 1e-4.
TEST(Kernel, OfOrderFourHasTheVarianceThatItsRoughnessTells) {
  const double area = 0.64 * kPiD, volume = 0.512 * kPiD;
  const double plane = (24.0 / (5.0 * area) - 1.0 / 4.0) / (4.0 / (3.0 * area) - 1.0 / 4.0);
  const double space = (525.0 / (88.0 * volume) - 1.0 / 8.0) / (15.0 / (14.0 * volume) - 1.0 / 8.0);
  const auto ratio = [](int dimension) {
    return variance_of(dimension, KernelKind::order_4) / variance_of(dimension, KernelKind::epanechnikov);
  };
  EXPECT_NEAR(ratio(2), plane, 0.12 * plane);
  EXPECT_NEAR(ratio(3), space, 0.12 * space);
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
       {KernelKind::cone, KernelKind::epanechnikov, KernelKind::biweight, KernelKind::triweight, KernelKind::order_4}) {
    constexpr double kRadius = 0.3, kStep = 1e-3;
    const double tolerance = 0.0015 * kernel_order(kernel);  // of the step; order 4 is steeper at its edge
    const KernelEstimate at = sum(kernel, kRadius);
    const Rgb slope =
        (sum(kernel, kRadius + kStep).value - sum(kernel, kRadius - kStep).value) / static_cast<float>(2 * kStep);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(at.correction[c], -0.5 * kRadius * slope[c], tolerance * at.value[c]) << static_cast<int>(kernel);
  }
}

}  // namespace
}  // namespace vpm
