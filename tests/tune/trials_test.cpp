// Ways to render that a pilot tries: what it tells of each, and which it chooses.
#include "vpm/tune/trials.h"
#include "vpm/integrators/words.h"

#include <gtest/gtest.h>

#include "support/simulated_clock.h"
#include "tune/pilot_scenes.h"
#include "vpm/integrators/describe.h"
#include "vpm/integrators/integrator.h"
#include "vpm/render/render.h"
#include "vpm/tune/automatic.h"
#include "vpm/tune/pilot_error.h"

namespace vpm {
namespace {

/// A pilot's error is that of passes, as the film tells it, whether it has time or renders a ray of each block among a
/// twentieth of the photons: the film's own scale is that of pixels, so that the two differ. Pixels of a few paths are
/// too noisy for a scale; and the lamp has a size, as the variance of paths has no bound beside a point of light.
class TheErrorOfAPass : public testing::TestWithParam<Integrator> {};
TEST_P(TheErrorOfAPass, IsThatOfTheFilm) {
  const QuadLight lamp{Vec3(-0.2f, 0.9f, -0.2f), Vec3(0.4f, 0.0f, 0.0f), Vec3(0.0f, 0.0f, 0.4f)};
  const RenderJob job = make_job(foggy_room(0.5f, lamp));
  RenderSettings settings;
  settings.integrator = GetParam();
  settings.photons.sequence = PhotonSequence::random;  // noise as one over photons is what pilots take for granted
  settings.volume.choose("beam");
  settings.volume.radius = 0.1f;
  settings.surface.radius = 0.2f;
  settings.photons.emitted = GetParam() == Integrator::combined ? 4'000 : 20'000;
  settings.radii = RadiusSchedule::constant;
  settings.until.passes = GetParam() == Integrator::path ? 64 : 8;
  const FilmErrors film = render(job.scene, settings, nothing_rendered(job.scene.camera)).errors.value();
  const PassCost cost = time_pass(job.scene, settings);
  for (const double seconds : {double{kInfinity}, 0.0}) {
    if (GetParam() == Integrator::path && seconds == 0.0) continue;  // a few hundred rays tell little of paths
    const PassError error = error_of_pass(job.scene, settings, cost, seconds).pass;
    const double variance = error.rays + error.photons;
    EXPECT_NEAR(variance / (settings.until.passes * film.variance_part.value), 1.0, 0.4) << seconds;
    EXPECT_LT(error.bias2, variance);
  }
}
INSTANTIATE_TEST_SUITE_P(Automatic, TheErrorOfAPass,
                         testing::Values(Integrator::photon, Integrator::path, Integrator::combined),
                         [](const auto& of) {
                           std::string name = word_of(of.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

/// What light tracing brings to pixels is part of what a pilot sees there: it alone shows what connections show.
TEST(Automatic, PilotsSeeWhatLightTracingFinds) {
  const Scene scene = cloud_over_floor(false);
  const auto mean_seen_by = [&](Technique technique) {
    RenderSettings settings;
    settings.integrator = Integrator::combined;
    settings.photons.emitted = 50'000;
    settings.volume.radius = settings.surface.radius = 0.1f;
    for (const TechniqueInfo& info : kTechniques)
      settings.combined.techniques.set(info.technique, info.technique == technique);
    double sum = 0.0;
    for (const std::vector<Rgb>& pass : error_of_pass(scene, settings, time_pass(scene, settings), kInfinity).shown)
      for (const Rgb& light : pass) sum += double{mean_channel(light)};
    return sum;
  };
  EXPECT_NEAR(mean_seen_by(Technique::light_tracing) / mean_seen_by(Technique::connections), 1.0, 0.05);
}

/// A hundredth of the light sub-paths, with the shares of all, finds as much by light tracing as all do; with shares of
/// its own it leaves most to connections. The sum over the picture is off by 3 % or so.
TEST(Automatic, APartOfAPassHasTheSharesOfTheWhole) {
  const Scene scene = cloud_over_floor(false);
  constexpr uint64_t kAll = 200'000, kPart = 2'000;
  RenderSettings settings;
  settings.integrator = Integrator::combined;
  for (const TechniqueInfo& info : kTechniques)
    settings.combined.techniques.set(
        info.technique, info.technique == Technique::light_tracing || info.technique == Technique::connections);
  const auto traced = [&](uint64_t paths, uint64_t paths_of_shares) {
    settings.photons.emitted = paths;
    double sum = 0.0;
    for (const Rgb& light : rays_of_pass(scene, settings, 0, paths_of_shares).light_tracing.pixels)
      sum += double{mean_channel(light)};
    return sum;
  };
  const double all = traced(kAll, 0);
  EXPECT_NEAR(traced(kPart, kAll) / all, 1.0, 0.15);
  EXPECT_LT(traced(kPart, 0) / all, 0.7);
}

/// The integrator that is chosen, with its reason.
Choice chosen_integrator(const Scene& scene, RenderSettings settings) {
  settings.photons.emitted = 5'000;
  const AutomaticSettings automatic{{"integrator.type", "integrator.volume.radius", "integrator.surface.radius"}};
  const std::vector<Choice> choices =
      choose_settings(scene, automatic, {SimulatedClock(), kInfinity}, settings).choices;
  EXPECT_EQ(choices.at(0).key, "integrator.type");
  EXPECT_EQ(choices.at(0).value, word_of(settings.integrator));
  for (const char* part : {"least error in a pilot", "photon-map ", " path "})
    EXPECT_NE(choices.at(0).reason.find(part), std::string::npos) << choices.at(0).reason;
  return choices.at(0);
}

/// A grey floor under an even sky: shadow rays find all light at once.
TEST(Automatic, PathsAreChosenUnderAnEvenSky) {
  Scene scene;
  add_shape(scene, quad_mesh(Vec3d(-1.0, 0.0, 1.0), Vec3d(2.0, 0.0, 0.0), Vec3d(0.0, 0.0, -2.0)),
            Lambertian{Rgb(0.5f)});
  scene.lights.push_back(ConstantEnvironment{Rgb(1.0f)});
  scene.camera = make_camera(Vec3(0.0f, 3.0f, 0.0f), Vec3(0.0f), Vec3(0.0f, 0.0f, -1.0f), 40.0f, {64, 64});
  scene.geometry.commit();
  finish(scene);
  const Choice choice = chosen_integrator(scene, {});
  EXPECT_EQ(choice.value, "path") << choice.reason;
}

/// What lights the floor came through a ball of glass, which shadow rays do not pass: paths are black, and do not pass
/// for quiet ones.
TEST(Automatic, PathsAreNotChosenWhereTheyDoNotFindTheLight) {
  Scene scene;
  add_shape(scene, quad_mesh(Vec3d(-1.0, 0.0, 1.0), Vec3d(2.0, 0.0, 0.0), Vec3d(0.0, 0.0, -2.0)),
            Lambertian{Rgb(0.5f)});
  add_shape(scene, SphereShape{Vec3(0.0f, 1.0f, 0.0f), 0.5f}, Dielectric{1.5f});
  scene.lights.push_back(PointLight{Vec3(0.0f, 1.0f, 0.0f), Rgb(1.0f)});
  scene.camera = make_camera(Vec3(0.0f, 0.4f, 3.0f), Vec3(0.0f), Vec3(0.0f, 1.0f, 0.0f), 40.0f, {64, 64});
  scene.geometry.commit();
  finish(scene);
  const Choice choice = chosen_integrator(scene, {});
  EXPECT_NE(choice.value, "path") << choice.reason;
}

/// Techniques may be chosen alone, and are where the integrator is.
TEST(Automatic, TechniquesAreChosen) {
  const Scene scene = foggy_room(0.5f).scene;
  RenderSettings settings;
  settings.integrator = Integrator::combined;
  settings.photons.emitted = 2'000;
  settings.volume.radius = settings.surface.radius = 0.1f;
  const std::vector<Choice> choices =
      choose_settings(scene, {{"integrator.techniques"}}, {SimulatedClock(), kInfinity}, settings).choices;
  ASSERT_EQ(choices.size(), 1u);
  EXPECT_EQ(choices[0].key, "integrator.techniques");
  for (const char* part : {"least error in a pilot", " combined without short-beams ", " combined "})
    EXPECT_NE(choices[0].reason.find(part), std::string::npos) << choices[0].reason;
  RenderSettings again = settings;
  again.combined.techniques = {};
  set_chosen(again, choices[0].key, choices[0].value);
  EXPECT_EQ(settings_line(again), settings_line(settings));
}

/// A pass of so many photons takes far longer than the time asked for, whatever it is worth; one of paths does not.
TEST(Automatic, WhatDoesNotFitIntoTheTimeIsNotChosen) {
  RenderSettings settings;
  settings.photons.emitted = 100'000'000;
  settings.volume.radius = settings.surface.radius = 0.1f;
  settings.until.seconds = 0.5;
  choose_settings(foggy_room(0.5f).scene, {{"integrator.type"}}, {SimulatedClock(), kInfinity}, settings);
  EXPECT_EQ(settings.integrator, Integrator::path);
}

TEST(Automatic, IntegratorsThatTheSettingsRefuseAreNotTried) {
  RenderSettings of_pixels;
  of_pixels.radii = RadiusSchedule::per_pixel;  // of photon maps alone
  const Choice choice = chosen_integrator(cloud_over_floor(true), of_pixels);
  EXPECT_NE(choice.reason.find("not combined: "), std::string::npos) << choice.reason;
}

/// What is chosen for integrator.volume.type, with its reason, and a radius for it; photons are given.
Choice chosen_gather(const Scene& scene, RenderSettings settings) {
  settings.photons.emitted = 20'000;
  settings.surface.radius = 0.1f;
  const std::vector<Choice> choices = choose_settings(scene, {{"integrator.volume.type", "integrator.volume.radius"}},
                                                      {SimulatedClock(), kInfinity}, settings)
                                          .choices;
  EXPECT_EQ(choices.size(), 2u);
  EXPECT_EQ(choices.at(0).key, "integrator.volume.type");
  EXPECT_EQ(choices.at(0).value, settings.volume.type());
  EXPECT_EQ(choices.at(1).key, "integrator.volume.radius");
  return choices.at(0);
}

/// In thin air few photons collide, but all fly.
TEST(Automatic, BeamsAreGatheredWhereFewPhotonsCollide) {
  const Choice choice = chosen_gather(lit_evenly(0.01f), {});
  EXPECT_EQ(choice.value, "photon-beams") << choice.reason;
  for (const char* part : {"least error in a pilot", " beam ", " photon-beams "})
    EXPECT_NE(choice.reason.find(part), std::string::npos) << choice.reason;
}

/// In a dense medium photons collide often, and a flight says little more than the collision at its end.
TEST(Automatic, PointsAreGatheredWherePhotonsCollideOften) {
  RenderSettings settings;
  settings.photons.sequence = PhotonSequence::random;  // which is as noisy for both
  const Choice choice = chosen_gather(foggy_room(5.0f).scene, settings);
  EXPECT_EQ(choice.value, "beam") << choice.reason;
}

TEST(Automatic, GathersThatTheSettingsRefuseAreNotTried) {
  const Scene thin = lit_evenly(0.01f);
  RenderSettings merged;
  merged.photons.in_cube = 10;
  RenderSettings biased;
  biased.distance.strategy = "mean-extinction";
  for (const RenderSettings& settings : {merged, biased}) {
    const Choice choice = chosen_gather(thin, settings);
    EXPECT_EQ(choice.value, "beam");
    EXPECT_NE(choice.reason.find("not photon-beams: "), std::string::npos) << choice.reason;
  }
  RenderSettings ball_by_ball;
  ball_by_ball.volume.boundary = BoundaryRule::corrected;
  EXPECT_EQ(chosen_gather(thin, ball_by_ball).value, "radius");
}

}  // namespace
}  // namespace vpm
