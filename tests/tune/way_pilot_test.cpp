// The pilot of a way to render: what its small passes say of whole ones.
#include "vpm/tune/way_pilot.h"

#include <gtest/gtest.h>

#include <array>

#include "tune/pilot_scenes.h"
#include "tune/ticking_clock.h"
#include "vpm/integrators/default_radii.h"
#include "vpm/integrators/photon_map/photon_pass.h"
#include "vpm/integrators/words.h"
#include "vpm/render/render.h"

namespace vpm {
namespace {

const AutomaticSettings kNothing;
const TickingClock kClock(1e-3);

WayPilot pilot_of(const Scene& scene, const RenderSettings& settings, int passes) {
  WayPilot pilot(scene, kNothing, kClock, {"", settings});
  pilot.find_size(1.0);
  pilot.add_passes(passes, pilot.usual());
  return pilot;
}

/// A pilot's noise is that of passes, as the film has it, both of no scale. The lamp has a size, as the variance of
/// paths has no bound beside a point of light.
class TheNoiseOfAPass : public testing::TestWithParam<Integrator> {};
TEST_P(TheNoiseOfAPass, IsThatOfTheFilm) {
  const QuadLight lamp{Vec3(-0.2f, 0.9f, -0.2f), Vec3(0.4f, 0.0f, 0.0f), Vec3(0.0f, 0.0f, 0.4f)};
  const RenderJob job = make_job(foggy_room(0.5f, lamp));
  RenderSettings settings;
  settings.integrator = GetParam();
  settings.photons.sequence = PhotonSequence::random;  // noise as one over photons is what pilots take for granted
  settings.volume.choose("beam");
  settings.volume.radius = 0.1f;
  settings.surface.radius = 0.2f;
  settings.photons.emitted = 4'000;
  settings.radii = RadiusSchedule::constant;
  settings.until.passes = GetParam() == Integrator::path ? 64 : 16;
  const Film film = render(job.scene, settings, nothing_rendered(job.scene.camera)).film;
  double variance = 0.0;  // of a pass, the mean of pixels and channels
  for (const Rgb& pixel : film.variance_of_mean().pixels)
    variance += settings.until.passes * double{mean_channel(pixel)} / (128.0 * 128.0);
  const PassModel model = pilot_of(job.scene, settings, 12).model(Scales(kSquares, Rgbd(1.0)));
  const double noise = model.error(1, 4'000, 1.0, settings) - model.bias2;
  EXPECT_NEAR(noise / variance, 1.0, 0.4);
  EXPECT_LT(model.bias2, noise);
}
INSTANTIATE_TEST_SUITE_P(Pilot, TheNoiseOfAPass,
                         testing::Values(Integrator::photon, Integrator::path, Integrator::combined),
                         [](const auto& of) {
                           std::string name = word_of(of.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

/// A pilot's squared bias is that of whole pictures: the product of the corrections of passes that have no photons in
/// common. Its blocks are all of this picture.
TEST(Pilot, SeesTheBiasThatPicturesShow) {
  constexpr int kEdge = 40;
  AssembledScene room = foggy_room(0.5f);
  room.scene.camera.width = room.scene.camera.height = kEdge;
  RenderSettings settings;
  settings.volume.choose("beam");
  settings.volume.radius = settings.surface.radius = 0.25f;
  settings.photons.emitted = 20'000;
  settings.radii = RadiusSchedule::constant;
  constexpr int kPasses = 40;
  std::array<Image, 2> corrections{Image(kEdge, kEdge), Image(kEdge, kEdge)};
  for (int pass = 0; pass < kPasses; ++pass) {
    const Image found = render_photon_pass(room.scene, settings, pass).correction;
    Image& sum = corrections[static_cast<size_t>(pass % 2)];
    for (size_t i = 0; i < found.pixels.size(); ++i) sum.pixels[i] += found.pixels[i] / float(kPasses / 2);
  }
  double bias2 = 0.0;
  for (size_t i = 0; i < corrections[0].pixels.size(); ++i)
    bias2 += double{mean_channel(corrections[0].pixels[i] * corrections[1].pixels[i])} / double{kEdge * kEdge};
  const PassModel model = pilot_of(room.scene, settings, 20).model(Scales(kSquares, Rgbd(1.0)));
  EXPECT_NEAR(model.bias2 / bias2, 1.0, 0.3);
}

/// What light tracing brings to pixels is part of what a pilot sees there: it alone shows what connections show.
TEST(Pilot, SeesWhatLightTracingFinds) {
  const Scene scene = cloud_over_floor(false);
  const auto mean_seen_by = [&](Technique technique) {
    RenderSettings settings;
    settings.integrator = Integrator::combined;
    settings.volume.radius = settings.surface.radius = 0.1f;
    settings.photons.emitted = 50'000;
    for (const TechniqueInfo& info : kTechniques)
      settings.combined.techniques.set(info.technique, info.technique == technique);
    double sum = 0.0;
    for (const Rgbd& light : surely_shown(pilot_of(scene, settings, 4).squares())) sum += light.g;
    return sum;
  };
  EXPECT_NEAR(mean_seen_by(Technique::light_tracing) / mean_seen_by(Technique::connections), 1.0, 0.05);
}

TEST(Pilot, PathsMissWhatPhotonsShow) {
  const Scene scene = lamp_in_glass();
  RenderSettings photons;
  photons.surface.radius = 0.1f;
  RenderSettings paths;
  paths.integrator = Integrator::path;
  const WayPilot maps = pilot_of(scene, photons, 4), blind = pilot_of(scene, paths, 4);
  EXPECT_GT(unseen_by(blind.light(), maps.light()), 0.1);
  EXPECT_EQ(unseen_by(maps.light(), blind.light()), 0.0);
}

/// Each sees all of an evenly lit floor.
TEST(Pilot, NothingIsMissingWhereBothSeeTheSame) {
  const AssembledScene room = foggy_room(0.5f);
  RenderSettings photons, paths;
  photons.volume.choose("beam");
  photons.volume.radius = photons.surface.radius = 0.05f;
  paths.integrator = Integrator::path;
  const WayPilot maps = pilot_of(room.scene, photons, 6), traced = pilot_of(room.scene, paths, 6);
  EXPECT_EQ(unseen_by(traced.light(), maps.light()), 0.0);
}

/// Photons that take as long as rays do, by the clock, whose passes and rays take one tick each.
TEST(Pilot, PhotonsTakeAsLongAsRaysDo) {
  const AssembledScene room = foggy_room(0.5f);
  const AutomaticSettings automatic{{"integrator.photons.emitted"}};
  WayPilot pilot(room.scene, automatic, kClock, {"", {}});
  pilot.find_size(1e-9);
  // 1000 photons in a tick, and 25 blocks of 64 rays, of which the picture has 128 x 128: 10,240 photons.
  EXPECT_EQ(pilot.way().settings.photons.emitted, 10'000u);
  EXPECT_TRUE(pilot.chooses_photons());
}

TEST(Pilot, RadiiAreScaledUpToATwentiethOfTheScene) {
  const AssembledScene room = foggy_room(0.5f);
  const AutomaticSettings automatic{{"integrator.volume.radius", "integrator.surface.radius"}};
  WayPilot pilot(room.scene, automatic, kClock, {"", {}});
  pilot.find_size(1.0);
  ASSERT_EQ(pilot.radii().size(), 2u);
  RenderSettings settings = pilot.way().settings;
  const float before = settings.surface.radius.metres();
  scale_radii(pilot.radii(), 0.5, settings);
  EXPECT_NEAR(settings.surface.radius.metres(), 0.5f * before, 5e-3f * before);
  const double most = 0.05 * room.scene.bounds.diagonal();
  EXPECT_NEAR(pilot.widest() * std::max(before, pilot.way().settings.volume.radius.metres()), most, 1e-3);
}

}  // namespace
}  // namespace vpm
