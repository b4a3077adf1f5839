// What lies near rays of a bundle is found for the bundle, by brute force.
#include "vpm/photon/map/ray_bundle.h"

#include <gtest/gtest.h>

#include <map>

#include "vpm/base/rng.h"
#include "vpm/base/warp.h"
#include "vpm/photon/map/photon_beam_map.h"
#include "vpm/photon/map/segment_map.h"

namespace vpm {
namespace {

constexpr size_t kRays = 16;

/// Rays from one point, within some angle of a direction.
struct Rays {
  Vec3 apex;
  std::vector<Vec3> directions;
};

Rays rays_within(float angle, uint64_t number) {
  Rng rng(11, rng_stream(RngUse::test, 0), number);
  Rays rays{Vec3(rng.uniform(), rng.uniform(), rng.uniform()) * 3.0f - 1.0f, {}};
  const Vec3 axis = uniform_sphere(rng.uniform2());
  for (size_t i = 0; i < kRays; ++i)
    rays.directions.push_back(glm::normalize(axis + angle * uniform_sphere(rng.uniform2())));
  return rays;
}

std::vector<PhotonBeam> random_beams(size_t count) {
  std::vector<PhotonBeam> beams(count);
  for (size_t i = 0; i < count; ++i) {
    Rng rng(11, rng_stream(RngUse::test, 1), i);
    beams[i].origin = Vec3(rng.uniform(), rng.uniform(), rng.uniform());
    beams[i].direction = i % 3 == 0 ? Vec3(0.0f, 1.0f, 0.0f) : uniform_sphere(rng.uniform2());
    beams[i].length = i % 100 == 0 ? 1e4f : rng.uniform();
    beams[i].power = Rgb(1.0f, 2.0f, 3.0f);
  }
  return beams;
}

TEST(RayBundle, HoldsItsRays) {
  for (uint64_t n = 0; n < 200; ++n) {
    const Rays rays = rays_within(n % 2 == 0 ? 0.01f : 0.3f, n);
    const RayBundle bundle(rays.apex, rays.directions, 10.0f);
    for (const Vec3& direction : rays.directions)
      for (const float t : {0.0f, 1e-3f, 1.0f, 9.99f}) EXPECT_TRUE(bundle.region().hold(t * direction)) << n;
    EXPECT_FALSE(bundle.region().hold(-0.1f * rays.directions[0]));
    EXPECT_FALSE(bundle.region().hold(15.0f * rays.directions[0]));
  }
}

TEST(RayBundle, IsAsWideAsItsRays) {
  const std::vector<Vec3> two{glm::normalize(Vec3(0.1f, 0.0f, 1.0f)), glm::normalize(Vec3(-0.1f, 0.0f, 1.0f))};
  EXPECT_NEAR(spread_of(two), 0.2f, 1e-6f);
  EXPECT_EQ(spread_of(std::vector<Vec3>(3, Vec3(0.0f, 0.0f, 1.0f))), 0.0f);
  const std::vector<Vec3> apart{Vec3(1.0f, 0.0f, 0.0f), Vec3(-1.0f, 0.0f, 0.0f)};
  EXPECT_EQ(spread_of(apart), kInfinity);
}

// Each photon within the radius of some ray is found, once, with all that it has; none that is far from the bundle.
TEST(RayBundle, FindsPhotonsNearItsRays) {
  std::vector<Photon> photons(5000);
  for (size_t i = 0; i < photons.size(); ++i) {
    Rng rng(11, rng_stream(RngUse::test, 2), i);
    photons[i] = {Vec3(rng.uniform(), rng.uniform(), rng.uniform()), PackedDirection(uniform_sphere(rng.uniform2())),
                  Rgb(static_cast<float>(i + 1))};
  }
  size_t near_rays = 0, found_in_all = 0;
  for (const float radius : {0.003f, 0.05f, 0.5f}) {
    const SegmentMap map(photons, {.largest = radius}, 1.0f);
    for (uint64_t n = 0; n < 60; ++n) {
      const Rays rays = rays_within(n % 2 == 0 ? 0.01f : 0.3f, n);
      const float farthest = n % 3 == 0 ? 0.7f : 10.0f;
      std::map<size_t, int> found;
      map.visit_near_bundle(RayBundle(rays.apex, rays.directions, farthest), [&](const BundledPhotons& near) {
        for (size_t i = 0; i < near.size; ++i) {
          const auto number = static_cast<size_t>(std::lround(near.r[i]) - 1);
          const Photon& photon = photons.at(number);
          EXPECT_NEAR(glm::distance(Vec3(near.x[i], near.y[i], near.z[i]), photon.position - rays.apex), 0.0f, 1e-6f);
          EXPECT_EQ(Vec3(near.dx[i], near.dy[i], near.dz[i]), photon.travel.unpack());
          ++found[number];
        }
      });
      for (size_t i = 0; i < photons.size(); ++i) {
        EXPECT_LE(found[i], 1);
        found_in_all += static_cast<size_t>(found[i]);
        for (const Vec3& direction : rays.directions) {
          const Vec3 offset = photons[i].position - rays.apex;
          const float t = glm::dot(offset, direction);
          if (t < 0.0f || t > farthest || glm::length(offset - t * direction) > radius - 1e-6f) continue;
          EXPECT_EQ(found[i], 1) << i;
          ++near_rays;
          break;
        }
      }
    }
  }
  EXPECT_GT(near_rays, 10'000u);
  EXPECT_LT(found_in_all, 2 * near_rays);
}

// The same of beams, and of a part of a bundle from what was found for the whole.
TEST(RayBundle, FindsBeamsThatItsRaysCross) {
  const std::vector<PhotonBeam> beams = random_beams(3000);
  PhotonBeamMap::Selection near;
  size_t crossed = 0, found_in_all = 0;
  for (const float radius : {0.002f, 0.05f, 0.5f}) {
    const PhotonBeamMap map(beams, radius, 1.0f);
    for (uint64_t n = 0; n < 60; ++n) {
      const Rays rays = rays_within(n % 2 == 0 ? 0.01f : 0.3f, n);
      const RayBundle whole(rays.apex, rays.directions, 10.0f);
      const std::span<const Vec3> half(rays.directions.data(), kRays / 2);
      map.select(whole, near);
      std::map<uint32_t, std::vector<std::pair<float, float>>> found;  // of each beam, from where to where
      near.visit_near_bundle(RayBundle(rays.apex, half, 10.0f), [&](const BundledBeams& pieces) {
        for (size_t i = 0; i < pieces.size; ++i) {
          const PhotonBeam& beam = beams.at(pieces.beam[i]);
          const Vec3 middle = Vec3(pieces.x[i], pieces.y[i], pieces.z[i]) + rays.apex;
          const float s = glm::dot(middle - beam.origin, beam.direction);
          EXPECT_NEAR(glm::distance(middle, beam.origin + s * beam.direction), 0.0f, 1e-6f * (1.0f + s));
          EXPECT_EQ(Vec3(pieces.dx[i], pieces.dy[i], pieces.dz[i]), beam.direction);
          EXPECT_EQ(Rgb(pieces.r[i], pieces.g[i], pieces.b[i]), beam.power);
          found[pieces.beam[i]].push_back({s - pieces.half[i], s + pieces.half[i]});
          ++found_in_all;
        }
      });
      for (const Vec3& direction : half) {
        map.visit_crossings({rays.apex, direction}, {0.0f, 10.0f}, [&](const BeamCrossings& crossings) {
          for (size_t i = 0; i < crossings.size; ++i) {
            const float slack = 1e-5f * (1.0f + crossings.s[i]) / crossings.sine[i];
            const auto& pieces = found[crossings.beam[i]];
            EXPECT_TRUE(std::any_of(pieces.begin(), pieces.end(), [&](const auto& piece) {
              return crossings.s[i] >= piece.first - slack && crossings.s[i] <= piece.second + slack;
            }));
            ++crossed;
          }
        });
      }
    }
  }
  EXPECT_GT(crossed, 10'000u);
  EXPECT_LT(found_in_all, crossed);
}

}  // namespace
}  // namespace vpm
