// Sums over many nearest photons by whole nodes against their brute-force twins: which photons they take, what these
// add up to, and that nothing but the photons and the query decides about the bits of the result.
#include "vpm/photon/map/nearest_sums.h"

#include <gtest/gtest.h>

#include "support/photons.h"
#include "vpm/base/parallel.h"
#include "vpm/base/rng.h"
#include "vpm/base/warp.h"
#include "vpm/estimate/surface_estimate.h"

namespace vpm {
namespace {

/// A tilted square of 1 m, lit from both sides but mostly from above; one that stands on its edge, lit from one side;
/// and a ball beside them: so nodes are taken whole, in part, and not at all, for each reason that there is.
std::vector<Photon> photons_of_surfaces(size_t count) {
  const Vec3 up = glm::normalize(Vec3(0.3f, 1.0f, -0.2f));
  Vec3 s, t;
  make_frame(up, s, t);
  std::vector<Photon> all(count);
  for (size_t i = 0; i < count; ++i) {
    Rng rng(4, rng_stream(RngUse::test, 40), i);
    const float a = rng.uniform() - 0.5f, b = rng.uniform() - 0.5f;
    Vec3 normal = up, place = a * s + b * t;
    if (i % 4 == 1) {
      normal = t;
      place = a * s + (0.5f + b) * up - 0.5f * t;
    } else if (i % 4 == 2) {
      normal = uniform_sphere(rng.uniform2());
      place = Vec3(0.0f, 0.2f, 0.0f) + 0.1f * normal;
    } else if (i % 32 == 3) {
      normal = -up;
    }
    const Vec3 from = glm::normalize(1.0001f * normal + uniform_sphere(rng.uniform2()));  // as the cosine
    all[i] = {place, PackedDirection(-from), Rgb(rng.uniform(), 1.0f, 1e3f * rng.uniform())};
  }
  return all;
}

/// What a query should find: none where other photons are as far as the k-th.
struct Twin {
  bool tied = false;
  NearestSums sums;
};
Twin brute_force(const std::vector<Photon>& photons, const Vec3& point, uint32_t count, float radius,
                 const Arrives& arrives) {
  std::vector<std::pair<float, const Photon*>> near;
  for (const Photon& p : photons) {
    const Vec3 offset = p.position - point;
    const float d2 = glm::dot(offset, offset);
    if (d2 < radius * radius && arrives(p.travel, offset)) near.emplace_back(d2, &p);
  }
  std::sort(near.begin(), near.end());
  Twin twin;
  const bool full = near.size() >= count;
  twin.sums.radius2 = full ? near[count - 1].first : radius * radius;
  for (const auto& [d2, p] : near) {
    if (d2 >= twin.sums.radius2) break;
    ++twin.sums.used;
    twin.sums.power += Rgbd(p->power);
    twin.sums.second += Rgbd(p->power) * double{d2};
  }
  twin.tied = full && twin.sums.used != count - 1;
  return twin;
}

/// Packed powers are off by 4e-6 of the largest channel.
void expect_near(const Rgbd& a, const Rgbd& b, const char* what) {
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(a[c], b[c], 2e-6 * std::abs(b[c]) + 4e-6 * std::max(b.r, std::max(b.g, b.b))) << what;
}

struct Map {
  explicit Map(const std::vector<Photon>& photons) : map(photons, 1.0f) { map.add_nodes(); }
  std::optional<NearestSums> sums(const Vec3& point, uint32_t count, float radius, const Arrives& arrives,
                                  NodeSearch& search, uint32_t& visited) const {
    return nearest_sums(NodeQuery<Arrives>{map.photons(), *map.nodes(), point, arrives, visited}, count, radius,
                        search);
  }
  NearestMap map;
};

/// Places at photons and off them, normals of all directions and of the tilted square.
void expect_twins(const std::vector<Photon>& photons, bool both_sides) {
  const Map map(photons);
  NodeSearch kept;  // between queries that have nothing to do with each other: the worst of guesses
  for (const uint32_t count : {2u, 600u, 2'500u, 30'000u})
    for (const float radius : {0.03f, 0.4f, 3.0f, kInfinity})
      for (uint64_t i = 0; i < 12; ++i) {
        SCOPED_TRACE(testing::Message() << count << " in " << radius << " m, query " << i);
        Rng rng(4, rng_stream(RngUse::test, 41), i);
        Vec3 point = photons[static_cast<size_t>(rng.uniform() * static_cast<float>(photons.size()))].position;
        if (i % 3 == 0) point += 0.1f * uniform_sphere(rng.uniform2());
        const Vec3 normal = i % 2 ? uniform_sphere(rng.uniform2()) : glm::normalize(Vec3(0.3f, 1.0f, -0.2f));
        const Arrives arrives{normal, i % 5 ? 0.0f : 0.02f, both_sides};
        const Twin twin = brute_force(photons, point, count, radius, arrives);
        uint32_t visited = 0;
        const std::optional<NearestSums> sums = map.sums(point, count, radius, arrives, kept, visited);
        ASSERT_EQ(sums.has_value(), !twin.tied);
        if (!sums) continue;
        EXPECT_EQ(sums->radius2, twin.sums.radius2);
        EXPECT_EQ(sums->used, twin.sums.used);
        expect_near(sums->power, twin.sums.power, "power");
        expect_near(sums->second, twin.sums.second, "second moment");
        NodeSearch fresh;
        const std::optional<NearestSums> again = map.sums(point, count, radius, arrives, fresh, visited);
        ASSERT_TRUE(again);
        EXPECT_EQ(again->power, sums->power);  // the last bit, too
        EXPECT_EQ(again->second, sums->second);
      }
}

TEST(NearestSums, EqualTheBruteForceTwin) {
  for (const bool both_sides : {false, true}) {
    for (const Layout layout : kLayouts) {
      SCOPED_TRACE(static_cast<int>(layout));
      expect_twins(photons(layout, 6'000), both_sides);
    }
    expect_twins(photons_of_surfaces(20'000), both_sides);
  }
}

TEST(NearestSums, OfFewPhotonsAndOfNone) {
  for (const size_t photons_there : {0u, 1u, 2u, 15u, 16u, 17u, 33u, 300u}) {
    const std::vector<Photon> some = photons(Layout::spread, photons_there);
    const Map map(some);
    const Arrives any{Vec3(0, 1, 0), 10.0f, true};
    for (const uint32_t count : {2u, 16u, 299u, 1'000u}) {
      NodeSearch search;
      uint32_t visited = 0;
      const Twin twin = brute_force(some, Vec3(0.5f), count, 2.0f, any);
      const std::optional<NearestSums> sums = map.sums(Vec3(0.5f), count, 2.0f, any, search, visited);
      ASSERT_TRUE(sums);
      EXPECT_EQ(sums->used, twin.sums.used);
      EXPECT_EQ(sums->radius2, twin.sums.radius2);
      expect_near(sums->power, twin.sums.power, "power");
    }
  }
}

// A cluster around the point, and nothing else far around: no guess of the radius is near it.
TEST(NearestSums, FindRadiiThatNoGuessIsNear) {
  std::vector<Photon> all;
  for (uint64_t i = 0; i < 4'000; ++i) {
    Rng rng(4, rng_stream(RngUse::test, 42), i);
    const float reach = i < 1'000 ? 1e-9f : i < 2'000 ? 1e-3f : 1e3f;
    const Vec2 u = rng.uniform2();
    all.push_back({reach * Vec3(u.x, 0.0f, u.y), PackedDirection(Vec3(0, -1, 0)), Rgb(1.0f)});
  }
  const Map map(all);
  const Arrives arrives{Vec3(0, 1, 0)};
  for (const uint32_t count : {2u, 999u, 1'000u, 1'001u, 2'000u, 2'001u, 3'999u, 4'000u, 4'001u})
    for (const float guess : {0.0f, 1e-12f, 1e-9f, 1e-3f, 1.0f, 1e6f}) {
      SCOPED_TRACE(testing::Message() << count << ", guessed " << guess);
      const Twin twin = brute_force(all, Vec3(0.0f), count, 1e4f, arrives);
      NodeSearch search{guess, {}};
      uint32_t visited = 0;
      const std::optional<NearestSums> sums = map.sums(Vec3(0.0f), count, 1e4f, arrives, search, visited);
      ASSERT_EQ(sums.has_value(), !twin.tied);
      if (!sums) continue;
      EXPECT_EQ(sums->radius2, twin.sums.radius2);
      EXPECT_EQ(sums->used, twin.sums.used);
    }
}

// Where no photon arrives from below.
TEST(NearestSums, LookAtTheRimAlone) {
  const Arrives arrives{glm::normalize(Vec3(0.3f, 1.0f, -0.2f))};
  std::vector<Photon> all = photons_of_surfaces(200'000);
  std::erase_if(all, [&](const Photon& p) { return glm::dot(p.travel.unpack(), arrives.normal) > 0.0f; });
  const Map map(all);
  NodeSearch search;
  uint32_t first = 0, next = 0;
  ASSERT_EQ(map.sums(Vec3(0.01f, 0.0f, 0.015f), 20'000, 1.0f, arrives, search, first)->used, 19'999u);
  ASSERT_EQ(map.sums(Vec3(0.011f, 0.0f, 0.0165f), 20'000, 1.0f, arrives, search, next)->used, 19'999u);
  EXPECT_LT(next, 12'000u);  // photon by photon the two steps look at more than 40,000
  EXPECT_LT(next, first);    // the first query has to find the radius
}

TEST(NearestSums, AreTheSameBitForBitOnAnyNumberOfThreads) {
  const std::vector<Photon> all = photons_of_surfaces(100'000);
  const auto sums = [&](int threads) {
    set_threads(threads);
    const Map map(all);
    NodeSearch search;
    uint32_t visited = 0;
    return *map.sums(Vec3(0.0f), 10'000, 1.0f, {glm::normalize(Vec3(0.3f, 1.0f, -0.2f))}, search, visited);
  };
  const NearestSums one = sums(1), three = sums(3);
  set_threads(0);
  EXPECT_EQ(one.power, three.power);
  EXPECT_EQ(one.second, three.second);
}

// Estimates on surfaces: by nodes on Lambertian ones, and bit for bit as ever where more than powers counts, for other
// kernels and for fewer photons.
TEST(NearestSums, AreWhatLambertianSurfacesReflect) {
  const std::vector<Photon> all = photons_of_surfaces(20'000);
  const Vec3 up = glm::normalize(Vec3(0.3f, 1.0f, -0.2f)), eye = glm::normalize(Vec3(0.2f, 0.8f, 0.5f));
  const Vec3 bent = glm::normalize(up + Vec3(0.2f, 0.0f, 0.1f));
  for (const KernelInfo& kernel : kKernels)
    for (const uint32_t count : {511u, 512u, 3'000u, 50'000u}) {
      SCOPED_TRACE(testing::Message() << kernel.name << ", " << count);
      const GatherSettings settings{GatherMode::nearest, 0.6f, count, kernel.kind};
      const PhotonMap plain = make_photon_map(all, settings, 7);
      PhotonMap prepared = plain;
      const bool by_nodes = kernel.kind == KernelKind::epanechnikov && count >= 512;
      EXPECT_EQ(prepared.prepare_sums_by_nodes() > 0, by_nodes);
      EXPECT_EQ(prepared.memory_bytes() > plain.memory_bytes(), by_nodes);
      for (const Material& material : {Material(Lambertian{Rgb(0.5f, 0.6f, 0.7f)}), Material(Phong{})})
        for (const Vec3& shading : {up, bent})
          for (const Vec3& at : {Vec3(0.0f), 0.4f * glm::cross(up, Vec3(1, 0, 0))}) {
            const Hit hit = hit_at(at, up, shading);
            const KernelEstimate a = scattered_radiance(material, hit, eye, prepared);
            const KernelEstimate b = scattered_radiance(material, hit, eye, plain);
            const KernelEstimate twin = scattered_radiance(material, hit, eye, all, settings, uint64_t{7});
            if (!by_nodes || shading == bent || diffuse_reflectance(material) == nullptr) {
              EXPECT_EQ(a.value, b.value);
              EXPECT_EQ(a.correction, b.correction);
            }
            for (int c = 0; c < 3; ++c) {
              EXPECT_NEAR(a.value[c], twin.value[c], 1e-5f * max_channel(twin.value)) << "channel " << c;
              EXPECT_NEAR(a.correction[c], twin.correction[c], 1e-5f * max_channel(twin.value)) << "channel " << c;
            }
          }
    }
}

TEST(NearestSums, LeaveEquallyFarPhotonsToThePlainSearch) {
  std::vector<Photon> all(2'000);  // at four distances
  for (size_t i = 0; i < all.size(); ++i)
    all[i] = {Vec3(0.1f * static_cast<float>(1 + i % 4), 0.0f, 0.0f), PackedDirection(Vec3(0, -1, 0)), Rgb(1.0f)};
  const Vec3 up(0, 1, 0);
  for (const uint32_t count : {600u, 1'000u, 1'001u, 1'500u, 2'000u, 2'001u}) {
    const GatherSettings settings{GatherMode::nearest, 1.0f, count};
    PhotonMap map = make_photon_map(all, settings, 1);
    map.prepare_sums_by_nodes();
    const KernelEstimate sum = surface_irradiance(Vec3(0.0f), up, map);
    const KernelEstimate twin = surface_irradiance(Vec3(0.0f), up, all, settings, uint64_t{1});
    EXPECT_NEAR(sum.value.g, twin.value.g, 1e-5f * twin.value.g) << count;
    EXPECT_NEAR(sum.correction.g, twin.correction.g, 1e-5f * twin.value.g) << count;
  }
}

}  // namespace
}  // namespace vpm
