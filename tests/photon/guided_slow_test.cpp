// Guided photons against those that are not: fewer tell more; photons that a guide scatters on their way through a
// hole; and caustics that are aimed.
#include <gtest/gtest.h>

#include "support/photons.h"
#include "vpm/base/parallel.h"
#include "vpm/medium/grid/make_grid.h"
#include "vpm/photon/caustics.h"
#include "vpm/photon/records.h"
#include "vpm/scene/build.h"

namespace vpm {
namespace {

constexpr double kHole = 0.15;  // half the width of the hole between chambers, m

/// A wall across the chambers with a hole in its middle.
void add_wall(Scene& scene, const Material& material) {
  add_shape(scene, box_mesh(Vec3d(-1.1, -1.1, -0.05), Vec3d(-kHole, 1.1, 0.05)), material);
  add_shape(scene, box_mesh(Vec3d(kHole, -1.1, -0.05), Vec3d(1.1, 1.1, 0.05)), material);
  add_shape(scene, box_mesh(Vec3d(-kHole, -1.1, -0.05), Vec3d(kHole, -kHole, 0.05)), material);
  add_shape(scene, box_mesh(Vec3d(-kHole, kHole, -0.05), Vec3d(kHole, 1.1, 0.05)), material);
}

void add_lamp_and_camera(Scene& scene, const Light& lamp) {
  scene.lights.push_back(lamp);
  scene.geometry.commit();
  scene.camera = make_camera(Vec3(0.6f, 0.3f, 1.8f), Vec3(-0.6f, -0.6f, 1.2f), Vec3(0, 1, 0), 40.0f, {8, 8});
  finish(scene);
  scene.camera_medium = medium_at(scene, scene.camera.position);
}

/// Two chambers full of fog, a light in the one, a camera in the other, and a hole in the wall between them. Walls are
/// diffuse and glossy; a ball of rough metal hangs beside the light, one of glass behind the hole.
Scene chambers() {
  Scene scene;
  Medium fog = make_medium(nullptr, Rgb(0.3f, 0.4f, 0.6f));
  fog.sigma_s = Rgb(0.28f, 0.36f, 0.4f);
  fog.phase = HenyeyGreenstein{0.4f};
  scene.media.push_back(fog);
  const Interface inside{0, kVacuum}, around{kVacuum, 0};
  add_shape(scene, box_mesh(Vec3d(-1, -1, -2), Vec3d(1, 1, 2)), Lambertian{Rgb(0.6f, 0.5f, 0.4f)}, &inside);
  add_wall(scene, Phong{Rgb(0.3f), Rgb(0.3f, 0.2f, 0.2f), 15.0f});
  const RoughConductor metal{Rgb(0.2f, 0.9f, 1.2f), Rgb(3.9f, 2.4f, 2.2f), 0.3f};
  add_shape(scene, SphereShape{Vec3(-0.5f, -0.5f, -1.2f), 0.3f}, metal);
  add_shape(scene, SphereShape{Vec3(0.1f, -0.5f, 0.6f), 0.25f}, Dielectric{1.5f}, &around);
  add_lamp_and_camera(scene, PointLight{Vec3(0.6f, 0.5f, -1.6f), Rgb(1.0f)});
  return scene;
}

/// The chambers with walls that are almost black, and a light that shines away from the hole: what gets through was
/// scattered towards it, by fog above all.
Scene dark_chambers() {
  Scene scene;
  scene.media.push_back(make_medium(nullptr, Rgb(0.3f), 0.6f));
  const Interface inside{0, kVacuum};
  add_shape(scene, box_mesh(Vec3d(-1, -1, -2), Vec3d(1, 1, 2)), Lambertian{Rgb(0.05f)}, &inside);
  add_wall(scene, Lambertian{Rgb(0.05f)});
  add_lamp_and_camera(scene, SpotLight{Vec3(0.6f, 0.5f, -0.2f), Vec3(0.0f, 0.0f, -1.0f), 0.9f, 0.8f, Rgb(1.0f)});
  return scene;
}

PhotonGuide learned(const Scene& scene, const GuideSettings& settings) {
  return learn_guide(scene, *make_distance_strategy({}), settings, 1, 0, 1000);
}

PhotonLists photons_of(const Scene& scene, const PhotonGuide* guide, bool split, uint64_t emitted, uint64_t pass) {
  ListSettings settings;
  settings.pass = pass;
  settings.emitted = emitted;
  settings.volume_form = VolumeForm::density_at_photon;
  settings.guide = guide;
  settings.split = split;
  return list_photons(scene, *make_distance_strategy({}), settings);
}

/// The power behind the hole that collides and that comes to surfaces, over passes from the first on.
Moments power_behind(const Scene& scene, const PhotonGuide* guide, uint64_t emitted, uint64_t passes, uint64_t first) {
  Moments result;
  for (uint64_t pass = first; pass < first + passes; ++pass) {
    const PhotonLists photons = photons_of(scene, guide, false, emitted, pass + (guide ? 1000 : 0));
    double sum = 0.0;
    for (const std::vector<Photon>* list : {&photons.volume[0], &photons.surface})
      for (const Photon& p : *list)
        if (p.position.z > 0.0f) sum += sum_channels(p.power);
    result.add(sum / static_cast<double>(emitted));
  }
  return result;
}

/// Of as many photons, which are neither aimed nor split: the variance of twenty groups of passes, for it has heavy
/// tails. Seen is a gain of 1.7. Without any the test would pass one time in 200.
TEST(PhotonsScatteredByAGuide, TellMoreOfWhatIsBehindAHole) {
  const Scene scene = dark_chambers();
  const PhotonGuide guide = learned(scene, {.importons = 50'000, .aim = false, .scatter = true});
  Moments gains;  // logarithms
  for (uint64_t group = 0; group < 20; ++group) {
    const double plain = power_behind(scene, nullptr, 5000, 40, 40 * group).variance();
    gains.add(std::log(plain / power_behind(scene, &guide, 5000, 40, 40 * group).variance()));
  }
  EXPECT_GT(gains.mean(), 2.9 * std::sqrt(gains.variance_of_mean()));
}

TEST(PhotonsScatteredByAGuide, AreTheSameOnAnyNumberOfThreads) {
  const Scene scene = chambers();
  const auto trace = [&](int threads) {
    set_threads(threads);
    const PhotonGuide guide = learned(scene, {.importons = 150'000, .scatter = true});  // more than a wave
    return photons_of(scene, &guide, true, 10'000, 0).surface;
  };
  const std::vector<Photon> alone = trace(1), together = trace(2);
  set_threads(0);
  ASSERT_EQ(alone.size(), together.size());
  for (size_t i = 0; i < alone.size(); ++i) {
    ASSERT_EQ(alone[i].position, together[i].position);
    ASSERT_EQ(alone[i].power, together[i].power);
  }
}

constexpr float kSeen = 1.0f / 3.0f;  // m: where the corner begins that the camera sees

/// Fog in a box, a light in one of its corners and a camera that looks into the opposite one, between diffuse plates.
Scene foggy_box() {
  Scene scene;
  scene.media.push_back(make_medium(nullptr, Rgb(1.5f), 0.9f));
  const Interface media{0, kVacuum};
  add_shape(scene, box_mesh(Vec3d(-1.0), Vec3d(1.0)), Boundary{}, &media);
  add_shape(scene, SphereShape{Vec3(0.0f, 0.0f, 0.2f), 0.3f}, Lambertian{Rgb(0.7f)});
  scene.lights.push_back(PointLight{Vec3(-0.9f, -0.8f, 0.7f), Rgb(1.0f)});
  scene.geometry.commit();
  scene.camera = make_camera(Vec3(0.5f, 0.5f, -0.8f), Vec3(0.9f, 0.9f, -0.9f), Vec3(0, 1, 0), 40.0f, {8, 8});
  finish(scene);
  scene.camera_medium = medium_at(scene, scene.camera.position);
  return scene;
}

/// The power that collides in the corner that the camera looks into, a third of the box along each edge, over
/// independent passes.
Moments power_seen(const Scene& scene, GuideSettings guided, uint64_t emitted, int passes) {
  const auto strategy = make_distance_strategy({});
  Moments result;
  for (int pass = 0; pass < passes; ++pass) {
    ListSettings settings;
    settings.pass = static_cast<uint64_t>(pass) + (guided.importons > 0 ? 1000 : 0);
    settings.emitted = emitted;
    settings.volume_form = VolumeForm::density_at_photon;
    std::optional<PhotonGuide> guide;
    if (guided.importons > 0) {
      guide = learn_guide(scene, *strategy, guided, settings.seed, settings.pass, 1000);
      settings.guide = &*guide;
      settings.split = guided.split;
    }
    const PhotonLists photons = list_photons(scene, *strategy, settings);
    double sum = 0.0;
    for (const Photon& p : photons.volume[0])
      if (p.position.x > kSeen && p.position.y > kSeen && p.position.z < -kSeen) sum += p.power.g;
    result.add(sum / static_cast<double>(emitted));
  }
  return result;
}

/// There, the far one, half the photons know the power better.
TEST(GuidedPhotons, TellMoreOfWhatTheCameraSees) {
  const Scene scene = foggy_box();
  const Moments plain = power_seen(scene, {}, 2000, 100);
  const Moments guided = power_seen(scene, {.importons = 1000}, 1000, 100);
  EXPECT_LT(guided.variance(), 0.75 * plain.variance());
}

/// A light over a diffuse floor, with a small ball of glass between them, out of the way of most photons.
Scene small_ball() {
  Scene scene;
  add_shape(scene, DiscShape{Vec3(0.0f), Vec3(0.0f, 1.0f, 0.0f), 4.0f}, Lambertian{Rgb(0.5f)});
  add_shape(scene, SphereShape{Vec3(0.3f, 0.6f, 0.0f), 0.1f}, Dielectric{1.5f});
  scene.lights = {PointLight{Vec3(0.0f, 2.0f, 0.0f), Rgb(1.0f)}, PointLight{Vec3(0.0f, -1.0f, 0.0f), Rgb(1.0f)}};
  scene.geometry.commit();
  finish(scene);
  return scene;
}

/// Of photons on the floor that glass alone has led there.
TEST(Caustics, ArriveTwentyTimesAsOftenWhereTheyAreAimed) {
  const Scene scene = small_ball();
  constexpr uint64_t kAll = 400'000, kAimed = 8'000;
  HitRecorder all(scene, caustic_photons(false, true), HitUse::other_map);
  trace_into(scene, {.emitted = kAll}, {&all});
  const std::vector<Photon> aimed = trace_caustics(scene, *make_distance_strategy({}), {.emitted = kAimed});
  for (const Photon& p : aimed) EXPECT_LT(std::abs(p.position.y), 1e-4f);
  EXPECT_GT(static_cast<double>(aimed.size()) / kAimed, 20.0 * static_cast<double>(all.photons.size()) / kAll);
}

/// The photons that are left to the other tracing are those that media scattered: here none.
TEST(Caustics, LeaveNothingTwice) {
  const Scene scene = small_ball();
  HitRecorder caustics(scene, caustic_photons(false, false), HitUse::other_map);
  trace_into(scene, {.emitted = 100'000}, {&caustics});
  EXPECT_TRUE(caustics.photons.empty());
}

}  // namespace
}  // namespace vpm
