// Which way to render a race ends with.
#include "vpm/tune/race.h"

#include <gtest/gtest.h>

#include "support/simulated_clock.h"
#include "tune/pilot_scenes.h"
#include "tune/ticking_clock.h"
#include "vpm/integrators/default_radii.h"
#include "vpm/integrators/open_ways.h"

namespace vpm {
namespace {

const AutomaticSettings kAll{{"integrator.type", "integrator.photons.emitted", "integrator.techniques",
                              "integrator.volume.radius", "integrator.surface.radius"}};

/// In a race of a hundred ticks, of which a pass takes three.
Winner winner_in(const Scene& scene) {
  RenderSettings settings;
  settings.until.seconds = 100.0;
  return race(scene, kAll, open_ways(scene, kAll, settings).ways, TickingClock(1.0));
}

/// A glossy floor under a sky: rays that the material draws find its light, and shadow rays seldom.
TEST(Race, PhotonMapsDoNotWinWhereAGlossyFloorShowsTheSky) {
  Scene scene;
  add_shape(scene, quad_mesh(Vec3d(-1.0, 0.0, 1.0), Vec3d(2.0, 0.0, 0.0), Vec3d(0.0, 0.0, -2.0)),
            Phong{Rgb(0.0f), Rgb(0.9f), 1000.0f});
  scene.lights.push_back(ConstantEnvironment{Rgb(1.0f)});
  scene.camera = make_camera(Vec3(0.0f, 3.0f, 0.0f), Vec3(0.0f), Vec3(0.0f, 0.0f, -1.0f), 40.0f, {64, 64});
  scene.geometry.commit();
  finish(scene);
  const Winner winner = winner_in(scene);
  EXPECT_NE(winner.settings.integrator, Integrator::photon) << winner.reason;
}

/// Black paths do not pass for quiet ones.
TEST(Race, PathsDoNotWinWhereTheyDoNotFindTheLight) {
  const Scene scene = lamp_in_glass();
  const Winner winner = winner_in(scene);
  EXPECT_NE(winner.reason.find("clearly more"), std::string::npos) << winner.reason;
  EXPECT_GT(winner.reason.find(", path"), winner.reason.find("clearly more")) << winner.reason;
  EXPECT_EQ(winner.choices.at(0).key, "integrator.photons.emitted");
}

/// A wide layer and a narrow beam, on which collisions of a few paths do not lie: these are black, and without noise.
TEST(Race, BlackPathsAreBehind) {
  Scene scene;
  scene.media.push_back(make_medium(nullptr, Rgb(0.5f), 0.9f));
  const Interface media{0, kVacuum};
  add_shape(scene, box_mesh(Vec3d(-10.0, -10.0, -0.5), Vec3d(10.0, 10.0, 0.5)), Boundary{}, &media);
  scene.lights.push_back(BeamLight{Vec3(0.0f, 0.0f, 2.0f), Vec3(0.0f, 0.0f, -1.0f), 0.01f, Rgb(1.0f)});
  scene.camera = make_camera(Vec3(0.0f, -3.0f, 3.0f), Vec3(0.0f), Vec3(0.0f, 1.0f, 0.0f), 60.0f, {64, 64});
  scene.geometry.commit();
  finish(scene);
  RenderSettings settings;
  settings.until.seconds = 300.0;
  settings.photons.emitted = 2000;
  const AutomaticSettings some{{"integrator.type", "integrator.volume.radius"}};
  RenderSettings paths = settings;
  paths.integrator = Integrator::path;
  const Winner winner = race(scene, some, {{"path", paths}, {"photon-map by beam", settings}}, TickingClock(1.0));
  EXPECT_EQ(winner.reason, "the least error by pilot passes; clearly more: path");
}

/// In thin air few photons collide, but all fly.
TEST(Race, BeamsWinWhereFewPhotonsCollide) {
  const Scene scene = lit_evenly(0.01f);
  RenderSettings settings;
  settings.until.seconds = 100.0;
  const AutomaticSettings gather{{"integrator.volume.type", "integrator.volume.radius"}};
  const OpenWays open = open_ways(scene, gather, settings);
  ASSERT_EQ(open.ways.size(), 2u);
  EXPECT_EQ(open.ways[0].name, "photon-map by beam");
  const Winner winner = race(scene, gather, open.ways, TickingClock(1.0));
  EXPECT_EQ(winner.settings.volume.type(), "photon-beams") << winner.reason;
  EXPECT_NE(winner.reason.find("clearly more: photon-map by beam"), std::string::npos) << winner.reason;
}

/// Neither of two that are the same is surely behind.
TEST(Race, TheFirstOfThoseAlikeIsTaken) {
  const Scene scene = lit_evenly(0.5f);
  RenderSettings settings;
  settings.until.seconds = 100.0;
  const Winner winner = race(scene, kAll, {{"one", settings}, {"two", settings}}, TickingClock(1.0));
  EXPECT_EQ(winner.reason, "the first of those that pilot passes do not tell apart, two");
}

/// By a clock of ticks nothing depends on the machine, nor on the number of threads.
TEST(Race, TheSameTimesGiveTheSameWinner) {
  const Scene scene = cloud_over_floor(true);
  const Winner one = winner_in(scene), again = winner_in(scene);
  EXPECT_EQ(one.settings.integrator, again.settings.integrator);
  ASSERT_EQ(one.choices.size(), again.choices.size());
  for (size_t i = 0; i < one.choices.size(); ++i) EXPECT_EQ(one.choices[i].value, again.choices[i].value);
}

TEST(Race, TheFirstOfAllIsTakenWhereTheTimeAllowsNoPass) {
  const Scene scene = cloud_over_floor(true);
  RenderSettings settings;
  settings.until.seconds = 1.0;
  const Winner winner = race(scene, kAll, open_ways(scene, kAll, settings).ways, HastyClock());
  EXPECT_EQ(winner.reason.substr(0, 22), "the first of all; not ") << winner.reason;
  EXPECT_EQ(winner.settings.integrator, Integrator::photon);
  RenderSettings usual;
  usual.volume.choose("beam");
  choose_default_radii(scene, kAll, usual);
  EXPECT_EQ(winner.settings.volume.radius, usual.volume.radius);
}

TEST(Race, WaysThatTheSettingsRefuseAreNotOpen) {
  RenderSettings of_pixels;
  of_pixels.radii = RadiusSchedule::per_pixel;  // of photon maps alone
  const OpenWays open = open_ways(cloud_over_floor(true), kAll, of_pixels);
  EXPECT_EQ(open.ways.size(), 3u);
  EXPECT_NE(open.refused.find("; not combined"), std::string::npos) << open.refused;
  RenderSettings merged;
  merged.photons.in_cube = 10;
  const AutomaticSettings gather{{"integrator.volume.type"}};
  const OpenWays maps = open_ways(lit_evenly(0.01f), gather, merged);
  ASSERT_EQ(maps.ways.size(), 1u);
  EXPECT_EQ(maps.ways[0].name, "photon-map by beam");
}

/// A gather that is given stays, and so does that of a scene without media.
TEST(Race, WhatIsGivenIsTheOnlyWay) {
  RenderSettings settings;
  settings.volume.choose("nearest");
  EXPECT_EQ(open_ways(lit_evenly(0.01f), {{"integrator.volume.radius"}}, settings).ways.size(), 1u);
  EXPECT_EQ(open_ways(lit_evenly(0.0f), {{"integrator.volume.type"}}, {}).ways.size(), 1u);
  RenderSettings ball_by_ball;
  ball_by_ball.volume.boundary = BoundaryRule::corrected;
  EXPECT_EQ(open_ways(lit_evenly(0.01f), {{"integrator.volume.type"}}, ball_by_ball).ways.at(0).settings.volume.type(),
            "radius");
}

}  // namespace
}  // namespace vpm
