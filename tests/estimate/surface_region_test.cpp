// The correction at edges of surfaces: shares of discs that are cut, even light on a floor, and light of other
// surfaces.
#include "vpm/estimate/surface_region.h"

#include <gtest/gtest.h>

#include <functional>

#include "support/borders.h"
#include "support/statistics.h"
#include "vpm/scene/build.h"

namespace vpm {
namespace {

const Vec3 kUp(0.0f, 0.0f, 1.0f);
constexpr uint32_t kPhotons = 400;  // of 1 W in all

/// A floor, [-1, 1]^2 in the plane z = 0 before it is turned, and what `furnish` adds.
Scene floor_scene(const glm::mat3& rotation, const std::function<void(Scene&)>& furnish = {}) {
  Scene scene;
  add_shape(scene, turned(quad_mesh(Vec3d(-1, -1, 0), Vec3d(2, 0, 0), Vec3d(0, 2, 0)), rotation), Lambertian{});
  if (furnish) furnish(scene);
  scene.lights.push_back(PointLight{Vec3(0.0f, 0.0f, 5.0f), Rgb(1.0f)});
  scene.geometry.commit();
  finish(scene);
  return scene;
}
Scene floor_scene(const std::function<void(Scene&)>& furnish = {}) { return floor_scene(glm::mat3(1.0f), furnish); }

/// The point of a surface that is met first from `from` along `direction`.
Hit hit_from(const Scene& scene, const Vec3& from, const Vec3& direction) {
  const std::optional<Hit> hit = scene.geometry.intersect({from, direction});
  EXPECT_TRUE(hit.has_value());
  return hit.value_or(Hit{});
}
Hit on_floor(const Scene& scene, float x, float y) { return hit_from(scene, {x, y, 0.05f}, -kUp); }

double share(const Scene& scene, const Hit& hit, const Vec3& towards, KernelKind kernel, float radius) {
  const GatherSettings gather{GatherMode::radius, radius, 0, kernel};
  return SurfaceRegion(scene, hit, towards, gather).share(radius).inside;
}

/// A place on a surface, with the direction of a photon that comes to it.
struct Landing {
  Vec3 position, travel;
};

struct Estimates {
  Moments plain, corrected;
  GatherCounters counters;
};

/// Irradiance on the floor by photons that land as `land` says, 1 W/m^2 where all of them land evenly on 1 m^2.
Estimates estimate(const Scene& scene, const Hit& hit, const GatherSettings& gather, uint64_t trials, uint64_t use,
                   const std::function<Landing(Rng&)>& land) {
  Estimates found;
  const SurfaceRegion region(scene, hit, kUp, gather);
  for (uint64_t trial = 0; trial < trials; ++trial) {
    Rng rng(8, rng_stream(RngUse::test, use), trial);
    std::vector<Photon> photons(kPhotons);
    for (Photon& p : photons) {
      const Landing landing = land(rng);
      p = {landing.position, PackedDirection(landing.travel), Rgb(1.0f)};
    }
    const PhotonMap map = make_photon_map(photons, gather, kPhotons);
    found.plain.add(surface_irradiance(hit.position, kUp, map).value.r);
    Neighbours near;
    found.corrected.add(
        surface_irradiance(hit.position, kUp, BoundedMap{map, region, GatherWork{found.counters, near}}).value.r);
  }
  return found;
}

TEST(SurfaceRegion, SharesOfCutDiscsAreTheirIntegrals) {
  double squares = 0.0;
  int count = 0;
  for (int trial = 0; trial < 100; ++trial) {
    Rng rng(8, rng_stream(RngUse::test, 0), static_cast<uint64_t>(trial));
    const glm::mat3 rotation = trial % 3 == 0 ? glm::mat3(1.0f) : some_rotation(rng);
    const Scene scene = floor_scene(rotation);
    const KernelKind kernel = kKernels[static_cast<size_t>(trial) % kKernels.size()].kind;
    // Near an edge or a corner, as far as a radius of 0.5 m.
    const float a = rng.uniform(), b = trial % 2 == 0 ? rng.uniform() : 2.0f;
    const Vec3 at(1.0f - 0.5f * a, 1.0f - 0.5f * b, 0.05f);
    const Vec3 up = rotation * kUp;
    const double found = share(scene, hit_from(scene, rotation * at, -up), up, kernel, 0.5f);
    const double exact = share_before_walls<2>(kernel, {a, b, 0.0f});
    EXPECT_NEAR(found, exact, 0.02) << kernel_info(kernel).name << " " << trial;
    squares += (found - exact) * (found - exact);
    ++count;
  }
  EXPECT_LT(std::sqrt(squares / count), 0.005);
}

TEST(SurfaceRegion, HalvesQuartersAndWholes) {
  const Scene scene = floor_scene();
  for (const KernelInfo& kernel : kKernels) {
    const auto at = [&](float x, float y) { return share(scene, on_floor(scene, x, y), kUp, kernel.kind, 0.3f); };
    EXPECT_EQ(at(0.0f, 0.0f), 1.0);
    EXPECT_EQ(at(0.69f, -0.69f), 1.0);
    EXPECT_NEAR(at(0.9999f, 0.1f), 0.5, 0.005);
    EXPECT_NEAR(at(0.9999f, -0.9999f), 0.25, 0.005);
    EXPECT_NE(at(0.8f, 0.1f), 1.0);
  }
}

// From outside and from inside a sphere of twice the disc's radius; a little larger, for its curvature is at the limit.
TEST(SurfaceRegion, CurvedSurfacesAreAllThere) {
  Scene scene;
  add_shape(scene, SphereShape{Vec3(0.5f, 0.2f, -0.3f), 1.05f}, Lambertian{});
  scene.lights.push_back(PointLight{Vec3(0.0f, 0.0f, 5.0f), Rgb(1.0f)});
  scene.geometry.commit();
  finish(scene);
  for (int i = 0; i < 20; ++i) {
    Rng rng(8, rng_stream(RngUse::test, 1), static_cast<uint64_t>(i));
    const Vec3 outward = uniform_sphere(rng.uniform2()), center(0.5f, 0.2f, -0.3f);
    const Hit outside = hit_from(scene, center + 2.0f * outward, -outward), inside = hit_from(scene, center, outward);
    EXPECT_EQ(share(scene, outside, outward, KernelKind::constant, 0.5f), 1.0);
    EXPECT_EQ(share(scene, inside, -outward, KernelKind::constant, 0.5f), 1.0);
    const GatherSettings gather{GatherMode::radius, 0.5f, 0, KernelKind::constant};
    const SurfaceRegion before(scene, outside, outward, gather), within(scene, inside, -outward, gather);
    for (int photon = 0; photon < 50; ++photon) {
      const Vec3 place =
          hit_from(scene, center, glm::normalize(outward + 0.25f * uniform_sphere(rng.uniform2()))).position;
      EXPECT_TRUE(before.holds(place - outside.position)) << i << " " << photon;
      EXPECT_TRUE(within.holds(place - inside.position)) << i << " " << photon;
    }
  }
}

// Each of these ends the floor at x = 0.1 m: what is behind is hidden, absent, or stores no photons.
TEST(SurfaceRegion, WallsHolesStepsAndMirrorsEndADisc) {
  const auto expect_cut = [](const char* what, const Scene& scene) {
    const double found = share(scene, on_floor(scene, 0.0f, 0.1f), kUp, KernelKind::epanechnikov, 0.4f);
    EXPECT_NEAR(found, share_before_walls<2>(KernelKind::epanechnikov, {0.25f, 2.0f, 0.0f}), 0.01) << what;
  };
  const TriangleMesh wall = quad_mesh(Vec3d(0.1, -2, -0.5), Vec3d(0, 4, 0), Vec3d(0, 0, 1));
  expect_cut("a wall", floor_scene([&](Scene& scene) { add_shape(scene, wall, Lambertian{}); }));
  expect_cut("a mirror that stands", floor_scene([&](Scene& scene) { add_shape(scene, wall, Mirror{}); }));
  const auto two_floors = [](const Material& other, double depth) {
    Scene scene;
    add_shape(scene, quad_mesh(Vec3d(-1, -1, 0), Vec3d(1.1, 0, 0), Vec3d(0, 2, 0)), Lambertian{});
    add_shape(scene, quad_mesh(Vec3d(0.1, -1, -depth), Vec3d(1, 0, 0), Vec3d(0, 2, 0)), other);
    scene.lights.push_back(PointLight{Vec3(0.0f, 0.0f, 5.0f), Rgb(1.0f)});
    scene.geometry.commit();
    finish(scene);
    return scene;
  };
  expect_cut("a mirror that lies", two_floors(Mirror{}, 0.0));
  expect_cut("another floor below", two_floors(Lambertian{}, 0.3));
  const Scene whole = two_floors(Phong{}, 0.0);
  EXPECT_EQ(share(whole, on_floor(whole, 0.0f, 0.1f), kUp, KernelKind::epanechnikov, 0.4f), 1.0);
  // Not so the border of a medium: light passes, and photons lie on either side.
  const Scene foggy = floor_scene([&](Scene& scene) {
    scene.media.emplace_back();
    const Interface media{0, kVacuum};
    add_shape(scene, box_mesh(Vec3d(0.1, -0.9, 0.0), Vec3d(0.9, 0.9, 0.5)), Boundary{}, &media);
  });
  EXPECT_EQ(share(foggy, on_floor(foggy, 0.0f, 0.1f), kUp, KernelKind::epanechnikov, 0.4f), 1.0);
  EXPECT_EQ(share(foggy, on_floor(foggy, 0.2f, 0.1f), kUp, KernelKind::epanechnikov, 0.4f), 1.0);
}

Landing on_whole_floor(Rng& rng) {
  return {Vec3(2.0f * rng.uniform() - 1.0f, 2.0f * rng.uniform() - 1.0f, 0.0f), -kUp};
}

// What photons pass on their way to the floor, as a pane does, hides no part of it; what lies on it does.
TEST(SurfaceRegion, EvenLightIsEvenUnderPanesAndBesideRugs) {
  const Scene pane = floor_scene([](Scene& s) {
    add_shape(s, quad_mesh(Vec3d(-2, -2, 0.005), Vec3d(4, 0, 0), Vec3d(0, 4, 0)), ThinDielectric{});
  });
  const Scene rug = floor_scene([](Scene& s) {
    add_shape(s, quad_mesh(Vec3d(0.1, -1, 0.002), Vec3d(0.9, 0, 0), Vec3d(0, 2, 0)), Lambertian{Rgb(0.0f)});
  });
  const auto beside_rug = [](Rng& rng) -> Landing {
    return {Vec3(1.1f * rng.uniform() - 1.0f, 2.0f * rng.uniform() - 1.0f, 0.0f), -kUp};
  };
  uint64_t use = 60;
  for (const GatherMode mode : {GatherMode::radius, GatherMode::nearest}) {
    const GatherSettings gather{mode, mode == GatherMode::radius ? 0.4f : 1.0f, 12, KernelKind::epanechnikov};
    const auto on = [&](const Scene& scene, float x) { return hit_from(scene, {x, 0.0f, 0.001f}, -kUp); };
    for (const float x : {0.0f, 0.8f, 0.9999f}) {
      const Estimates found = estimate(pane, on(pane, x), gather, 800, use++, on_whole_floor);
      expect_mean(found.corrected, 0.25, 1e-6, "under a pane");
    }
    const Estimates found = estimate(rug, on(rug, 0.0f), gather, 800, use++, beside_rug);
    expect_mean(found.corrected, 1.0 / 2.2, 1e-6, "beside a rug");
  }
}

// A wall of 45 degrees over the floor, which goes on behind it: seen from near its foot, under it. So near to a wall
// the share, about a half, is off by up to a fiftieth of the whole.
TEST(SurfaceRegion, LightDoesNotLeakUnderLeaningWalls) {
  const Scene scene = floor_scene(
      [](Scene& s) { add_shape(s, quad_mesh(Vec3d(0.1, -2, 0), Vec3d(0, 4, 0), Vec3d(-1, 0, 1)), Lambertian{}); });
  const GatherSettings gather{GatherMode::radius, 0.4f, 0, KernelKind::epanechnikov};
  const Hit hit = hit_from(scene, {0.08f, 0.0f, 0.01f}, -kUp);
  const auto behind = [](Rng& rng) -> Landing {
    return {Vec3(0.1f + 0.9f * rng.uniform(), 2.0f * rng.uniform() - 1.0f, 0.0f), -kUp};
  };
  const auto under = [](Rng& rng) -> Landing {
    return {Vec3(1.1f * rng.uniform() - 1.0f, 2.0f * rng.uniform() - 1.0f, 0.0f), -kUp};
  };
  EXPECT_EQ(estimate(scene, hit, gather, 20, 80, behind).corrected.mean(), 0.0);
  EXPECT_NEAR(estimate(scene, hit, gather, 1000, 81, under).corrected.mean() * 2.2, 1.0, 0.04);
}

// A floor of even light beside a wall on which ten times as much falls, from above, and on the top of which too.
TEST(SurfaceRegion, PhotonsOfOtherSurfacesDoNotCount) {
  const Vec3 slanting = glm::normalize(Vec3(1.0f, 0.0f, -1.0f));
  const TriangleMesh block = box_mesh(Vec3d(0.1, -2, -1), Vec3d(2, 2, 0.25));
  const Scene scene = floor_scene([&](Scene& s) { add_shape(s, block, Lambertian{}); });
  const Hit floor = on_floor(scene, 0.0f, 0.0f), top = hit_from(scene, {0.15f, 0.0f, 1.0f}, -kUp);
  const auto land = [&](Rng& rng) -> Landing {
    const float which = rng.uniform(), a = rng.uniform(), b = rng.uniform();
    const float y = 2.0f * b - 1.0f;
    if (which < 0.2f) return {Vec3(1.1f * a - 1.0f, y, 0.0f), slanting};  // 2.2 m^2
    if (which < 0.6f) return {Vec3(0.1f, y, 0.25f * a), slanting};        // the wall
    return {Vec3(0.1f + 0.9f * a, y, 0.25f), slanting};                   // its top, 1.8 m^2
  };
  uint64_t use = 20;
  for (const GatherMode mode : {GatherMode::radius, GatherMode::nearest}) {
    const GatherSettings gather{mode, 0.5f, 12, KernelKind::epanechnikov};
    const Estimates below = estimate(scene, floor, gather, 1500, use++, land);
    expect_mean(below.corrected, 0.2 / 2.2, 1e-6, "floor");
    EXPECT_GT(below.plain.mean(), 1.5 * 0.2 / 2.2);
    const Estimates above = estimate(scene, top, gather, 1500, use++, land);
    expect_mean(above.corrected, 0.4 / 1.8, 1e-6, "top");
  }
}

// A floor that ends at a ramp of 60 degrees, low enough to be near its plane and in sight, and brightly lit.
TEST(SurfaceRegion, PhotonsOfSteepSlopesDoNotCount) {
  const Vec3 slanting = glm::normalize(Vec3(1.0f, 0.0f, -1.0f)), foot(0.3f, -1.0f, 0.0f), rise(0.05f, 0.0f, 0.0866f);
  Scene scene;
  add_shape(scene, quad_mesh(Vec3d(-1, -1, 0), Vec3d(1.3, 0, 0), Vec3d(0, 2, 0)), Lambertian{});
  add_shape(scene, quad_mesh(Vec3d(foot), Vec3d(rise), Vec3d(0, 2, 0)), Lambertian{});
  scene.lights.push_back(PointLight{Vec3(0.0f, 0.0f, 5.0f), Rgb(1.0f)});
  scene.geometry.commit();
  finish(scene);
  const auto land = [&](Rng& rng) -> Landing {
    const bool on_ramp = rng.uniform() < 0.5f;
    const float a = rng.uniform(), y = 2.0f * rng.uniform();
    return {on_ramp ? foot + a * rise + Vec3(0.0f, y, 0.0f) : Vec3(1.3f * a - 1.0f, y - 1.0f, 0.0f), slanting};
  };
  const GatherSettings gather{GatherMode::radius, 0.5f, 0, KernelKind::epanechnikov};
  const Estimates found = estimate(scene, on_floor(scene, 0.0f, 0.0f), gather, 1500, 50, land);
  expect_mean(found.corrected, 0.5 / 2.6, 1e-6, "floor");
  EXPECT_GT(found.plain.mean(), 1.2 * 0.5 / 2.6);
}

TEST(SurfaceRegion, TheMapEqualsTheBruteForceTwin) {
  const Scene scene = floor_scene(
      [](Scene& s) { add_shape(s, quad_mesh(Vec3d(0, -2, 0), Vec3d(0, 4, 0), Vec3d(0, 0, 1)), Lambertian{}); });
  const Hit hit = on_floor(scene, 0.05f, 0.0f);
  for (const GatherMode mode : {GatherMode::radius, GatherMode::nearest})
    for (const KernelInfo& kernel : kKernels) {
      Rng rng(8, rng_stream(RngUse::test, 40), 0);
      const GatherSettings gather{mode, 0.3f, 12, kernel.kind};
      std::vector<Photon> photons(kPhotons), seen;
      std::vector<float> distances;
      for (Photon& p : photons) {
        p = {on_whole_floor(rng).position, PackedDirection(-kUp), Rgb(1.0f)};
        if (p.position.x < 0.0f) continue;
        seen.push_back(p);
        distances.push_back(glm::distance(p.position, hit.position));
      }
      std::sort(distances.begin(), distances.end());
      const float radius = mode == GatherMode::radius ? 0.3f : std::min(0.3f, distances[11]);
      const SurfaceRegion region(scene, hit, kUp, gather);
      const float twin = surface_irradiance(hit.position, kUp, seen, gather, uint64_t{kPhotons}).value.r /
                         static_cast<float>(region.share(radius).inside);
      GatherCounters counters;
      const PhotonMap map = make_photon_map(photons, gather, kPhotons);
      Neighbours near;
      EXPECT_NEAR(
          surface_irradiance(hit.position, kUp, BoundedMap{map, region, GatherWork{counters, near}}).value.r / twin,
          1.0, 1e-4)
          << kernel.name;
    }
}

}  // namespace
}  // namespace vpm
