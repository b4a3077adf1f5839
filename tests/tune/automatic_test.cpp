// Settings that a render chooses: the pilot is a pure function where no time tells, and changes nothing that is given.
#include "vpm/tune/automatic.h"
#include "vpm/tune/choose_records.h"

#include <gtest/gtest.h>
#include <algorithm>

#include "support/borders.h"
#include "support/simulated_clock.h"
#include "tune/pilot_scenes.h"
#include "vpm/base/clock.h"
#include "vpm/base/counters.h"
#include "vpm/base/parallel.h"
#include "vpm/estimate/photon_map.h"
#include "vpm/integrators/combined/combined_pass.h"
#include "vpm/integrators/describe.h"
#include "vpm/integrators/every_setting.h"
#include "vpm/job/render_job.h"
#include "vpm/render/pass_time.h"
#include "vpm/render/render.h"
#include "vpm/tune/choice_rules.h"
#include "vpm/tune/counted_cost.h"
#include "vpm/tune/pilot.h"

namespace vpm {
namespace {

/// No clock decides where no time is asked for: all that can be chosen is.
TEST(Automatic, ChoosesTheSameOnAnyNumberOfThreads) {
  const Scene scene = cloud_over_floor(true);
  const AutomaticSettings automatic{{"integrator.type", "integrator.photons.emitted", "integrator.volume.type",
                                     "integrator.volume.radius", "integrator.surface.radius",
                                     "integrator.distance.type"}};
  std::vector<std::vector<Choice>> chosen;
  for (const int threads : {1, 2}) {
    set_threads(threads);
    RenderSettings settings;
    chosen.push_back(choose_settings(scene, automatic, {SimulatedClock(), kInfinity}, settings).choices);
    EXPECT_GT(settings.volume.radius.metres(), 0.0f);
    EXPECT_GT(settings.surface.radius.metres(), 0.0f);
  }
  set_threads(0);
  ASSERT_GE(chosen[0].size(), 5u);
  ASSERT_EQ(chosen[1].size(), chosen[0].size());
  for (size_t i = 0; i < chosen[0].size(); ++i) {
    EXPECT_EQ(chosen[0][i].key, chosen[1][i].key);
    EXPECT_EQ(chosen[0][i].value, chosen[1][i].value);
    EXPECT_EQ(chosen[0][i].reason, chosen[1][i].reason);
  }
}

/// Paths fly as photons do, though they leave no map; and what absorbs all has flights, too.
TEST(Automatic, ComparesStrategiesWhereThereIsNoMap) {
  Scene scene = cloud_over_floor(true);
  RenderSettings paths;
  paths.integrator = Integrator::path;
  for (const StrategyCost& each : strategy_costs(scene, paths)) EXPECT_GT(each.cost, 0.0) << each.name;
  scene.media[0].sigma_s = Rgb(0.0f);
  for (Material& material : scene.materials)
    if (!is_boundary(material)) material = Lambertian{Rgb(0.0f)};
  for (const StrategyCost& each : strategy_costs(scene, {})) EXPECT_GT(each.cost, 0.0) << each.name;
}

TEST(Automatic, ChangesNothingThatIsGiven) {
  const Scene scene = cloud_over_floor(true);
  RenderSettings given;
  given.volume.radius = 0.3f;
  given.surface.radius = 0.4f;
  given.caustics.radius = 0.5f;
  given.photons.emitted = 12'345;
  given.distance.strategy = "delta";
  RenderSettings settings = given;
  EXPECT_TRUE(choose_settings(scene, {}, {SimulatedClock(), kInfinity}, settings).choices.empty());
  EXPECT_EQ(
      choose_settings(scene, {{"integrator.surface.radius"}}, {SimulatedClock(), kInfinity}, settings).choices.size(),
      1u);
  EXPECT_EQ(settings.volume.radius.metres(), 0.3f);
  EXPECT_NE(settings.surface.radius.metres(), 0.4f);
  EXPECT_EQ(settings.caustics.radius.metres(), 0.5f);
  EXPECT_EQ(settings.photons.emitted, 12'345u);
  EXPECT_EQ(settings.distance.strategy, "delta");
}

TEST(Automatic, LeavesAloneWhatTheSceneHasNoUseFor) {
  const Scene scene = cloud_over_floor(false);
  RenderSettings settings;
  settings.integrator = Integrator::path;
  AutomaticSettings all;
  for (const SettingOfSome& each : every_setting())
    if (each.setting.automatic) all.keys.insert(each.setting.key);
  EXPECT_EQ(all.keys.erase("integrator.type"), 1u);
  EXPECT_EQ(all.keys.size(), 7u);
  const std::vector<Choice> choices = choose_settings(scene, all, {SimulatedClock(), kInfinity}, settings).choices;
  ASSERT_EQ(choices.size(), 1u);
  EXPECT_EQ(settings.distance.strategy, "homogeneous");
  EXPECT_EQ(settings.photons.emitted, RenderSettings{}.photons.emitted);
  EXPECT_FALSE(settings.volume.radius.is_given());
}

// Cells are far smaller than free paths here: to visit all is the dearest way.
TEST(Automatic, CountsTheExactStrategies) {
  const std::vector<StrategyCost> costs = strategy_costs(cloud_over_floor(true), {});
  std::vector<std::string_view> names;
  for (const StrategyCost& each : costs) names.push_back(each.name);
  EXPECT_EQ(names, (std::vector<std::string_view>{"regular", "delta", "delta-local", "decomposition"}));
  EXPECT_EQ(costs[0].cost, std::max({costs[0].cost, costs[1].cost, costs[2].cost, costs[3].cost}));
}

/// As many photons lie within the radius chosen as the rule says, in air so thin that light stays what it is.
TEST(Automatic, TheRadiusOfAMediumHoldsThePhotonsThatItPromises) {
  const Scene scene = lit_evenly(0.01f);
  RenderSettings settings;
  settings.single_scattering.type = DirectLight::photons;
  settings.photons.emitted = 1'000'000;
  choose_records(scene, {{"integrator.volume.radius"}}, kInfinity, settings);
  // Of a cylinder through the box, 2 m long, that a share of 1 - exp(-0.02) collides in; few do so twice.
  const double collisions = -std::expm1(-0.02) * settings.photons.emitted;
  const double share = 4.0 / 3.0 * std::pow(settings.volume.radius.metres(), 3.0) / (0.9 * 0.9 * 2.0);
  EXPECT_NEAR(share * collisions, kPhotonsWithin, 0.15 * kPhotonsWithin);
}

/// Of two media the thinner bounds radii, though most places lie in the other; as thick as it is across, not along
/// axes.
TEST(Automatic, MediaAreAsThickAsTheThinnestIsAcross) {
  Scene scene;
  const Interface slab{0, kVacuum}, box{1, kVacuum};
  scene.media.push_back(make_medium(nullptr, Rgb(5.0f), 0.9f));
  scene.media.push_back(make_medium(nullptr, Rgb(2.0f), 0.9f));
  const float half = std::sqrt(0.5f);
  const glm::mat3 askew(half, half, 0.0f, -half, half, 0.0f, 0.0f, 0.0f, 1.0f);
  add_shape(scene, turned(box_mesh(Vec3d(-1.0, -0.05, -1.0), Vec3d(1.0, 0.05, 1.0)), askew), Boundary{}, &slab);
  add_shape(scene, box_mesh(Vec3d(-1.0, -1.0, -4.0), Vec3d(1.0, 1.0, -2.0)), Boundary{}, &box);
  scene.lights.push_back(BeamLight{Vec3(0.0f, 2.0f, 0.0f), Vec3(0.0f, -1.0f, 0.0f), 0.9f, Rgb(1.0f)});
  scene.camera = make_camera(Vec3(0.0f, 0.0f, 3.0f), Vec3(0.0f), Vec3(0.0f, 1.0f, 0.0f), 20.0f, {64, 64});
  scene.geometry.commit();
  finish(scene);
  const MapDensities found = map_densities(scene, {}, 2000);
  EXPECT_NEAR(found.volume->thickness, 0.1, 1e-4);
  EXPECT_NEAR(found.volume->free_path, 0.2, 1e-6);
}

/// A grid of 2 m in a box of 8 m.
TEST(Automatic, MediaEndWithTheirGrids) {
  Scene scene;
  scene.media.push_back(make_medium(make_grid(centered_frame(16, 1.0 / 16.0), lattice_noise), Rgb(2.0f), 0.9f));
  const Interface media{0, kVacuum};
  add_shape(scene, box_mesh(Vec3d(-4.0), Vec3d(4.0)), Boundary{}, &media);
  scene.lights.push_back(PointLight{Vec3(0.0f, 3.0f, 0.0f), Rgb(10.0f)});
  scene.camera = make_camera(Vec3(0.0f, 0.0f, 5.0f), Vec3(0.0f), Vec3(0.0f, 1.0f, 0.0f), 10.0f, {16, 16});
  scene.geometry.commit();
  finish(scene);
  const MapDensities found = map_densities(scene, {}, 20'000);
  EXPECT_GT(found.volume->thickness, 0.6);
  EXPECT_LT(found.volume->thickness, 2.1);
}

/// Though a pilot that is in a hurry stores fewer photons than these.
TEST(Automatic, DefaultRadiiAreTheSameWhateverTimeIsAskedFor) {
  const AssembledScene room = foggy_room(4.0f);
  RenderSettings unhurried, hurried;
  hurried.until.seconds = 0.1;
  const AutomaticSettings automatic{.default_radii = {"integrator.volume.radius"}};
  choose_default_radii(room.scene, automatic, unhurried);
  choose_default_radii(room.scene, automatic, hurried);
  EXPECT_EQ(hurried.volume.radius, unhurried.volume.radius);
}

/// Flights pass within the radius chosen as the rule says: all through the same box, along one direction.
TEST(Automatic, TheRadiusOfBeamsHoldsTheFlightsThatItPromises) {
  const Scene scene = lit_evenly(0.01f);
  RenderSettings settings;
  settings.volume.choose("photon-beams");
  settings.photons.emitted = 1'000'000;
  choose_records(scene, {{"integrator.volume.radius"}}, kInfinity, settings);
  const double share = std::pow(settings.volume.radius.metres() / 0.9, 2.0);  // of the photons
  EXPECT_NEAR(share * settings.photons.emitted, kPhotonsWithin, 0.15 * kPhotonsWithin);
}

/// The photons within the radius chosen, at a place that is lit evenly and seen straight, are as many as the rule says:
/// power over area of an even parallel light tells how many there are.
TEST(Automatic, TheRadiusHoldsThePhotonsThatItPromises) {
  Scene scene;
  add_shape(scene, quad_mesh(Vec3d(-1.0, 0.0, 1.0), Vec3d(2.0, 0.0, 0.0), Vec3d(0.0, 0.0, -2.0)),
            Lambertian{Rgb(0.5f)});
  scene.lights.push_back(BeamLight{Vec3(0.0f, 2.0f, 0.0f), Vec3(0.0f, -1.0f, 0.0f), 0.9f, Rgb(1.0f)});
  scene.camera = make_camera(Vec3(0.0f, 3.0f, 0.0f), Vec3(0.0f), Vec3(0.0f, 0.0f, -1.0f), 20.0f, {64, 64});
  scene.geometry.commit();
  finish(scene);
  RenderSettings settings;
  settings.direct.type = DirectLight::photons;
  settings.photons.emitted = 400'000;
  choose_records(scene, {{"integrator.surface.radius"}}, kInfinity, settings);
  const double share = std::pow(settings.surface.radius.metres() / 0.9, 2.0);  // of the photons
  // The median over 512 places of densities told by 16 photons each: off by 2 % or so, and by 4 % as the median of a
  // gamma distribution is; a tenth is four standard deviations at least.
  EXPECT_NEAR(share * 400'000, kPhotonsWithin, 0.1 * kPhotonsWithin);
}

/// Nothing but a mirror: no map asks for photons, of which only the stored ones are limited.
TEST(Automatic, TimesNoPhotonsWhereThereIsNoMap) {
  Scene scene;
  add_shape(scene, quad_mesh(Vec3d(-3.0, -1.5, 3.0), Vec3d(6.0, 0.0, 0.0), Vec3d(0.0, 0.0, -6.0)), Mirror{});
  scene.lights.push_back(PointLight{Vec3(0.0f, 3.0f, 0.0f), Rgb(10.0f)});
  scene.camera = make_camera(Vec3(0.0f, 0.5f, 5.0f), Vec3(0.0f, -0.5f, 0.0f), Vec3(0.0f, 1.0f, 0.0f), 45.0f, {8, 8});
  scene.geometry.commit();
  finish(scene);
  RenderSettings settings;
  settings.photons.emitted = 0;
  settings.photons.stored = 100'000;
  const PassCost cost = time_pass(scene, settings, 10.0);
  EXPECT_EQ(cost.photon, 0.0);
  EXPECT_GT(cost.eye, 0.0);
}

/// Combined techniques take radii as photon maps by points have them, for the light sub-paths that are chosen.
TEST(Automatic, CombinedTechniquesHaveTheRadiiOfMapsUpToThatOfMerges) {
  const Scene scene = cloud_over_floor(true);
  RenderSettings combined;
  combined.integrator = Integrator::combined;
  combined.surface.mode = GatherMode::nearest;  // which merges do not go by
  const AutomaticSettings automatic{
      {"integrator.photons.emitted", "integrator.volume.radius", "integrator.surface.radius"}};
  constexpr double kLimit = 0.25;  // s
  EXPECT_EQ(choose_records(scene, automatic, kLimit, combined).size(), 3u);
  EXPECT_GE(combined.photons.emitted, kLeastCount);
  EXPECT_LE(combined.photons.emitted, 100'000u);  // of a picture of 3000 pixels
  RenderSettings maps;
  maps.photons.emitted = combined.photons.emitted;
  choose_records(scene, {{"integrator.volume.radius", "integrator.surface.radius"}}, kLimit, maps);
  EXPECT_EQ(combined.volume.radius.metres(), std::min(maps.volume.radius.metres(), first_radius_of_merges({}, scene)));
  EXPECT_EQ(combined.surface.radius.metres(), std::min(maps.surface.radius.metres(), first_radius({}, scene)));
  EXPECT_TRUE(
      choose_settings(scene, {{"integrator.volume.type"}}, {SimulatedClock(), kInfinity}, combined).choices.empty())
      << "it has none";
}

/// Few photons want wide radii, within which merges at borders would lose light.
TEST(Automatic, MergesAreByDefaultNoWiderThanWhereNobodyChooses) {
  const Scene scene = cloud_over_floor(true);
  const AutomaticSettings automatic{.default_radii = {"integrator.volume.radius", "integrator.surface.radius"}};
  RenderSettings maps, combined;
  maps.photons.emitted = combined.photons.emitted = 2000;
  combined.integrator = Integrator::combined;
  choose_default_radii(scene, automatic, maps);
  for (const Choice& choice : choose_default_radii(scene, automatic, combined))
    EXPECT_EQ(choice.reason.substr(0, 34), "1 % of the scene's or the grid's d") << choice.reason;
  const float merges = first_radius_of_merges({}, scene);
  EXPECT_GT(maps.volume.radius.metres(), merges);
  EXPECT_EQ(combined.volume.radius.metres(), merges);
  EXPECT_EQ(combined.surface.radius.metres(), first_radius({}, scene));
}

/// Also those that are "auto", where choosing is given up.
TEST(Automatic, RadiiHaveTheirDefaultsWhereTheTimeDoesNotAllowMore) {
  const Scene scene = cloud_over_floor(true);
  const AutomaticSettings automatic{
      {"integrator.photons.emitted", "integrator.volume.radius", "integrator.surface.radius"}};
  RenderSettings usual;
  usual.until.seconds = 1.0;
  RenderSettings settings = usual;
  choose_default_radii(scene, automatic, usual);
  const HastyClock clock;
  const Chosen chosen = choose_settings(scene, automatic, {clock, 1.0}, settings);
  EXPECT_EQ(chosen.not_chosen, "the time does not allow to choose photons and radii");
  EXPECT_EQ(chosen.choices.size(), 2u);
  EXPECT_EQ(settings.volume.radius, usual.volume.radius);
  EXPECT_EQ(settings.surface.radius, usual.surface.radius);
  EXPECT_EQ(settings.photons.emitted, usual.photons.emitted);
}

TEST(Automatic, TheFirstOfAllIsTakenWhereTheTimeAllowsNoTrial) {
  const Scene scene = cloud_over_floor(true);
  RenderSettings settings;
  settings.until.seconds = 1.0;
  const HastyClock clock;
  const std::vector<Choice> choices =
      choose_settings(scene, {{"integrator.type", "integrator.volume.radius"}}, {clock, 1.0}, settings).choices;
  ASSERT_EQ(choices.size(), 2u);
  EXPECT_EQ(choices[0].value, "photon-map");
  EXPECT_EQ(choices[0].reason.substr(0, 22), "the first of all; not ") << choices[0].reason;
  EXPECT_TRUE(settings.volume.radius.is_given());
}

/// A gather that is given stays, and so does that of a scene without media.
TEST(Automatic, KeepsGathersThatAreGiven) {
  RenderSettings settings;
  settings.volume.choose("nearest");
  choose_settings(lit_evenly(0.01f), {{"integrator.volume.radius"}}, {SimulatedClock(), kInfinity}, settings);
  EXPECT_EQ(settings.volume.type(), "nearest");
  EXPECT_TRUE(choose_settings(lit_evenly(0.0f), {{"integrator.volume.type"}}, {SimulatedClock(), kInfinity}, settings)
                  .choices.empty());
}

TEST(Automatic, TheLeastErrorIsTheFirstsUnlessAnotherIsClearlyLess) {
  EXPECT_EQ(least_error(std::vector<double>{1.0, 0.95}), 0u);
  EXPECT_EQ(least_error(std::vector<double>{1.0, 0.85}), 1u);
  EXPECT_EQ(least_error(std::vector<double>{1.0, 0.85, 0.8}), 1u);
  EXPECT_EQ(least_error(std::vector<double>{1.0, 2.0}), 0u);
}

/// Rays march as far as the photons of all blocks lie, which a tracing of their own tells.
TEST(Automatic, CountsTheTracingsOfAPassInBlocks) {
  if (!kCounts) GTEST_SKIP() << "nothing is counted (VPM_COUNTERS=OFF)";
  const Scene scene = cloud_over_floor(true);
  RenderSettings settings;
  settings.photons.emitted = 20'000;
  for (const auto& [type, tracings] : {std::pair{"radius", 2}, {"beam", 1}}) {
    settings.volume.choose(type);
    settings.photons.block = 0;
    const PassCost whole = time_pass(scene, settings);
    settings.photons.block = 5000;
    const PassCost blocks = time_pass(scene, settings);
    EXPECT_DOUBLE_EQ(blocks.photon, tracings * whole.photon);
    EXPECT_GT(blocks.eye, whole.eye);
    EXPECT_LT(blocks.eye, 4.0 * whole.eye);
    EXPECT_EQ(blocks.stored_per_photon, whole.stored_per_photon);
  }
}

/// What is counted of sums by whole nodes is not what as many photons one by one would take.
TEST(Automatic, CountsLessOfManyNearestPhotons) {
  RenderSettings few, many;
  few.surface.mode = many.surface.mode = GatherMode::nearest;
  few.surface.count = NearestMap::kMany - 1;
  many.surface.count = NearestMap::kMany;
  EyeCounters used;
  used.gather.used = 1'000'000;
  Scene diffuse, glossy;
  diffuse.materials = {Lambertian{}, Mirror{}, Boundary{}};
  glossy.materials = {Lambertian{}, Phong{}};
  const auto share = [&](const Scene& scene) {
    return counted_work(scene, many, used).seconds / counted_work(scene, few, used).seconds;
  };
  EXPECT_LT(share(diffuse), 0.2);
  EXPECT_EQ(share(glossy), 1.0);
  few.caustics.emitted = many.caustics.emitted = 1000;
  few.indirect.type = many.indirect.type = IndirectLight::final_gather;
  EXPECT_EQ(share(diffuse), 1.0);
  few.caustics.emitted = many.caustics.emitted = 0;
  used.used_in_media = 1'000'000;
  EXPECT_EQ(share(diffuse), 1.0);
}

/// A timing in a hurry asks for fewer photons, and tells about the same of each; and paths have a pass to time, too.
TEST(Automatic, TellsTheSameOfEachPhotonInAHurry) {
  const Scene scene = cloud_over_floor(false);
  RenderSettings settings;
  settings.photons.emitted = 100'000'000;
  const PassCost cost = time_pass(scene, settings, 0.2);
  EXPECT_GT(cost.photon, 0.0);
  EXPECT_GT(cost.eye, 0.0);
  EXPECT_NEAR(cost.stored_per_photon, time_pass(scene, settings, 0.4).stored_per_photon, 0.3 * cost.stored_per_photon);
  settings.integrator = Integrator::path;
  const PassCost paths = time_pass(scene, settings, 0.1);
  EXPECT_EQ(paths.photon, 0.0);
  EXPECT_GT(paths.eye, 0.0);
}

}  // namespace
}  // namespace vpm
