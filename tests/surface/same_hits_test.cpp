// Hits have the same bits on any processor with AVX2 and FMA, whichever code Embree chooses for it. A million rays.
#include <gtest/gtest.h>

#include "surface/random_shapes.h"
#include "vpm/base/fnv.h"
#include "vpm/surface/geometry.h"
#include "vpm/surface/mesh.h"
#include "vpm/surface/procedural_mesh.h"

namespace vpm {
namespace {

/// The fingerprint of where rays from within a cube of 2 m meet what it holds, from whichever side.
std::string fingerprint_of_hits(Geometry& geometry, Rng& rng) {
  geometry.commit();
  Fnv1a hash;
  for (int i = 0; i < 340000; ++i) {
    const Ray ray{in_cube(rng), uniform_sphere(rng.uniform2())};
    const std::optional<Hit> hit = geometry.intersect(ray);
    if (!hit) continue;
    const auto add = [&](const auto& value) { hash.add({reinterpret_cast<const char*>(&value), sizeof value}); };
    add(hit->t);
    add(hit->shape);
    add(hit->triangle);
    add(hit->position);
    add(hit->normal);
    add(hit->barycentric);
  }
  return hash.digits();
}

class SameHits : public testing::Test {
 protected:
  void SetUp() override {
    // Without these the C library computes the sine of a direction otherwise.
    if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) GTEST_SKIP() << "no AVX2 or no FMA here";
  }
};

TEST_F(SameHits, OfSpheresAndDiscs) {
  Rng rng(1, rng_stream(RngUse::test, 50), 0);
  Geometry geometry;
  for (int i = 0; i < 40; ++i) geometry.add(SphereShape{in_cube(rng), 0.02f + 0.3f * rng.uniform()});
  for (int i = 0; i < 40; ++i) geometry.add(DiscShape{in_cube(rng), uniform_sphere(rng.uniform2()), rng.uniform()});
  EXPECT_EQ(fingerprint_of_hits(geometry, rng), "37d6b835f841e79d");
}

// Boxes that touch: their faces coincide.
TEST_F(SameHits, OfQuadsAndBoxes) {
  Rng rng(1, rng_stream(RngUse::test, 51), 0);
  Geometry geometry;
  for (int i = 0; i < 40; ++i) geometry.add(quad_mesh(Vec3d(in_cube(rng)), Vec3d(in_cube(rng)), Vec3d(in_cube(rng))));
  for (int i = 0; i < 10; ++i)
    geometry.add(box_mesh(Vec3d(0.1 * i - 0.5, -0.3, -0.2), Vec3d(0.1 * i - 0.4, 0.3, 0.25)));
  EXPECT_EQ(fingerprint_of_hits(geometry, rng), "57e21c150e6fe547");
}

TEST_F(SameHits, OfMeshes) {
  Rng rng(1, rng_stream(RngUse::test, 52), 0);
  Geometry geometry;
  geometry.add(find_procedural_mesh("waves")->make(64));
  geometry.add(find_procedural_mesh("ring")->make(96));
  EXPECT_EQ(fingerprint_of_hits(geometry, rng), "9f013b8c08bf56e9");
}

}  // namespace
}  // namespace vpm
