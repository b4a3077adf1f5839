// Guided photons against those that are not: the same means, from fewer; and caustics that are aimed.
#include <gtest/gtest.h>

#include "support/recorders.h"
#include "support/statistics.h"
#include "vpm/medium/make_grid.h"
#include "vpm/photon/caustics.h"
#include "vpm/photon/photon_lists.h"
#include "vpm/photon/records.h"
#include "vpm/scene/build.h"

namespace vpm {
namespace {

constexpr double kFalseAlarms = 1e-6;
constexpr int kBoxes = 3;  // along an edge of [-1, 1]^3

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

/// The power that collides in each box, what surfaces take, and what escapes, over independent passes.
std::vector<Moments> tally(const Scene& scene, GuideSettings guided, uint64_t emitted, int passes) {
  const auto strategy = make_distance_strategy({});
  std::vector<Moments> result(kBoxes * kBoxes * kBoxes + 3);
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
    std::vector<double> sums(result.size(), 0.0);
    for (const Photon& p : photons.volume[0]) {
      const Vec3i box = glm::clamp(Vec3i((p.position + 1.0f) * (0.5f * kBoxes)), Vec3i(0), Vec3i(kBoxes - 1));
      sums[static_cast<size_t>((box.z * kBoxes + box.y) * kBoxes + box.x)] += p.power.g;
    }
    double on_surfaces = 0.0;
    for (const Photon& p : photons.surface) on_surfaces += p.power.g;
    const size_t n = sums.size();
    sums[n - 3] = on_surfaces;
    sums[n - 2] = photons.ledger.escaped.g;
    sums[n - 1] = photons.ledger.emitted.g;
    for (size_t i = 0; i < n; ++i) result[i].add(sums[i] / static_cast<double>(emitted));
  }
  return result;
}

TEST(GuidedPhotons, HaveTheMeansOfUnguidedOnes) {
  const Scene scene = foggy_box();
  const std::vector<Moments> plain = tally(scene, {}, 3000, 25);
  for (const bool aim : {false, true})
    for (const bool split : {false, true}) {
      const std::vector<Moments> guided = tally(scene, {.importons = 1000, .aim = aim, .split = split}, 750, 25);
      for (size_t i = 0; i < plain.size(); ++i) {
        const Check check = check_same("", plain[i], guided[i]);
        EXPECT_GE(check.p, kFalseAlarms) << "aim " << aim << ", split " << split << ", value " << i << ": "
                                         << plain[i].mean() << " against " << guided[i].mean() << " +- " << check.error;
      }
    }
}

/// A plate takes a tenth of a light's light, whether photons are aimed at it or not.
TEST(GuidedPhotons, CarryLessWhereMoreAreEmitted) {
  constexpr double kCosine = 0.8;  // of the cone to the plate's rim
  Scene scene;
  const auto rim = static_cast<float>(std::sqrt(1.0 - kCosine * kCosine) / kCosine);
  add_shape(scene, DiscShape{Vec3(0.0f, 1.0f, 0.0f), Vec3(0.0f, -1.0f, 0.0f), rim}, Lambertian{Rgb(0.5f)});
  scene.lights.push_back(PointLight{Vec3(0.0f), Rgb(1.0f)});
  scene.geometry.commit();
  finish(scene);
  const auto is_aimed = [&](const EmissionPoint& point, Rng&) {
    return emit_photon(scene, point).ray.direction.y > kCosine ? 1.0f : 0.0f;
  };
  const PhotonGuide guide{ImportanceMap(scene.bounds, 1), std::nullopt, EmissionGuide::learn(5'000, 1, 0, is_aimed),
                          0.0};
  ListSettings settings;
  settings.emitted = 20'000;
  settings.guide = &guide;
  Moments received;
  size_t stored = 0;
  for (settings.pass = 0; settings.pass < 20; ++settings.pass) {
    double power = 0.0;
    for (const Photon& p : list_photons(scene, *make_distance_strategy({}), settings).surface) {
      power += p.power.g / static_cast<double>(settings.emitted);
      ++stored;
    }
    received.add(power);
  }
  expect_mean(received, 2.0 * kPiD * (1.0 - kCosine), kFalseAlarms);
  EXPECT_GT(stored, 20 * settings.emitted / 2);
}

/// In the corner that the camera looks into, the far one, half the photons know the power better.
TEST(GuidedPhotons, TellMoreOfWhatTheCameraSees) {
  const Scene scene = foggy_box();
  const size_t seen = (0 * kBoxes + 2) * kBoxes + 2;
  const Moments plain = tally(scene, {}, 2000, 100)[seen];
  const Moments guided = tally(scene, {.importons = 1000}, 1000, 100)[seen];
  EXPECT_LT(guided.variance(), 0.75 * plain.variance());
}

TEST(GuidedPhotons, KeepTheLedgerBalanced) {
  const Scene scene = foggy_box();
  const auto strategy = make_distance_strategy({});
  const PhotonGuide guide = learn_guide(scene, *strategy, {.importons = 2000}, 1, 0, 1000);
  ListSettings settings;
  settings.emitted = 50'000;
  settings.guide = &guide;
  settings.split = true;
  const Ledger ledger = list_photons(scene, *strategy, settings).ledger;
  expect_mean(ledger.imbalance, 0.0, kFalseAlarms);
  EXPECT_EQ(ledger.non_finite, 0u);
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

/// The power on the floor by glass alone, from photons that are aimed and from all photons.
TEST(Caustics, AimedPhotonsBringThePowerOfAll) {
  const Scene scene = small_ball();
  const auto strategy = make_distance_strategy({});
  constexpr uint64_t kAll = 400'000, kAimed = 8'000;
  Moments all, aimed;
  size_t of_all = 0, of_aimed = 0;
  for (uint64_t pass = 0; pass < 10; ++pass) {
    HitRecorder caustics(scene, caustic_photons(false, true), HitUse::other_map);
    trace_into(scene, {.pass = pass, .emitted = kAll}, {&caustics});
    double power = 0.0;
    for (const Photon& p : caustics.photons) {
      power += p.power.g / kAll;
      ++of_all;
    }
    all.add(power);
    power = 0.0;
    for (const Photon& p : trace_caustics(scene, *strategy, {.pass = pass, .emitted = kAimed})) {
      EXPECT_LT(std::abs(p.position.y), 1e-4f);
      power += p.power.g / kAimed;
      ++of_aimed;
    }
    aimed.add(power);
  }
  const double error = std::sqrt(all.variance_of_mean() + aimed.variance_of_mean());
  EXPECT_NEAR(aimed.mean(), all.mean(), 6.0 * error);  // of 20 passes together: false alarms below 1e-5
  EXPECT_GT(static_cast<double>(of_aimed) / kAimed, 20.0 * static_cast<double>(of_all) / kAll);
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
