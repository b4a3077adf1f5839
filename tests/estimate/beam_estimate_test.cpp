// The beam radiance estimate against its brute-force twin, and the density integrals along a ray that it asks for.
#include "vpm/estimate/beam_estimate.h"

#include <gtest/gtest.h>

#include "support/photons.h"
#include "support/statistics.h"
#include "vpm/base/parallel.h"
#include "vpm/medium/grid/density_integrals_along.h"
#include "vpm/medium/grid/make_grid.h"

namespace vpm {
namespace {

BeamMap beam_map(const std::vector<Photon>& all, const GatherSettings& settings, uint64_t emitted) {
  return {settings, SegmentMap(all, {settings.radius, settings.beam_count},
                               static_cast<float>(1.0 / static_cast<double>(emitted)))};
}

/// A ray past one of the photons: oblique, or along an axis.
Ray any_ray(const std::vector<Photon>& all, float radius, uint64_t i) {
  Rng rng(4, rng_stream(RngUse::test, 11), i);
  const Vec3 past = all[static_cast<size_t>(rng.uniform() * static_cast<float>(all.size()))].position +
                    0.3f * radius * uniform_sphere(rng.uniform2());
  Vec3 direction = uniform_sphere(rng.uniform2());
  if (i % 3 == 0) direction = Vec3(i % 2 == 0, 0.0f, i % 2 == 1);
  return {past - 0.7f * direction, direction};
}

/// Every other search is between two planes near the ray's middle, and counts distances from one of them.
BesideRay search_beside(const Ray& ray, const Interval& interval, uint64_t i) {
  if (i % 2 == 0) return {ray, interval};
  Rng rng(4, rng_stream(RngUse::test, 12), i);
  HalfSpaces within;
  PlaneDistances distances;
  for (const float side : {1.0f, -1.0f}) {
    Vec3 normal = uniform_sphere(rng.uniform2());
    if (side * glm::dot(normal, ray.direction) < 0.0f) normal = -normal;
    const float at = 0.7f - side * 0.2f * rng.uniform();  // m along the ray
    within.add(normal, at * glm::dot(normal, ray.direction));
    if (side > 0.0f) distances = {normal / glm::dot(normal, ray.direction), 0.0f};
  }
  return {ray, interval, within, distances};
}

TEST(BeamEstimate, EqualsItsBruteForceTwin) {
  const Phase phase = HenyeyGreenstein{0.6f};
  const auto along = [](float t) { return glm::exp(-Rgb(0.5f, 1.0f, 2.0f) * std::max(t, 0.0f)); };
  int found = 0;
  for (const Layout layout : kLayouts) {
    const std::vector<Photon> all = photons(layout, 5000);
    for (const KernelInfo& kernel : kKernels)
      for (const float radius : {0.02f, 0.11f, 3.0f}) {
        const GatherSettings settings{.radius = radius, .kernel = kernel.kind};
        const BeamMap map = beam_map(all, settings, 1000);
        SCOPED_TRACE(testing::Message() << "layout " << static_cast<int>(layout) << ", " << kernel.name << ", "
                                        << radius << " m");
        for (uint64_t i = 0; i < 20; ++i) {
          const Ray ray = any_ray(all, radius, i);
          // Ends that part photons evenly, and an endless one.
          const BesideRay there = search_beside(ray, {0.31f, i % 4 == 0 ? kInfinity : 0.92f}, i);
          GatherCounters counters;
          const KernelEstimate quick = beam_sum(phase, there, each_distance(along), map, counters).sum;
          const KernelEstimate slow = beam_sum(phase, there, along, PhotonList{all, settings, 1000});
          // Rounding of distances changes profiles of far photons by parts of 1e-5 of the kernel's height.
          const float height = kernel_norm_2d(kernel.kind, radius) * static_cast<float>(counters.used) * 1e-3f;
          for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(quick.value[c], slow.value[c], 1e-4f * std::abs(slow.value[c]) + 1e-4f * height) << "ray " << i;
            EXPECT_NEAR(quick.correction[c], slow.correction[c], 1e-4f * std::abs(slow.value[c]) + 2e-4f * height)
                << "ray " << i;
          }
          found += counters.used > 0;
          EXPECT_LE(counters.used, counters.visited);
        }
      }
  }
  EXPECT_GT(found, 1000);
}

// Each photon within its own radius, by the map's own words of where photons and what radii are.
TEST(BeamEstimate, EqualsTheSumOverPhotonsWithRadiiOfTheirOwn) {
  for (const Layout layout : kLayouts) {
    const GatherSettings settings{.radius = 0.2f, .beam_count = 40};
    const BeamMap map = beam_map(photons(layout, 5000), settings, 1);
    float least = kInfinity, most = 0.0f;
    for (uint64_t i = 0; i < 50; ++i) {
      const Ray ray = any_ray(photons(layout, 5000), 0.1f, i);
      GatherCounters counters;
      const Rgb quick =
          beam_sum(Isotropic{}, {ray, {0.3f, 0.9f}}, each_distance([](float t) { return Rgb(t); }), map, counters)
              .sum.value;
      Rgbd slow(0.0);
      double height = 0.0;  // of the kernels added up, at the middle
      for (size_t k = 0; k < map.photons.size(); ++k) {
        const float radius = map.photons.radius(k);
        const Vec3 offset = map.photons.photons().position(k) - ray.origin;
        const float t = glm::dot(offset, ray.direction), across = glm::length(offset - t * ray.direction);
        least = std::min(least, radius);
        most = std::max(most, radius);
        if (!(t >= 0.3f && t < 0.9f && across < radius)) continue;
        const float q = across * across / (radius * radius);
        const Rgb middle = map.photons.photons().payload(k).power.unpack() * t *
                           kernel_norm_2d(KernelKind::epanechnikov, radius) / (4.0f * kPi);
        slow += Rgbd(middle * kernel_profile<KernelKind::epanechnikov, 2>(q));
        height += max_channel(middle);
      }
      // Rounding of distances changes profiles of far photons by parts of 1e-5 of the kernel's height.
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(quick[c], slow[c], 1e-4 * (slow[c] + height)) << "ray " << i;
    }
    EXPECT_LE(most, 0.2f);
    EXPECT_GE(least, 0.999f * BeamRadii::kLeastShare * 0.2f);
  }
}

// In even light radii are those of balls of that many photons, and in a later pass smaller.
TEST(SegmentMap, ChoosesRadiiByCount) {
  const uint64_t n = 50'000;
  std::vector<Photon> even(n);
  for (uint64_t i = 0; i < n; ++i) {
    Rng rng(5, rng_stream(RngUse::test, 1), i);
    even[i] = {Vec3(rng.uniform(), rng.uniform(), rng.uniform()), PackedDirection(Vec3(1, 0, 0)), Rgb(1.0f)};
  }
  const auto mean_radius = [&](const BeamRadii& radii) {
    const SegmentMap map(even, radii, 1.0f);
    double sum = 0.0;
    for (size_t i = 0; i < n; ++i) sum += map.radius(i);
    return sum / static_cast<double>(n);
  };
  for (const uint32_t count : {20u, 80u, 500u}) {
    const double of_ball = std::cbrt(0.75 / kPiD * count / static_cast<double>(n));
    EXPECT_NEAR(mean_radius({1.0f, count}), of_ball, 0.02 * of_ball) << count;
    EXPECT_NEAR(mean_radius({1.0f, count, 0.5f}), 0.5 * mean_radius({1.0f, count}), 1e-6) << count;
  }
  EXPECT_FLOAT_EQ(static_cast<float>(mean_radius({0.01f, 500})), 0.01f);
  EXPECT_FLOAT_EQ(static_cast<float>(mean_radius({0.01f})), 0.01f);
}

TEST(BeamEstimate, IsTheSameOnAnyNumberOfThreads) {
  const std::vector<Photon> all = photons(Layout::clustered, 200'000);
  const auto sums = [&](int threads) {
    set_threads(threads);
    const BeamMap map = beam_map(all, {.radius = 0.05f}, 1);
    std::vector<Rgb> result;
    for (uint64_t i = 0; i < 50; ++i) {
      GatherCounters counters;
      result.push_back(beam_sum(Isotropic{}, {any_ray(all, 0.05f, i), {0.0f, 2.0f}},
                                each_distance([](float) { return Rgb(1.0f); }), map, counters)
                           .sum.value);
    }
    return result;
  };
  const std::vector<Rgb> one = sums(1), three = sums(3);
  set_threads(0);
  EXPECT_EQ(one, three);
}

TEST(SegmentMap, TakesAtMost28BytesAPhotonAndAnswersWithoutAny) {
  for (const Layout layout : kLayouts) {
    const SegmentMap map(photons(layout, 20'000), {0.1f}, 1.0f);
    EXPECT_LE(static_cast<double>(map.memory_bytes()) / 20'000.0, 28.0 + 0.1);  // what a map takes beside photons
  }
  const SegmentMap none(std::vector<Photon>{}, {1.0f, 50}, 1.0f);
  EXPECT_EQ(none.visit_near_ray({Ray{}, Interval{}}, [](const PhotonsNearRay&) { ADD_FAILURE(); }), 0u);
}

TEST(DensityIntegralsAlong, AreThoseOfTheMedium) {
  const Medium cloud = make_medium(
      make_grid(
          centered_frame(12, 0.1),
          [](int x, int y, int z) { return std::max(0.0, std::sin(0.7 * x) + std::cos(0.5 * y) * std::sin(0.3 * z)); }),
      Rgb(1.0f));
  const Medium even{.name = "", .sigma_s = Rgb(0.0f), .sigma_t = Rgb(1.0f), .phase = Isotropic{}, .grid = nullptr};
  const Box box = cloud.grid->bounds();
  DensityIntegralsAlong integrals;
  for (const Medium* medium : {static_cast<const Medium*>(nullptr), &even, static_cast<const Medium*>(&cloud)})
    for (uint64_t i = 0; i < 200; ++i) {
      Rng rng(6, rng_stream(RngUse::test, 0), i);
      const Vec3 to = box.lo + Vec3(rng.uniform(), rng.uniform(), rng.uniform()) * box.extent();
      const Vec3 direction = uniform_sphere(rng.uniform2());
      const Ray ray{to - box.diagonal() * direction, direction};
      const Interval interval{0.1f * box.diagonal(), 2.0f * box.diagonal()};
      integrals.walk(medium, ray, interval);
      for (int k = 0; k < 10; ++k) {
        const float t = interval.t0 + rng.uniform() * interval.length();
        const auto [integral_to, density] = integrals.at(t);
        EXPECT_NEAR(integral_to, medium ? density_integral(*medium, ray, {interval.t0, t}).value : 0.0,
                    1e-6 * box.diagonal());
        EXPECT_NEAR(density, medium ? medium->density(ray.at(t)) : 0.0f, 2e-4) << t;
      }
      const double whole = medium ? density_integral(*medium, ray, interval).value : 0.0;
      EXPECT_NEAR(integrals.integral(), whole, 1e-12 * box.diagonal());
      for (const double part : {0.0, 0.3, 0.7, 0.999})
        if (whole > 0.0) {
          EXPECT_NEAR(integrals.at(integrals.where(part * whole)).integral, part * whole, 1e-10 * whole);
        }
    }
}

}  // namespace
}  // namespace vpm
