// Irradiance computed beforehand: its brute-force twin, and where there is none.
#include <gtest/gtest.h>

#include "support/photons.h"
#include "vpm/base/rng.h"
#include "vpm/base/warp.h"
#include "vpm/estimate/surface_estimate.h"
#include "vpm/integrators/photon_map/surface/irradiance_cache.h"
#include "vpm/photon/records.h"
#include "vpm/scene/build.h"

namespace vpm {
namespace {

Hit hit_of(const CachePoint& point) {
  return hit_at(point.position, point.normal.unpack(), point.shading_normal.unpack());
}

/// Points on a floor, on the underside of another close below it, and on a wall beside; of the first floor some lean.
struct Surface {
  Vec3 position, normal, shading_normal;
};
Surface surface_point(Rng& rng) {
  const float a = rng.uniform(), b = rng.uniform(), kind = rng.uniform();
  const Vec3 up(0, 1, 0), side(1, 0, 0);
  if (kind < 0.3f) return {Vec3(a, 0, b), up, up};
  if (kind < 0.5f) return {Vec3(a, 0, b), up, glm::normalize(Vec3(2.0f * rng.uniform() - 1.0f, 1.0f, 0.0f))};
  if (kind < 0.7f) return {Vec3(a, -0.02f, b), -up, -up};
  return {Vec3(0, a, b), side, side};
}

/// Looks at all cache points, and computes the irradiance at the nearest.
std::optional<Rgb> brute_force(const std::vector<CachePoint>& cache_points, const PhotonMap& map, const Hit& hit,
                               const Vec3& towards_eye) {
  const float side = glm::dot(hit.normal, towards_eye) > 0.0f ? 1.0f : -1.0f;
  const CachePoint* nearest = nullptr;
  float best = map.settings.radius;
  for (const CachePoint& point : cache_points) {
    const Vec3 offset = point.position - hit.position;
    const float distance = glm::length(offset);
    const float flat = plane_thickness(map.settings) + kSlope * distance;
    if (distance >= best || std::abs(glm::dot(offset, hit.normal)) > flat) continue;
    if (!(glm::dot(point.shading_normal.unpack(), side * hit.shading_normal) > kSameNormal)) continue;
    best = distance;
    nearest = &point;
  }
  if (!nearest) return std::nullopt;
  const Hit at = hit_of(*nearest);
  return shaded_irradiance(at, at.normal, map).value;
}

std::optional<Rgb> seen(const IrradianceCache& points, const Hit& hit, const Vec3& towards_eye) {
  GatherCounters uncounted;
  Neighbours near;
  return points.irradiance(hit, towards_eye, {uncounted, near});
}

TEST(IrradianceCache, EqualTheirBruteForceTwin) {
  std::vector<Photon> photons;
  std::vector<CachePoint> cache_points;
  for (uint64_t i = 0; i < 6'000; ++i) {
    Rng rng(5, rng_stream(RngUse::test, 1), i);
    const Surface s = surface_point(rng);
    const Vec3 travel = cosine_hemisphere(-s.normal, rng.uniform2());
    photons.push_back({s.position, PackedDirection(travel), Rgb(rng.uniform(), 1.0f, 1.0f)});
    if (i % 4 == 0) cache_points.push_back({s.position, PackedDirection(s.normal), PackedDirection(s.shading_normal)});
  }
  for (const GatherMode mode : {GatherMode::radius, GatherMode::nearest})
    for (const float radius : {0.005f, 0.02f, 0.1f}) {
      const PhotonMap map = make_photon_map(photons, {mode, radius, 20, KernelKind::epanechnikov}, 1'000);
      GatherCounters counters;
      const IrradianceCache points(cache_points, map, counters);
      EXPECT_EQ(counters.searches, cache_points.size());
      EXPECT_EQ(points.size(), cache_points.size());
      int found = 0, differ = 0;
      for (uint64_t i = 0; i < 1'000; ++i) {
        Rng rng(5, rng_stream(RngUse::test, 2), i);
        const Surface s = surface_point(rng);
        const Vec3 eye = uniform_sphere(rng.uniform2());
        if (glm::dot(eye, s.normal) * glm::dot(eye, s.shading_normal) <= 0.0f) continue;
        const Hit hit = hit_at(s.position, s.normal, s.shading_normal);
        const std::optional<Rgb> quick = seen(points, hit, eye), slow = brute_force(cache_points, map, hit, eye);
        ASSERT_EQ(quick.has_value(), slow.has_value());
        found += quick.has_value();
        if (quick) differ += max_channel(glm::abs(*quick - *slow)) > 4e-6f * max_channel(*slow);  // it is packed
      }
      EXPECT_EQ(differ, 0);
      EXPECT_GT(found, 0);
    }
}

TEST(IrradianceCache, AreNoneWhereTheTwoNormalsAreSeenFromDifferentSides) {
  const Vec3 up(0, 1, 0), leaning = glm::normalize(Vec3(1, 1, 0));
  const PhotonMap map = make_photon_map({{Vec3(0.0f), PackedDirection(-up), Rgb(1.0f)}}, {GatherMode::radius, 1.0f}, 1);
  GatherCounters counters;
  const IrradianceCache points({{Vec3(0.0f), PackedDirection(up), PackedDirection(leaning)}}, map, counters);
  const Hit hit = hit_at(Vec3(0.1f, 0.0f, 0.0f), up, leaning);
  EXPECT_TRUE(seen(points, hit, up));
  EXPECT_FALSE(seen(points, hit, glm::normalize(Vec3(-1.0f, 0.5f, 0.0f))));
  EXPECT_FALSE(seen(points, hit, -up));  // the other side
}

TEST(IrradianceCache, AreNoneOnBlackSurfaces) {
  Scene scene;
  add_shape(scene, SphereShape{Vec3(0.0f), 1.0f}, Lambertian{Rgb(0.0f)});
  scene.lights.push_back(PointLight{Vec3(0.0f), Rgb(1.0f)});
  scene.geometry.commit();
  finish(scene);
  TraceSettings settings;
  settings.emitted = 100;
  CachePointRecorder recorder(scene);
  trace_into(scene, settings, {&recorder});
  EXPECT_TRUE(recorder.points.empty());
}

}  // namespace
}  // namespace vpm
