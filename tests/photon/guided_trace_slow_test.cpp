// Guided photons against those that are not: fewer tell more; and caustics that are aimed.
#include <gtest/gtest.h>

#include "support/recorders.h"
#include "vpm/medium/make_grid.h"
#include "vpm/photon/caustics.h"
#include "vpm/photon/photon_lists.h"
#include "vpm/photon/records.h"
#include "vpm/scene/build.h"

namespace vpm {
namespace {

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
