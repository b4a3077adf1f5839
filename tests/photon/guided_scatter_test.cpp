// Scattering by a guide against scattering without, one event at a time.
#include "vpm/photon/guided_scatter.h"

#include <gtest/gtest.h>

#include "support/statistics.h"
#include "vpm/base/warp.h"
#include "vpm/medium/make_grid.h"
#include "vpm/scene/build.h"

namespace vpm {
namespace {

constexpr double kFalseAlarms = 1e-6;   // of each comparison: of all 600 below 1e-3
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
    const double after = alive ? sum_channels(state.throughput) : 0.0;
    const Vec2 u = uniform_sphere_numbers(state.ray.direction) * Vec2(kRows, kColumns);
    const int row = std::min(static_cast<int>(u.x), kRows - 1), column = std::min(static_cast<int>(u.y), kColumns - 1);
    for (int bin = 0; bin < kRows * kColumns; ++bin)
      result[static_cast<size_t>(bin)].add(bin == row * kColumns + column ? after : 0.0);
    result.back().add(after + absorbed - sum_channels(before));
  }
  return result;
}

TEST(GuidedScatter, OfMediaHasTheMeansOfTheirOwn) {
  const DirectionGuide guide = lopsided();
  const Ray ray{Vec3(0.1f), glm::normalize(Vec3(0.2f, -0.3f, 0.9f))};
  Medium fog = make_medium(nullptr, Rgb(1.0f));
  fog.sigma_s = Rgb(0.9f, 0.7f, 0.4f);
  const auto absorbed_in = [&](const PathState& state) {
    return sum_channels(state.throughput * (Rgb(1.0f) - fog.albedo()));
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
    expect_same_means(guided, plain, kFalseAlarms, "phase function " + std::to_string(phase.index()));
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
TEST(SlowGuidedScatter, OfSurfacesHasTheMeansOfTheirOwn) {
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
          const Rgb before = state.throughput;
          Scatter scatter;
          const bool alive = by ? scatter_at_surface(*by, scene, hit, state, rng, scatter)
                                : scatter_at_surface(scene, hit, state, rng, scatter);
          state.throughput *= scatter.flux_scale;
          absorbed = sum_channels(before * (Rgb(1.0f) - scatter.weight * scatter.flux_scale));
          return alive;
        });
      };
      const auto guided = trial(&guide), plain = trial(nullptr);
      const std::string what = "material " + std::to_string(material.index()) + (side > 0 ? " above" : " below");
      expect_same_means(guided, plain, kFalseAlarms, what);
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
    EXPECT_LE(state.throughput.g, 1.12f);
    powers.add(state.throughput.g);
  }
  expect_mean(powers, 1.0, kFalseAlarms);
}

}  // namespace
}  // namespace vpm
