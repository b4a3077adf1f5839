// Scattering by a guide against scattering without: one event at a time, then photons on their way through a hole.
#include "photon/guided_scatter.h"

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "base/warp.h"
#include "medium/make_grid.h"
#include "photon/trace.h"
#include "scene/build.h"
#include "support/statistics.h"

namespace vpm {
namespace {

constexpr double kFalseAlarms = 1e-6;   // of each comparison: there are about 600 in this file
constexpr int kRows = 4, kColumns = 6;  // bins of directions

/// One cube that knows of some light along all directions, and of much along two narrow beams.
DirectionGuide lopsided() {
  DirectionGuide guide({Vec3(-1.0f), Vec3(1.0f)}, 1);
  Rng rng(1, rng_stream(RngUse::test, 0), 0);
  for (int i = 0; i < 500; ++i) guide.add_track({Vec3(0.0f), uniform_sphere(rng.uniform2())}, 1.0f, 1.0f);
  guide.add_track({Vec3(0.0f), -glm::normalize(Vec3(0.8f, 0.1f, 0.5f))}, 1.0f, 300.0f);
  guide.add_track({Vec3(0.0f), -glm::normalize(Vec3(-0.2f, 0.7f, -0.5f))}, 1.0f, 300.0f);
  guide.finish();
  return guide;
}

/// What goes on into bins of directions, after one event that `scatter` makes of the state; the last value is what is
/// gained by it, with what `scatter` says is absorbed.
template <class ScatterOnce>
std::vector<Moments> by_direction(const Ray& ray, uint64_t stream, const ScatterOnce& scatter) {
  std::vector<Moments> result(size_t{kRows} * kColumns + 1);
  const Rgb before(1.0f, 0.6f, 0.3f);
  for (uint64_t i = 0; i < 100'000; ++i) {
    Rng rng(1, rng_stream(RngUse::test, stream), i);
    PathState state{ray, kVacuum, before};
    double absorbed = 0.0;
    const bool alive = scatter(state, rng, absorbed);
    const double after = alive ? sum_channels(state.power) : 0.0;
    const Vec2 u = uniform_sphere_numbers(state.ray.direction) * Vec2(kRows, kColumns);
    const int row = std::min(static_cast<int>(u.x), kRows - 1), column = std::min(static_cast<int>(u.y), kColumns - 1);
    for (int bin = 0; bin < kRows * kColumns; ++bin)
      result[static_cast<size_t>(bin)].add(bin == row * kColumns + column ? after : 0.0);
    result.back().add(after + absorbed - sum_channels(before));
  }
  return result;
}

void expect_same(const std::vector<Moments>& guided, const std::vector<Moments>& plain, const std::string& what) {
  for (size_t i = 0; i < plain.size(); ++i) {
    if (plain[i].variance() == 0.0 && guided[i].variance() == 0.0) {
      EXPECT_EQ(plain[i].mean(), guided[i].mean()) << what << ", value " << i;
      continue;
    }
    const Check check = check_same("", guided[i], plain[i]);
    EXPECT_GE(check.p, kFalseAlarms) << what << ", value " << i << ": " << guided[i].mean() << " against "
                                     << plain[i].mean() << " +- " << check.error;
  }
}

TEST(GuidedScatter, OfMediaHasTheMeansOfTheirOwn) {
  const DirectionGuide guide = lopsided();
  const Ray ray{Vec3(0.1f), glm::normalize(Vec3(0.2f, -0.3f, 0.9f))};
  Medium fog = make_medium(nullptr, Rgb(1.0f));
  fog.sigma_s = Rgb(0.9f, 0.7f, 0.4f);
  const auto absorbed_in = [&](const PathState& state) {
    return sum_channels(state.power * (Rgb(1.0f) - fog.albedo()));
  };
  uint64_t stream = 1;
  for (const Phase& phase : {Phase(Isotropic{}), Phase(HenyeyGreenstein{0.6f}), Phase(Rayleigh{})}) {
    fog.phase = phase;
    const auto guided = by_direction(ray, stream++, [&](PathState& state, Rng& rng, double& absorbed) {
      absorbed = absorbed_in(state);
      return scatter_in_medium(guide, fog, state, rng);
    });
    const auto plain = by_direction(ray, stream++, [&](PathState& state, Rng& rng, double& absorbed) {
      absorbed = absorbed_in(state);
      return scatter_in_medium(fog, state, rng);
    });
    expect_same(guided, plain, "phase function " + std::to_string(phase.index()));
    expect_mean(guided.back(), 0.0, kFalseAlarms, "balance");
  }
}

/// A sheet of that material in the plane z = 0 whose shading normals lean.
Scene sheet(const Material& material) {
  Scene scene;
  TriangleMesh mesh{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  mesh.normals.assign(4, Vec3(0.3f, 0.1f, 1.0f));
  add_shape(scene, mesh, material);
  scene.geometry.commit();
  return scene;
}

/// From both sides, as light does not meet the same material from below.
TEST(GuidedScatter, OfSurfacesHasTheMeansOfTheirOwn) {
  const DirectionGuide guide = lopsided();
  const std::vector<Material> materials{Lambertian{Rgb(0.8f, 0.5f, 0.3f)},
                                        Phong{Rgb(0.4f, 0.3f, 0.2f), Rgb(0.3f, 0.4f, 0.5f), 20.0f},
                                        RoughConductor{Rgb(0.2f, 0.9f, 1.2f), Rgb(3.9f, 2.4f, 2.2f), 0.4f},
                                        RoughDielectric{1.5f, 0.4f}, Mirror{Rgb(0.9f)}};
  uint64_t stream = 100;
  for (const Material& material : materials) {
    const Scene scene = sheet(material);
    for (const float side : {1.0f, -1.0f}) {
      const Ray ray{Vec3(0.2f, -0.1f, side), glm::normalize(Vec3(-0.4f, 0.3f, -side))};
      const Encounter met = scene.geometry.encounter(ray, kInfinity);
      ASSERT_TRUE(met);
      const Hit& hit = met.hits[0];
      const auto trial = [&](const DirectionGuide* by) {
        return by_direction(ray, stream++, [&, by](PathState& state, Rng& rng, double& absorbed) {
          const Rgb before = state.power;
          Scatter scatter;
          const bool alive = by ? scatter_at_surface(*by, scene, hit, state, rng, scatter)
                                : scatter_at_surface(scene, hit, state, rng, scatter);
          state.power *= scatter.flux_scale;
          absorbed = sum_channels(before * (Rgb(1.0f) - scatter.weight * scatter.flux_scale));
          return alive;
        });
      };
      const auto guided = trial(&guide), plain = trial(nullptr);
      const std::string what = "material " + std::to_string(material.index()) + (side > 0 ? " above" : " below");
      expect_same(guided, plain, what);
      if (guided.back().variance() > 0.0) expect_mean(guided.back(), 0.0, kFalseAlarms, what.c_str());
    }
  }
}

/// However wrong the guide, no photon more than doubles.
TEST(GuidedScatter, AtMostDoublesPowers) {
  DirectionGuide guide({Vec3(-1.0f), Vec3(1.0f)}, 1);
  guide.add_track({Vec3(0.0f), Vec3(0.0f, 0.0f, 1.0f)}, 1.0f, 1.0f);
  guide.finish();
  const Medium fog = make_medium(nullptr, Rgb(1.0f), 1.0f);
  Moments powers;
  for (uint64_t i = 0; i < 10'000; ++i) {
    Rng rng(1, rng_stream(RngUse::test, 50), i);
    PathState state{{Vec3(0.0f), Vec3(1.0f, 0.0f, 0.0f)}, 0, Rgb(1.0f)};
    ASSERT_TRUE(scatter_in_medium(guide, fog, state, rng));
    EXPECT_LE(state.power.g, 2.0f);
    powers.add(state.power.g);
  }
  expect_mean(powers, 1.0, kFalseAlarms);
}

/// Two chambers full of fog and a hole between them: a lamp in the one, a camera in the other. Their walls are diffuse
/// and glossy; a ball of rough metal hangs beside the lamp, one of glass behind the hole.
Scene chambers() {
  Scene scene;
  Medium fog = make_medium(nullptr, Rgb(0.3f, 0.4f, 0.6f));
  fog.sigma_s = Rgb(0.28f, 0.36f, 0.4f);
  fog.phase = HenyeyGreenstein{0.4f};
  scene.media.push_back(fog);
  const Interface inside{0, kVacuum}, around{kVacuum, 0};
  add_shape(scene, box_mesh(Vec3d(-1, -1, -2), Vec3d(1, 1, 2)), Lambertian{Rgb(0.6f, 0.5f, 0.4f)}, &inside);
  const Phong wall{Rgb(0.3f), Rgb(0.3f, 0.2f, 0.2f), 15.0f};
  add_shape(scene, box_mesh(Vec3d(-0.99, -0.99, -0.05), Vec3d(-0.2, 0.99, 0.05)), wall);
  add_shape(scene, box_mesh(Vec3d(0.2, -0.99, -0.05), Vec3d(0.99, 0.99, 0.05)), wall);
  add_shape(scene, box_mesh(Vec3d(-0.2, -0.99, -0.05), Vec3d(0.2, -0.2, 0.05)), wall);
  add_shape(scene, box_mesh(Vec3d(-0.2, 0.2, -0.05), Vec3d(0.2, 0.99, 0.05)), wall);
  const RoughConductor metal{Rgb(0.2f, 0.9f, 1.2f), Rgb(3.9f, 2.4f, 2.2f), 0.3f};
  add_shape(scene, SphereShape{Vec3(-0.5f, -0.5f, -1.2f), 0.3f}, metal);
  add_shape(scene, SphereShape{Vec3(0.1f, -0.5f, 0.6f), 0.25f}, Dielectric{1.5f}, &around);
  scene.lights.push_back(PointLight{Vec3(0.6f, 0.5f, -1.6f), Rgb(1.0f)});
  scene.geometry.commit();
  scene.camera = make_camera(Vec3(0.6f, 0.3f, 1.8f), Vec3(-0.6f, -0.6f, 1.2f), Vec3(0, 1, 0), 40.0f, 8, 8, {});
  finish(scene);
  scene.camera_medium = medium_at(scene, scene.camera.position);
  return scene;
}

constexpr int kBoxes = 8;  // 2 by 2 by 2, of photons behind the hole
size_t box_of(const Vec3& p) { return (p.x > 0.0f ? 1u : 0u) + (p.y > 0.0f ? 2u : 0u) + (p.z > 1.0f ? 4u : 0u); }

TracedPhotons photons_of(const Scene& scene, const GuideSettings& guided, uint64_t emitted, uint64_t pass) {
  const auto strategy = make_distance_strategy({});
  TraceSettings settings;
  settings.pass = pass;
  settings.emitted = emitted;
  settings.volume_form = VolumeForm::density_at_photon;
  std::optional<PhotonGuide> guide;
  if (guided.importons > 0) {
    guide = learn_guide(scene, *strategy, guided, settings.seed, pass, 1000);
    settings.guide = &*guide;
    settings.split = guided.split;
  }
  Progress silent("photons", 0, false);
  return trace_photons(scene, *strategy, settings, silent);
}

/// By pass: the power behind the hole that collides in each box, then that which comes to surfaces there, and what
/// media and surfaces absorb.
std::vector<Moments> tally(const Scene& scene, const GuideSettings& guided, uint64_t emitted, int passes) {
  std::vector<Moments> result(2 * kBoxes + 2);
  for (int pass = 0; pass < passes; ++pass) {
    const uint64_t number = static_cast<uint64_t>(pass) + (guided.importons > 0 ? 1000 : 0);
    const TracedPhotons photons = photons_of(scene, guided, emitted, number);
    std::vector<double> sums(result.size(), 0.0);
    for (const Photon& p : photons.volume[0])
      if (p.position.z > 0.0f) sums[box_of(p.position)] += sum_channels(p.power);
    for (const Photon& p : photons.surface)
      if (p.position.z > 0.0f) sums[kBoxes + box_of(p.position)] += sum_channels(p.power);
    const Rgbd media = photons.ledger.absorbed_in_media, surfaces = photons.ledger.absorbed_on_surfaces;
    sums[2 * kBoxes] = media.r + media.g + media.b;
    sums[2 * kBoxes + 1] = surfaces.r + surfaces.g + surfaces.b;
    for (size_t i = 0; i < sums.size(); ++i) result[i].add(sums[i] / static_cast<double>(emitted));
  }
  return result;
}

TEST(PhotonsScatteredByAGuide, HaveTheMeansOfThoseThatAreNot) {
  const Scene scene = chambers();
  const std::vector<Moments> plain = tally(scene, {}, 12'000, 30);
  for (const bool split : {false, true})
    expect_same(tally(scene, {.importons = 2000, .split = split, .scatter = true}, 3000, 30), plain,
                split ? "split" : "not split");
}

/// Beside aiming and splitting, with as many photons, where the camera looks.
TEST(PhotonsScatteredByAGuide, TellMoreOfWhatIsBehindAHole) {
  const Scene scene = chambers();
  const size_t seen = box_of(Vec3(-0.5f, -0.5f, 1.5f));
  const std::vector<Moments> plain = tally(scene, {.importons = 3000}, 1500, 100);
  const std::vector<Moments> guided = tally(scene, {.importons = 3000, .scatter = true}, 1500, 100);
  for (const size_t i : {seen, kBoxes + seen}) {
    RecordProperty("gain" + std::to_string(i), std::to_string(plain[i].variance() / guided[i].variance()));
    EXPECT_LT(guided[i].variance(), 0.75 * plain[i].variance());
  }
}

TEST(PhotonsScatteredByAGuide, KeepTheLedgerBalanced) {
  const Ledger ledger = photons_of(chambers(), {.importons = 3000, .scatter = true}, 50'000, 0).ledger;
  expect_mean(ledger.imbalance, 0.0, kFalseAlarms);
  EXPECT_EQ(ledger.non_finite, 0u);
}

TEST(PhotonsScatteredByAGuide, AreTheSameOnAnyNumberOfThreads) {
  const Scene scene = chambers();
  const GuideSettings guided{.importons = 10'000, .scatter = true};
  set_threads(1);
  const TracedPhotons alone = photons_of(scene, guided, 10'000, 0);
  set_threads(2);
  const TracedPhotons together = photons_of(scene, guided, 10'000, 0);
  set_threads(0);
  ASSERT_EQ(alone.surface.size(), together.surface.size());
  for (size_t i = 0; i < alone.surface.size(); ++i) {
    ASSERT_EQ(alone.surface[i].position, together.surface[i].position);
    ASSERT_EQ(alone.surface[i].power, together.surface[i].power);
  }
}

}  // namespace
}  // namespace vpm
