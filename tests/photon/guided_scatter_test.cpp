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

constexpr double kFalseAlarms = 1e-6;   // of each comparison: of all 600 below 1e-3
constexpr double kHole = 0.15;          // half the width of the hole between chambers, m
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

/// However wrong the guide.
TEST(GuidedScatter, MakesNoPhotonMuchHeavier) {
  DirectionGuide guide({Vec3(-1.0f), Vec3(1.0f)}, 1);
  guide.add_track({Vec3(0.0f), Vec3(0.0f, 0.0f, 1.0f)}, 1.0f, 1.0f);
  guide.finish();
  const Medium fog = make_medium(nullptr, Rgb(1.0f), 1.0f);
  Moments powers;
  for (uint64_t i = 0; i < 100'000; ++i) {
    Rng rng(1, rng_stream(RngUse::test, 50), i);
    PathState state{{Vec3(0.0f), Vec3(1.0f, 0.0f, 0.0f)}, 0, Rgb(1.0f)};
    ASSERT_TRUE(scatter_in_medium(guide, fog, state, rng));
    EXPECT_LE(state.power.g, 1.12f);
    powers.add(state.power.g);
  }
  expect_mean(powers, 1.0, kFalseAlarms);
}

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
  scene.camera = make_camera(Vec3(0.6f, 0.3f, 1.8f), Vec3(-0.6f, -0.6f, 1.2f), Vec3(0, 1, 0), 40.0f, 8, 8, {});
  finish(scene);
  scene.camera_medium = medium_at(scene, scene.camera.position);
}

/// Two chambers full of fog, a lamp in the one, a camera in the other, and a hole in the wall between them. Walls are
/// diffuse and glossy; a ball of rough metal hangs beside the lamp, one of glass behind the hole.
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

/// The chambers with walls that are almost black, and a lamp that shines away from the hole: what gets through was
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

constexpr size_t kBoxes = 8;            // 2 by 2 by 2, of photons behind the hole
constexpr size_t kBehind = 2 * kBoxes;  // in tally(): all of them
size_t box_of(const Vec3& p) { return (p.x > 0.0f ? 1u : 0u) + (p.y > 0.0f ? 2u : 0u) + (p.z > 1.0f ? 4u : 0u); }

PhotonGuide learned(const Scene& scene, const GuideSettings& settings) {
  return learn_guide(scene, *make_distance_strategy({}), settings, 1, 0, 1000);
}

TracedPhotons photons_of(const Scene& scene, const PhotonGuide* guide, bool split, uint64_t emitted, uint64_t pass) {
  TraceSettings settings;
  settings.pass = pass;
  settings.emitted = emitted;
  settings.volume_form = VolumeForm::density_at_photon;
  settings.guide = guide;
  settings.split = split;
  Progress silent("photons", 0, false);
  return trace_photons(scene, *make_distance_strategy({}), settings, silent);
}

/// By pass: the power behind the hole that collides in each box, then that which comes to surfaces there, both
/// together, and what media and surfaces absorb.
std::vector<Moments> tally(const Scene& scene, const PhotonGuide* guide, bool split, uint64_t emitted, int passes) {
  std::vector<Moments> result(2 * kBoxes + 3);
  for (int pass = 0; pass < passes; ++pass) {
    const uint64_t number = static_cast<uint64_t>(pass) + (guide ? 1000 : 0);
    const TracedPhotons photons = photons_of(scene, guide, split, emitted, number);
    std::vector<double> sums(result.size(), 0.0);
    for (const Photon& p : photons.volume[0])
      if (p.position.z > 0.0f) sums[box_of(p.position)] += sum_channels(p.power);
    for (const Photon& p : photons.surface)
      if (p.position.z > 0.0f) sums[kBoxes + box_of(p.position)] += sum_channels(p.power);
    for (size_t i = 0; i < 2 * kBoxes; ++i) sums[kBehind] += sums[i];
    const Rgbd media = photons.ledger.absorbed_in_media, surfaces = photons.ledger.absorbed_on_surfaces;
    sums[kBehind + 1] = media.r + media.g + media.b;
    sums[kBehind + 2] = surfaces.r + surfaces.g + surfaces.b;
    for (size_t i = 0; i < sums.size(); ++i) result[i].add(sums[i] / static_cast<double>(emitted));
  }
  return result;
}

TEST(PhotonsScatteredByAGuide, HaveTheMeansOfThoseThatAreNot) {
  const Scene scene = chambers();
  const PhotonGuide guide = learned(scene, {.importons = 20'000, .scatter = true});
  const std::vector<Moments> plain = tally(scene, nullptr, false, 12'000, 30);
  for (const bool split : {false, true})
    expect_same(tally(scene, &guide, split, 3000, 30), plain, split ? "split" : "not split");
}

/// Of as many photons, which are neither aimed nor split. Measured: GAIN.
TEST(PhotonsScatteredByAGuide, TellMoreOfWhatIsBehindAHole) {
  const Scene scene = dark_chambers();
  const PhotonGuide guide = learned(scene, {.importons = 50'000, .aim = false, .scatter = true});
  const Moments plain = tally(scene, nullptr, false, 5000, 400)[kBehind];
  const Moments guided = tally(scene, &guide, false, 5000, 400)[kBehind];
  RecordProperty("gain", std::to_string(plain.variance() / guided.variance()));
  std::printf("GAIN %.3g\n", plain.variance() / guided.variance());
  EXPECT_LT(guided.variance(), 0.7 * plain.variance());
}

TEST(PhotonsScatteredByAGuide, KeepTheLedgerBalanced) {
  const Scene scene = chambers();
  const PhotonGuide guide = learned(scene, {.importons = 20'000, .scatter = true});
  for (const bool split : {false, true}) {
    const Ledger ledger = photons_of(scene, &guide, split, 50'000, 0).ledger;
    expect_mean(ledger.imbalance, 0.0, kFalseAlarms);
    EXPECT_EQ(ledger.non_finite, 0u);
  }
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

}  // namespace
}  // namespace vpm
