// Radii and numbers of photons that a pilot changes.
#include "vpm/tune/scale_records.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/scenes.h"
#include "vpm/tune/choice_rules.h"
#include "vpm/tune/pass_cost.h"

namespace vpm {
namespace {

/// A box of fog with a lamp beside it, seen from outside, in pixels that are smaller than kernels.
Scene fog_with_lamp() {
  Scene scene = boxed_medium(make_medium(nullptr, Rgb(1.0f), 0.9f), PointLight{Vec3(0.5f, 1.5f, 0.5f), Rgb(9.0f)});
  scene.camera = make_camera(Vec3(0, 0.5f, 4), Vec3(0.0f), Vec3(0, 1, 0), 30.0f, {160, 160});
  return scene;
}

RenderSettings settings_with(float radius) {
  RenderSettings settings;
  settings.photons.emitted = 5'000;
  settings.volume.choose("beam");
  settings.volume.radius = radius;
  return settings;
}

std::vector<Choice> choices_of(const RenderSettings& settings) {
  return {{"integrator.photons.emitted", fmt::format("{}", settings.photons.emitted), "by cost"},
          {"integrator.volume.radius", fmt::format("{}", settings.volume.radius.metres()), "by photons"},
          {"integrator.caustics.emitted", "7", "given"}};
}

std::vector<Choice> scaled(const Scene& scene, RenderSettings& settings) {
  std::vector<Choice> choices = choices_of(settings);
  scale_records(scene, 0.4, settings, choices);
  return choices;
}

TEST(ScaleRecords, WidensWhereNoiseIsAllAndNotBeyondATwentiethOfTheScene) {
  const Scene scene = fog_with_lamp();
  const double largest = kLargestRadius * scene.bounds.diagonal();
  const auto narrow = static_cast<float>(largest / 20.0);
  RenderSettings settings = settings_with(narrow);
  const std::vector<Choice> choices = scaled(scene, settings);
  EXPECT_FLOAT_EQ(settings.volume.radius.metres(), rounded_radius(2.0 * narrow));
  EXPECT_EQ(choices[1].value, fmt::format("{}", settings.volume.radius.metres()));
  EXPECT_EQ(choices[1].reason,
            fmt::format("{}: by photons; then times 2, which is expected to leave less error", narrow));
  EXPECT_EQ(choices[0].value, "5000");  // as passes are counted
  EXPECT_EQ(choices[2].value, "7");
  RenderSettings wide = settings_with(static_cast<float>(0.9 * largest));
  scaled(scene, wide);
  EXPECT_LE(wide.volume.radius.metres(), static_cast<float>(largest));
}

TEST(ScaleRecords, NarrowsWhereManyPassesLeaveLittleNoise) {
  const Scene scene = fog_with_lamp();
  const auto radius = static_cast<float>(kLargestRadius * scene.bounds.diagonal());
  RenderSettings few = settings_with(radius), many = settings_with(radius);
  few.radii = many.radii = RadiusSchedule::constant;
  few.until.passes = 1;
  many.until.passes = 10'000;
  few.photons.emitted = many.photons.emitted = 100'000;
  scaled(scene, few);
  scaled(scene, many);
  EXPECT_EQ(few.volume.radius.metres(), radius);
  EXPECT_FLOAT_EQ(many.volume.radius.metres(), rounded_radius(0.5 * radius));
}

/// What is told of the bias at four times the radius is what passes with that radius show, times 2.5 for edges; and it
/// falls from there as the power 2.5.
TEST(ScaleRecords, TellBiasByTheWideRadius) {
  const Scene scene = fog_with_lamp();
  const double narrow = kLargestRadius * scene.bounds.diagonal() / 5.0;
  const auto settings_of = [&](double radius) {
    RenderSettings settings = settings_with(static_cast<float>(radius));
    settings.radii = RadiusSchedule::constant;
    settings.photons.emitted = 20'000;
    return settings;
  };
  const RenderSettings settings = settings_of(narrow), wide = settings_of(4.0 * narrow);
  const double shown = error_of_pass(scene, wide, time_pass(scene, wide), 1.0).pass.bias2;
  EXPECT_GT(shown, 0.0);
  const ScaledPasses told(scene, 1.0, settings, choices_of(settings));
  const auto bias = [&](double factor) { return told.error_after_passes(1e7, {.radius = factor}); };
  EXPECT_NEAR(bias(4.0) / (2.5 * shown), 1.0, 0.4);
  EXPECT_NEAR(bias(1.0) / bias(4.0), std::pow(4.0, -2.5), 0.005);
}

/// A floor below, of whose light there are too few photons: their noise is none of the fog's, and wider radii of that
/// lessen nothing.
TEST(ScaleRecords, StaysWhereTheNoiseIsThatOfSurfaces) {
  Scene scene;
  scene.media.push_back(make_medium(nullptr, Rgb(1e-4f), 0.9f));
  const Interface inside{0, kVacuum};
  add_shape(scene, box_mesh(Vec3d(-1.0), Vec3d(1.0)), Lambertian{Rgb(0.7f)}, &inside);
  scene.lights.push_back(PointLight{Vec3(0.0f, 0.9f, 0.0f), Rgb(1.0f)});
  scene.camera = make_camera(Vec3(0, 0, 0.9f), Vec3(0.0f), Vec3(0, 1, 0), 60.0f, {24, 24});
  scene.geometry.commit();
  finish(scene);
  RenderSettings settings = settings_with(static_cast<float>(kLargestRadius * scene.bounds.diagonal() / 20.0));
  settings.surface.radius = 0.03f;
  const float before = settings.volume.radius.metres();
  scaled(scene, settings);
  EXPECT_EQ(settings.volume.radius.metres(), before);
}

/// Nothing of a photon's noise is left to lessen where light comes straight from the lamp, so that fewer photons leave
/// time for more rays; and where photons are all there is, a render that may last has more of them.
TEST(ScaleRecords, PhotonsAreFewWhereTheyMakeNoNoiseAndManyWhereTheyMakeAll) {
  const Scene scene = fog_with_lamp();
  RenderSettings few = settings_with(0.3f), many = settings_with(0.3f);
  few.until.error = many.until.error = 1e-9;
  few.photons.emitted = 3'000'000;
  many.photons.emitted = 200;
  EXPECT_EQ(scaled(scene, few)[0].reason, "3000000: by cost; then times 0.5, which is expected to leave less error");
  EXPECT_EQ(few.photons.emitted, 1'500'000u);
  EXPECT_EQ(scaled(scene, many)[0].reason, "200: by cost; then times 2, which is expected to leave less error");
  EXPECT_EQ(many.photons.emitted, 400u);
}

/// A wide radius that makes a pass longer than the time is none.
TEST(ScaleRecords, StaysWhereAWiderPassWouldNotFit) {
  const Scene scene = fog_with_lamp();
  RenderSettings settings = settings_with(static_cast<float>(kLargestRadius * scene.bounds.diagonal() / 20.0));
  const float before = settings.volume.radius.metres();
  settings.samples_per_pixel = 1'000'000;
  settings.until.seconds = 0.01;
  scaled(scene, settings);
  EXPECT_EQ(settings.volume.radius.metres(), before);
}

TEST(ScaleRecords, LeavesAGivenRadius) {
  const Scene scene = fog_with_lamp();
  RenderSettings settings = settings_with(0.01f);
  std::vector<Choice> choices{{"integrator.photons.emitted", "5000", "few"}};
  scale_records(scene, 0.05, settings, choices);
  EXPECT_EQ(settings.volume.radius.metres(), 0.01f);
  EXPECT_EQ(choices[0].value, "5000");
}

}  // namespace
}  // namespace vpm
