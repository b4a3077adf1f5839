// Density control: what stays, and that no power is lost.
#include "vpm/photon/density_control.h"

#include <gtest/gtest.h>

#include "vpm/base/rng.h"
#include "vpm/base/warp.h"

namespace vpm {
namespace {

/// Photons in a cube of 1 m, twice as dense in its lower half, in three colours.
std::vector<Photon> some_photons(int count) {
  std::vector<Photon> photons;
  Rng rng(1, 2, 3);
  for (int i = 0; i < count; ++i) {
    Vec3 p(rng.uniform(), rng.uniform(), rng.uniform());
    if (i % 3 == 0) p.y *= 0.5f;
    Rgb power(0.0f);
    power[i % 3] = 1.0f + rng.uniform();
    photons.push_back({p, PackedDirection(uniform_sphere(rng.uniform2())), power});
  }
  return photons;
}

struct Group {
  int count = 0;
  Rgbd power{0.0};
};
/// By cube of half a metre and octant.
std::vector<Group> groups_of(const std::vector<Photon>& photons) {
  std::vector<Group> groups(64);
  for (const Photon& photon : photons) {
    const Vec3 d = photon.travel.unpack();
    const auto half = [](float x) { return x < 0.5f ? 0 : 1; };
    const int cube = (half(photon.position.x) * 2 + half(photon.position.y)) * 2 + half(photon.position.z);
    const int octant = ((d.x < 0.0f) * 2 + (d.y < 0.0f)) * 2 + (d.z < 0.0f);
    Group& group = groups[static_cast<size_t>(cube * 8 + octant)];
    ++group.count;
    group.power += Rgbd(photon.power);
  }
  return groups;
}

TEST(DensityControl, KeepsThePowerOfEveryCubeAndOctant) {
  std::vector<Photon> photons = some_photons(6400);
  const std::vector<Group> before = groups_of(photons);
  const uint64_t gone = control_density(photons, 0.5f, 20);
  EXPECT_EQ(gone, 6400u - photons.size());
  const std::vector<Group> after = groups_of(photons);
  for (size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(after[i].count, std::min(before[i].count, 20));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(after[i].power[c], before[i].power[c], 1e-5 * before[i].power[c]);
  }
}

TEST(DensityControl, LeavesThinPlacesAsTheyAre) {
  std::vector<Photon> photons = some_photons(640);
  const std::vector<Photon> before = photons;
  EXPECT_EQ(control_density(photons, 0.5f, 1000), 0u);
  ASSERT_EQ(photons.size(), before.size());
  for (size_t i = 0; i < photons.size(); ++i) EXPECT_EQ(photons[i].power, before[i].power);
}

TEST(DensityControl, TakesPlacesFarFromTheOrigin) {
  std::vector<Photon> photons(3, {Vec3(-4e8f, 7e8f, 0.0f), PackedDirection(Vec3(0.0f, 0.0f, 1.0f)), Rgb(1.0f)});
  EXPECT_EQ(control_density(photons, 1e-3f, 1), 2u);
  EXPECT_EQ(photons[0].power, Rgb(3.0f));
}

}  // namespace
}  // namespace vpm
