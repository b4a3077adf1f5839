// The correction at borders of media: shares of balls that are cut, and light behind walls.
#include "vpm/estimate/volume_region.h"

#include <gtest/gtest.h>

#include "support/borders.h"
#include "support/statistics.h"
#include "vpm/base/rng.h"
#include "vpm/base/warp.h"
#include "vpm/estimate/volume_estimate.h"
#include "vpm/medium/grid/make_grid.h"
#include "vpm/scene/build.h"

namespace vpm {
namespace {

Medium clear_medium() { return make_medium(nullptr, Rgb(1.0f), 1.0f); }

Scene finished(Scene scene) {
  scene.lights.push_back(PointLight{Vec3(0.0f), Rgb(1.0f)});
  scene.geometry.commit();
  finish(scene);
  return scene;
}

/// A cube of a medium in a vacuum, [-1, 1]^3 before it is turned.
Scene cube(const glm::mat3& rotation = glm::mat3(1.0f)) {
  Scene scene;
  scene.media.push_back(clear_medium());
  const Interface media{0, kVacuum};
  add_shape(scene, turned(box_mesh(Vec3d(-1.0), Vec3d(1.0)), rotation), Boundary{}, &media);
  return finished(std::move(scene));
}

/// A medium everywhere, and a wall in the plane x = 0: a sheet of nothing but area, a slab, or one that holds another
/// medium.
enum class Wall { sheet, slab, filled };
Scene walled(Wall wall) {
  Scene scene;
  scene.media.push_back(clear_medium());
  scene.world_medium = 0;
  const Interface vacuum_inside{kVacuum, 0};
  const TriangleMesh slab = box_mesh(Vec3d(-0.02, -3.0, -3.0), Vec3d(0.0, 3.0, 3.0));
  if (wall == Wall::sheet) add_shape(scene, quad_mesh(Vec3d(0, -3, -3), Vec3d(0, 6, 0), Vec3d(0, 0, 6)), Lambertian{});
  if (wall == Wall::slab) add_shape(scene, slab, Lambertian{});
  if (wall == Wall::filled) add_shape(scene, slab, Boundary{}, &vacuum_inside);
  return finished(std::move(scene));
}

constexpr uint32_t kVolumePhotons = 400;

/// Photons uniform over the box, of 1 W in all.
std::vector<Photon> even_photons(const Vec3& lo, const Vec3& hi, Rng& rng) {
  std::vector<Photon> photons(kVolumePhotons);
  for (Photon& p : photons)
    p = {lo + Vec3(rng.uniform(), rng.uniform(), rng.uniform()) * (hi - lo), PackedDirection(Vec3(0, 0, 1)), Rgb(1.0f)};
  return photons;
}

struct VolumeEstimates {
  Moments plain, corrected;
  GatherCounters counters;
};

/// Estimates of the density of photons, 1/m^3, at a point, over the density that they have in the box.
VolumeEstimates estimate(const Scene& scene, const Vec3& point, const GatherSettings& gather, const Box& box,
                         uint64_t trials, uint64_t use) {
  const auto& [lo, hi] = box;
  VolumeEstimates found;
  const VolumeRegion region(scene, 0, point, gather.kernel);
  const Vec3 extent = hi - lo;
  const float density = 1.0f / (extent.x * extent.y * extent.z);
  for (uint64_t trial = 0; trial < trials; ++trial) {
    Rng rng(7, rng_stream(RngUse::test, use), trial);
    const PhotonMap map = make_photon_map(even_photons(lo, hi, rng), gather, kVolumePhotons);
    found.plain.add(fluence(Rgb(density), point, map).r);
    Neighbours near;
    found.corrected.add(fluence(Rgb(density), point, BoundedMap{map, region, GatherWork{found.counters, near}}).r);
  }
  return found;
}

TEST(VolumeRegion, SharesOfCutBallsAreTheirIntegrals) {
  double squares = 0.0;
  int count = 0;
  for (int trial = 0; trial < 60; ++trial) {
    Rng rng(7, rng_stream(RngUse::test, 0), static_cast<uint64_t>(trial));
    const glm::mat3 rotation = trial % 3 == 0 ? glm::mat3(1.0f) : some_rotation(rng);
    const Scene scene = cube(rotation);
    const KernelKind kernel = kKernels[static_cast<size_t>(trial) % kKernels.size()].kind;
    // Near a face, an edge or a corner, as far as a radius of 0.5 m.
    Vec3 from_faces(rng.uniform(), rng.uniform(), rng.uniform());
    for (int axis = 0; axis < trial % 4 - 1; ++axis) from_faces[axis] = 2.0f;
    const Vec3 inside = glm::max(1.0f - 0.5f * from_faces, Vec3(0.0f));
    const RegionShare share = VolumeRegion(scene, 0, rotation * inside, kernel).share(0.5f);
    const double exact = share_before_walls<3>(kernel, from_faces);
    EXPECT_NEAR(share.inside, exact, 0.02) << kernel_info(kernel).name << " " << trial;
    EXPECT_FALSE(share.others);
    squares += (share.inside - exact) * (share.inside - exact);
    ++count;
  }
  EXPECT_LT(std::sqrt(squares / count), 0.005);
}

TEST(VolumeRegion, SlotsAreKnownToAPercent) {
  constexpr float kHalf = 0.2f;  // m, of the slot's width
  for (int axis = 0; axis < 3; ++axis) {
    Scene scene;
    scene.media.push_back(make_medium(nullptr, Rgb(1.0f), 1.0f));
    scene.world_medium = 0;
    for (const double side : {-1.0, 1.0}) {
      Vec3d corner(-5.0), u(0.0), v(0.0);
      corner[axis] = side * kHalf;
      u[(axis + 1) % 3] = v[(axis + 2) % 3] = 10.0;
      add_shape(scene, quad_mesh(corner, u, v), Lambertian{});
    }
    scene.lights.push_back(PointLight{Vec3(0.0f), Rgb(1.0f)});
    scene.geometry.commit();
    finish(scene);
    for (const double radius : {0.3, 0.5, 0.7, 0.87, 1.0, 1.2}) {
      const double q = kHalf / radius, exact = 1.5 * q - 0.5 * q * q * q;  // of the ball's volume
      const RegionShare share =
          VolumeRegion(scene, 0, Vec3(0.0f), KernelKind::constant).share(static_cast<float>(radius));
      EXPECT_NEAR(share.inside / exact, 1.0, 0.01) << axis << ", " << radius;
      EXPECT_TRUE(share.others);
    }
  }
}

TEST(VolumeRegion, HalvesAreHalvesAndWholesAreWholes) {
  const Scene scene = cube();
  for (const KernelInfo& kernel : kKernels) {
    const auto share = [&](const Vec3& point) { return VolumeRegion(scene, 0, point, kernel.kind).share(0.3f).inside; };
    EXPECT_EQ(share(Vec3(0.0f)), 1.0);
    EXPECT_EQ(share(Vec3(0.69f, -0.2f, 0.3f)), 1.0);
    EXPECT_NEAR(share(Vec3(0.99999f, 0.1f, -0.2f)), 0.5, 1e-3);
    EXPECT_NEAR(share(Vec3(0.1f, -0.99999f, -0.2f)), 0.5, 1e-3);
    EXPECT_NE(share(Vec3(0.75f, -0.2f, 0.3f)), 1.0);
  }
}

// A grid whose density is 0 for x > 0, up to the cell that it falls in.
TEST(VolumeRegion, LeavesOutWhereThereIsNoDensity) {
  GridFrame frame;
  frame.hi = Vec3i(40);
  frame.interpolation = Interpolation::nearest;
  frame.index_to_world = Mat4d(0.05);
  frame.index_to_world[3] = glm::dvec4(-1.0, -1.0, -1.0, 1.0);
  Scene scene;
  const Medium medium =
      make_medium(make_grid(frame, [](int x, int, int) { return x < 20 ? 1.0 + 0.01 * x : 0.0; }), Rgb(1.0f), 1.0f);
  scene.media.push_back(medium);
  const Interface media{0, kVacuum};
  add_shape(scene, box_mesh(Vec3d(-1.025), Vec3d(1.025)), Boundary{}, &media);
  scene = finished(std::move(scene));
  for (const float x : {-0.03f, -0.1f, -0.2f, -0.3f}) {
    const RegionShare share = VolumeRegion(scene, 0, {x, 0.1f, 0.0f}, KernelKind::epanechnikov).share(0.4f);
    const float wall = (-0.025f - x) / 0.4f;
    EXPECT_NEAR(share.inside, share_before_walls<3>(KernelKind::epanechnikov, {wall, 2.0f, 2.0f}), 0.01) << x;
    EXPECT_FALSE(share.others);
  }
  EXPECT_EQ(VolumeRegion(scene, 0, {-0.55f, 0.1f, 0.0f}, KernelKind::epanechnikov).share(0.1f).inside, 1.0);
}

TEST(VolumeRegion, LightDoesNotLeakThroughThinWalls) {
  const GatherSettings by_radius{GatherMode::radius, 0.5f, 0, KernelKind::epanechnikov};
  const GatherSettings nearest{GatherMode::nearest, 0.9f, 12, KernelKind::constant};
  uint64_t use = 20;
  for (const Wall wall : {Wall::sheet, Wall::slab, Wall::filled})
    for (const GatherSettings& gather : {by_radius, nearest}) {
      const Scene scene = walled(wall);
      const Vec3 lo(0.0f, -1.0f, -1.0f), hi(1.0f);  // lit is the side x > 0
      const VolumeEstimates lit = estimate(scene, Vec3(0.05f, 0.1f, 0.0f), gather, {lo, hi}, 1000, use++);
      expect_mean(lit.corrected, 1.0, 1e-6, "lit side");
      EXPECT_LT(lit.plain.mean(), 0.9);
      const VolumeEstimates dark = estimate(scene, Vec3(-0.05f, 0.1f, 0.0f), gather, {lo, hi}, 20, use++);
      EXPECT_EQ(dark.corrected.mean(), 0.0);
      EXPECT_GT(dark.plain.mean(), 0.2);
    }
}

TEST(VolumeRegion, TheMapEqualsTheBruteForceTwin) {
  const Scene scene = walled(Wall::sheet);
  const Vec3 point(0.1f, 0.2f, -0.1f);
  for (const GatherMode mode : {GatherMode::radius, GatherMode::nearest})
    for (const KernelInfo& kernel : kKernels) {
      Rng rng(7, rng_stream(RngUse::test, 30), 0);
      const GatherSettings gather{mode, 0.5f, 12, kernel.kind};
      const std::vector<Photon> photons = even_photons(Vec3(-1.0f), Vec3(1.0f), rng);
      const VolumeRegion region(scene, 0, point, kernel.kind);
      // Photons on this side alone; the share by the distance of the 12th of them.
      std::vector<Photon> seen;
      std::vector<float> distances;
      for (const Photon& p : photons)
        if (p.position.x > 0.0f) {
          seen.push_back(p);
          distances.push_back(glm::distance(p.position, point));
        }
      std::sort(distances.begin(), distances.end());
      const float radius = mode == GatherMode::radius ? 0.5f : std::min(0.5f, distances[11]);
      const float twin = fluence(Rgb(1.0f), point, seen, gather, uint64_t{kVolumePhotons}).r /
                         static_cast<float>(region.share(radius).inside);
      GatherCounters counters;
      const PhotonMap map = make_photon_map(photons, gather, kVolumePhotons);
      Neighbours near;
      EXPECT_NEAR(fluence(Rgb(1.0f), point, BoundedMap{map, region, GatherWork{counters, near}}).r / twin, 1.0, 1e-4)
          << kernel.name;
    }
}

// Between two sheets a millimetre apart.
TEST(VolumeRegion, CountsWhereTheLeastShareStandsInForLess) {
  Scene scene;
  scene.media.push_back(clear_medium());
  scene.world_medium = 0;
  add_shape(scene, quad_mesh(Vec3d(0, -3, -3), Vec3d(0, 0, 6), Vec3d(3, 6, 0)), Lambertian{});
  add_shape(scene, quad_mesh(Vec3d(0.001, -3, -3), Vec3d(0, 0, 6), Vec3d(3.001, 6, 0)), Lambertian{});
  scene = finished(std::move(scene));
  const Vec3 point(0.5f * 3.001f, 0.0f, 0.0f);
  const VolumeRegion region(scene, 0, point, KernelKind::constant);
  ASSERT_LT(region.share(0.5f).inside, kLeastShare);
  const GatherSettings gather{GatherMode::radius, 0.5f, 0, KernelKind::constant};
  const PhotonMap map = make_photon_map({{point, PackedDirection(Vec3(0, 0, 1)), Rgb(1.0f)}}, gather, 1);
  GatherCounters counters;
  Neighbours near;
  const float sum = fluence(Rgb(1.0f), point, BoundedMap{map, region, GatherWork{counters, near}}).r;
  EXPECT_NEAR(sum * kLeastShare * 4.0 / 3.0 * kPiD * 0.125, 1.0, 1e-5);
  EXPECT_EQ(counters.corrected, 1u);
  EXPECT_EQ(counters.least_shares, 1u);
}

}  // namespace
}  // namespace vpm
