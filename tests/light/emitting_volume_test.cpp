// Media as lights: their power, the places that are drawn, and the density of these along rays.
#include "vpm/light/emitting_volume.h"

#include <gtest/gtest.h>

#include "support/emission.h"
#include "support/statistics.h"
#include "vpm/base/error.h"
#include "vpm/base/warp.h"

namespace vpm {
namespace {

Rng test_rng(uint64_t number) { return Rng(3, rng_stream(RngUse::test, 0), number); }

EmittingVolume::Place draw(const EmittingVolume& volume, Rng& rng) {
  const double choice = rng.uniform_double(), x = rng.uniform_double();
  return volume.draw(choice, x, rng.uniform2());
}

/// S9e of ../oracles/README.md, without scattering.
TEST(EmittingVolume, HasThePowerOfTheIntegral) {
  Medium medium = emitting_grids(0.9f, 0.0f);
  EXPECT_NEAR(EmittingVolume(medium, {}).power().g / 37.73112090885143, 1.0, 1e-5);
  medium.emission->meaning = MediumEmission::Meaning::volume;
  EXPECT_NEAR(EmittingVolume(medium, {}).power().g / 76.28179661997716, 1.0, 1e-5);
}

/// A box without grids: 4 pi j V.
TEST(EmittingVolume, OfAnEvenMediumFillsTheBoxAround) {
  Medium medium = make_medium(nullptr, Rgb(2.0f), 0.25f);
  medium.emission = MediumEmission{.colour = Rgb(1.0f, 2.0f, 3.0f)};
  const EmittingVolume volume(medium, {Box{Vec3(1.0f), Vec3(3.0f, 4.0f, 5.0f)}});
  EXPECT_NEAR(volume.power().b, 4.0 * kPiD * 1.5 * 3.0 * 24.0, 1e-2);
  EXPECT_NEAR(volume.bound(), 4.0 * kPiD * 1.5 * 2.0 * 24.0, 1e-1);
  EXPECT_EQ(volume.bounds().lo, Vec3(1.0f));
  EXPECT_EQ(volume.bounds().hi, Vec3(3.0f, 4.0f, 5.0f));
}

/// Boxes far from each other: cells of their own, not one around all.
TEST(EmittingVolume, OfFarBoxesHasCellsInThem) {
  Medium medium = make_medium(nullptr, Rgb(2.0f), 0.25f);
  medium.emission = MediumEmission{.colour = Rgb(1.0f)};
  const std::vector<Box> boxes{{Vec3(0.0f), Vec3(0.02f, 0.1f, 0.02f)}, {Vec3(5.0f), Vec3(5.02f, 5.1f, 5.02f)}};
  const EmittingVolume volume(medium, boxes);
  const double within = 4.0 * kPiD * 1.5 * 2.0 * 0.02 * 0.1 * 0.02;
  EXPECT_GE(volume.power().g, 0.999 * within);
  EXPECT_LT(volume.power().g, 2.0 * within);
  Rng rng = test_rng(4);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 at = draw(volume, rng).position;
    EXPECT_TRUE(at.x < 0.03f || at.x > 4.99f) << at.x;
  }
}

/// What of a grid no shape holds is no cell.
TEST(EmittingVolume, OfAGridThatAShapeCropsHasItsCells) {
  const Medium medium = emitting_grids(0.9f, 0.0f);
  const double all = EmittingVolume(medium, {}).bound();
  const double cropped = EmittingVolume(medium, {Box{Vec3(0.0f, 1.2f, 2.0f), Vec3(0.2f, 1.4f, 2.2f)}}).bound();
  EXPECT_GT(cropped, 0.0);
  EXPECT_LT(cropped, 0.05 * all);
}

/// By volume it fills its shape, whatever the density.
TEST(EmittingVolume, ByVolumeFillsTheBoxAround) {
  Medium medium = emitting_grids(0.9f, 0.0f);
  medium.emission_grid = nullptr;
  medium.emission->meaning = MediumEmission::Meaning::volume;
  EXPECT_NEAR(EmittingVolume(medium, {Box{Vec3(-10.0f), Vec3(10.0f)}}).power().g, 4.0 * kPiD * 8000.0, 1.0);
}

TEST(EmittingVolume, ThatEmitsNothingIsRefused) {
  Medium medium = make_medium(nullptr, Rgb(2.0f), 1.0f);
  medium.emission = MediumEmission{.colour = Rgb(1.0f)};
  medium.name = "milk";
  EXPECT_THROW(EmittingVolume(medium, {Box{Vec3(0.0f), Vec3(1.0f)}}), InputError);
}

/// What survives where the bound is cut down to the emission lies where it is emitted.
TEST(EmittingVolume, DrawsPlacesWhereLightIsEmitted) {
  const Medium medium = emitting_grids(0.9f, 0.0f);
  const EmittingVolume volume(medium, {});
  Rng rng = test_rng(0);
  std::array<Moments, 3> index;
  for (int i = 0; i < 200'000; ++i) {
    const EmittingVolume::Place place = draw(volume, rng);
    const double emitted = emission_coefficient(medium, place.position).g;
    ASSERT_LE(emitted, place.bound);
    if (place.rest * place.bound >= emitted) continue;
    const Vec3d at = (Vec3d(place.position) - Vec3d(-0.75, 0.5, 1.25)) / 0.25;
    for (int a = 0; a < 3; ++a) index[a].add(at[a]);
  }
  const Vec3d expected(3.539728637522935, 3.4641282222938927, 3.4791430073749217);
  for (int a = 0; a < 3; ++a) expect_mean(index[a], expected[a], kFalseAlarms);
}

/// Temperatures on another, turned lattice: bounds hold for these, too.
TEST(EmittingVolume, BoundsHoldOnTwoLattices) {
  Medium medium = emitting_grids(0.9f, 0.0f);
  medium.emission_grid =
      turned_grid(5, [](int x, int y, int z) { return 1.0 / (1.0 + 0.05 * (x * x + y * y + z * z)); });
  medium.emission->blackbody = true;
  medium.emission->scale = 2200.0;
  const EmittingVolume volume(medium, {});
  Rng rng = test_rng(1);
  Moments survive;
  for (int i = 0; i < 50'000; ++i) {
    const EmittingVolume::Place place = draw(volume, rng);
    const Rgbd j = emission_coefficient(medium, place.position);
    ASSERT_LE((j.r + j.g + j.b) / 3.0, place.bound);
    survive.add((j.r + j.g + j.b) / 3.0 / place.bound);
  }
  EXPECT_GT(survive.mean(), 0.1);
  const Rgb power = volume.power();  // by points
  expect_mean(survive, (power.r + power.g + power.b) / 3.0 / volume.bound(), kFalseAlarms);
}

/// A grid far wider than what it holds has cells where it holds anything, as small as those of a small grid.
TEST(EmittingVolume, OfASparseGridHasSmallCells) {
  constexpr int kFar = 1 << 14;
  GridFrame frame = centered_frame(0, 0.1);
  frame.hi = Vec3i(kFar);
  Medium medium = make_medium(nullptr, Rgb(1.0f), 0.0f);
  medium.emission = MediumEmission{.meaning = MediumEmission::Meaning::volume, .colour = Rgb(1.0f)};
  const auto value = [](const Vec3i& p) {
    return glm::all(glm::lessThan(p, Vec3i(4))) || glm::all(glm::greaterThan(p, Vec3i(kFar - 4)));
  };
  medium.emission_grid = std::make_shared<const DensityGrid>(
      frame,
      [&](const Vec3i& origin, float* values) {
        for (int z = 0, n = 0; z < DensityGrid::kValues; ++z)
          for (int y = 0; y < DensityGrid::kValues; ++y)
            for (int x = 0; x < DensityGrid::kValues; ++x, ++n) {
              const Vec3i p = origin + Vec3i(x, y, z);
              const bool inside =
                  glm::all(glm::greaterThanEqual(p, frame.lo)) && glm::all(glm::lessThanEqual(p, frame.hi));
              values[n] = inside && value(p) ? 1.0f : 0.0f;
            }
        return DensityGrid::Filled::all;
      },
      std::vector<IndexBox>{{Vec3i(0), Vec3i(3)}, {Vec3i(kFar - 3), Vec3i(kFar)}});
  const EmittingVolume volume(medium, {});
  EXPECT_NEAR(volume.power().g / (4.0 * kPiD * 128.0 * 1e-3), 1.0, 1e-3);
  EXPECT_LT(volume.bound(), 8.0 * 4.0 * kPiD * 128.0 * 1e-3);
}

/// From within and from without: uniform directions see it with the density that integrates to 1, and drawn ones with
/// that whose mean inverse is the solid angle of all that it can be seen in.
TEST(EmittingVolume, DirectionDensityIsThatOfDrawnDirections) {
  const Medium medium = emitting_grids(0.9f, 0.0f);
  const EmittingVolume volume(medium, {});
  for (const Vec3& point : {Vec3(0.1f, 1.4f, 2.1f), Vec3(-1.7f, 0.2f, 3.4f)}) {
    Rng rng = test_rng(2);
    Moments uniform, inverse;
    for (int i = 0; i < 200'000; ++i) {
      uniform.add(4.0 * kPiD * volume.direction_density({point, uniform_sphere(rng.uniform2())}));
      const Vec3 towards = glm::normalize(draw(volume, rng).position - point);
      const double density = volume.direction_density({point, towards});
      ASSERT_GT(density, 0.0);
      inverse.add(1.0 / density);
    }
    expect_mean(uniform, 1.0, kFalseAlarms);
    if (point.y == 1.4f) expect_mean(inverse, 4.0 * kPiD, kFalseAlarms);
  }
}

}  // namespace
}  // namespace vpm
