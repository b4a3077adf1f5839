// Settings that a render chooses: without a time a pure function, which changes nothing that is given.
#include "vpm/tune/automatic.h"

#include <gtest/gtest.h>

#include "support/simulated_clock.h"
#include "tune/pilot_scenes.h"
#include "vpm/base/counters.h"
#include "vpm/base/error.h"
#include "vpm/base/parallel.h"
#include "vpm/integrators/every_setting.h"

namespace vpm {
namespace {

AutomaticSettings all_settings() {
  AutomaticSettings all;
  for (const SettingOfSome& each : every_setting())
    if (each.setting.automatic) all.keys.insert(each.setting.key);
  return all;
}

std::vector<Choice> choose_without_time(const Scene& scene, const AutomaticSettings& automatic,
                                        RenderSettings& settings) {
  return choose_settings(scene, automatic, SimulatedClock(), settings);
}

TEST(Automatic, ChoosesTheSameOnAnyNumberOfThreads) {
  const Scene scene = cloud_over_floor(true);
  std::vector<std::vector<Choice>> chosen;
  for (const int threads : {1, 2}) {
    set_threads(threads);
    RenderSettings settings;
    chosen.push_back(choose_without_time(scene, all_settings(), settings));
    EXPECT_TRUE(settings.volume.radius.is_given());
    EXPECT_TRUE(settings.surface.radius.is_given());
    EXPECT_EQ(settings.integrator, Integrator::photon);
  }
  set_threads(0);
  ASSERT_EQ(chosen[0].size(), kCounts ? 4u : 3u);
  for (size_t i = 0; i < chosen[0].size(); ++i) {
    EXPECT_EQ(chosen[0][i].key, chosen[1][i].key);
    EXPECT_EQ(chosen[0][i].value, chosen[1][i].value);
    EXPECT_EQ(chosen[0][i].reason, chosen[1][i].reason);
  }
}

TEST(Automatic, ChangesNothingThatIsGiven) {
  const Scene scene = cloud_over_floor(true);
  RenderSettings settings;
  settings.volume.radius = 0.3f;
  settings.surface.radius = 0.4f;
  settings.photons.emitted = 12'345;
  EXPECT_TRUE(choose_without_time(scene, {}, settings).empty());
  EXPECT_EQ(choose_without_time(scene, {{"integrator.surface.radius"}}, settings).size(), 1u);
  EXPECT_EQ(settings.volume.radius.metres(), 0.3f);
  EXPECT_NE(settings.surface.radius.metres(), 0.4f);
  EXPECT_EQ(settings.photons.emitted, 12'345u);
}

TEST(Automatic, LeavesAloneWhatTheSceneHasNoUseFor) {
  RenderSettings settings;
  settings.integrator = Integrator::path;
  AutomaticSettings all = all_settings();
  EXPECT_EQ(all.keys.erase("integrator.type"), 1u);
  EXPECT_EQ(all.keys.size(), 6u);
  EXPECT_TRUE(choose_without_time(cloud_over_floor(false), all, settings).empty());
  EXPECT_EQ(settings.photons.emitted, RenderSettings{}.photons.emitted);
  EXPECT_FALSE(settings.volume.radius.is_given());
}

/// Four times the pixels have four times the rays.
TEST(Automatic, PhotonsHaveAsManyRaysAsTheEye) {
  if (!kCounts) GTEST_SKIP() << "nothing is counted (VPM_COUNTERS=OFF)";
  Scene scene = cloud_over_floor(false);
  const auto photons = [&] {
    RenderSettings settings;
    EXPECT_EQ(choose_without_time(scene, {{"integrator.photons.emitted"}}, settings).size(), 1u);
    return static_cast<double>(settings.photons.emitted);
  };
  scene.camera.width = scene.camera.height = 128;
  const double some = photons();
  EXPECT_GT(some, 1'000);  // the least there are
  scene.camera.width = scene.camera.height = 256;
  EXPECT_NEAR(photons() / some, 4.0, 0.3);
}

TEST(Automatic, RefusesChoicesThatAreNone) {
  RenderSettings settings;
  set_chosen(settings, "integrator.volume.radius", "0.0123");
  EXPECT_EQ(settings.volume.radius.metres(), 0.0123f);
  set_chosen(settings, "integrator.photons.emitted", "170000");
  EXPECT_EQ(settings.photons.emitted, 170'000u);
  EXPECT_THROW(set_chosen(settings, "integrator.volume.radius", "-1"), InputError);
  EXPECT_THROW(set_chosen(settings, "integrator.volume.radius", "1 m"), InputError);
  EXPECT_THROW(set_chosen(settings, "integrator.photons.emitted", "0"), InputError);
  EXPECT_THROW(set_chosen(settings, "integrator.distance.type", "delta"), InputError);
  EXPECT_THROW(set_chosen(settings, "film.width", "3"), InputError);
  EXPECT_THROW(set_chosen(settings, "render.passes", "3"), InputError);
}

}  // namespace
}  // namespace vpm
