// What becomes of a path at an event: roulette keeps the mean power, media and surfaces take their share of it, glass
// reflects as Fresnel's equations say.
#include <fmt/format.h>

#include <cmath>

#include "vpm/medium/grid/make_grid.h"
#include "vpm/path/walk.h"
#include "vpm/photon/guide/guided_scatter.h"
#include "vpm/scene/build.h"
#include "vpm/study/sample_moments.h"
#include "vpm/study/validate/groups.h"
#include "vpm/study/validate/scenes/directions.h"

namespace vpm {
namespace {

const Rgb kPowerBefore(1.0f, 0.3f, 2.0f);
const Vec3 kTravel = glm::normalize(Vec3(0.6f, -0.7f, 0.2f));

std::vector<Check> check_roulette(const Effort& effort) {
  std::vector<Check> checks;
  for (const float weight : {0.003f, 0.05f, 0.09f}) {
    const std::string name = fmt::format("roulette at weight {:.1g}", weight);
    const auto samples =
        sample_moments(1, effort.count(200'000, 10'000'000), effort.seed_of(name), [&](Rng& rng, double* out) {
          PathState state{{}, kVacuum, Rgb(weight)};
          if (survive_roulette(weight, state, rng)) out[0] = state.throughput.g;
        });
    checks.push_back(check_mean(name, samples[0], weight));
  }
  return checks;
}

/// The power that goes on, by channel, is `kept` times the power that came.
template <class Draw>
std::vector<Check> check_kept(const std::string& name, const Rgb& kept, const Effort& effort, Draw&& draw) {
  const auto samples =
      sample_moments(3, effort.count(40'000, 10'000'000), effort.seed_of(name), [&](Rng& rng, double* out) {
        PathState state{{Vec3(0.0f), kTravel}, 0, kPowerBefore};
        if (!draw(state, rng)) return;
        for (int c = 0; c < 3; ++c) out[c] = state.throughput[c];
      });
  std::vector<Check> checks;
  for (size_t c = 0; c < 3; ++c) {
    const auto channel = static_cast<int>(c);
    checks.push_back(check_mean(name + kOfChannel[c], samples[c], double{kPowerBefore[channel]} * kept[channel]));
  }
  return checks;
}

std::vector<Check> check_collision(const Effort& effort) {
  Medium medium = make_medium(nullptr, Rgb(1.0f, 2.0f, 3.0f));
  const Rgb albedo(0.9f, 0.5f, 0.2f);
  medium.sigma_s = albedo * medium.sigma_t;
  return check_kept("collision", albedo, effort, [&](PathState& state, Rng& rng) {
    return scatter_in_medium(medium.properties(state.ray.origin), state, rng);
  });
}

/// A plane of that material across y = -1, and where a path along kTravel meets it.
struct Plane {
  Scene scene;
  Hit hit;
};
Plane plane_of(const Material& material) {
  Plane plane;
  add_shape(plane.scene, quad_mesh(Vec3d(-9.0, -1.0, -9.0), Vec3d(0.0, 0.0, 18.0), Vec3d(18.0, 0.0, 0.0)), material);
  plane.scene.geometry.commit();
  plane.hit = plane.scene.geometry.encounter({Vec3(0.0f), kTravel}).hits[0];
  return plane;
}

std::vector<Check> check_walls(const Effort& effort) {
  std::vector<Check> checks;
  const Rgb reflectance(0.8f, 0.5f, 0.1f);
  for (const auto& [name, material] :
       {std::pair<const char*, Material>("diffuse wall", Lambertian{reflectance}), {"mirror", Mirror{reflectance}}}) {
    const Plane plane = plane_of(material);
    append(checks, check_kept(name, reflectance, effort, [&](PathState& state, Rng& rng) {
             Scatter scatter;
             return scatter_at_surface(plane.scene, plane.hit, state, rng, scatter);
           }));
  }
  return checks;
}

/// Fresnel's reflectance of unpolarised light by the angles of incidence and refraction [Pharr2023, sec. 9.3.5].
double reflectance_by_angles(double sine, double eta) {
  const double in = std::asin(sine), out = std::asin(sine / eta);
  const double across = std::sin(in - out) / std::sin(in + out), along = std::tan(in - out) / std::tan(in + out);
  return 0.5 * (across * across + along * along);
}

std::vector<Check> check_glass(const Effort& effort) {
  std::vector<Check> checks;
  for (const float ior : {1.5f, 1.0f / 1.3f}) {
    const Plane plane = plane_of(Dielectric{ior});
    const double sine = std::sqrt(1.0 - double{kTravel.y} * kTravel.y);
    const std::string name = fmt::format("glass of ior {:.3g}, ", ior);
    const auto samples =
        sample_moments(2, effort.count(40'000, 10'000'000), effort.seed_of(name), [&](Rng& rng, double* out) {
          PathState state{{Vec3(0.0f), kTravel}, kVacuum, Rgb(1.0f)};
          Scatter scatter;
          const bool alive = scatter_at_surface(plane.scene, plane.hit, state, rng, scatter);
          out[0] = alive && !scatter.transmitted ? state.throughput.g : 0.0;
          out[1] = alive ? state.throughput.g : 0.0;
        });
    checks.push_back(check_mean(name + "reflected", samples[0], reflectance_by_angles(sine, ior)));
    checks.push_back(check_bound(name + "in all", samples[1].mean(), 1.0, 0.0));
  }
  return checks;
}

}  // namespace

std::vector<Experiment> outcome_experiments() {
  return {{0, "outcomes of events", [](const Effort& effort) {
             std::vector<Check> checks = check_roulette(effort);
             append(checks, check_collision(effort));
             append(checks, check_walls(effort));
             append(checks, check_glass(effort));
             return checks;
           }}};
}

// Scattering by a guide that is far from what media and surfaces do by themselves: what goes on is still what they
// send on, and where they send it, and what goes on and what is absorbed make up what came.
namespace {

const Vec3 kFacing(0.0f, 0.0f, 1.0f);
constexpr size_t kGuideRings = 4;  // of directions, of equal solid angle about the z axis
constexpr size_t kGuideCells = kGuideRings * kSectors;
const Rgb kArrivingPower(1.0f, 0.6f, 0.3f);  // W

/// One cube that knows of some light along all directions and of much along a few.
DirectionGuide lopsided() {
  DirectionGuide guide({Vec3(-1.0f), Vec3(1.0f)}, 1);
  for (size_t cell = 0; cell < DirectionCells::kCount; ++cell)
    guide.add_track({Vec3(0.0f), -DirectionCells::sample(cell, Vec2(0.5f))}, 1.0f, cell % 29 == 3 ? 100.0f : 1.0f);
  guide.finish();
  return guide;
}

/// What an event makes of a photon, W.
struct Outcome {
  Rgb power{0.0f};     // that goes on
  Rgb absorbed{0.0f};  // by the event
  Vec3 direction{0.0f};
};

/// scatter(guide, rng) makes an event of kArrivingPower: by the guide as without one (a null pointer).
template <class ScatterOnce>
std::vector<Check> compare(const std::string& name, const DirectionGuide& guide, const Effort& effort,
                           const ScatterOnce& scatter) {
  const uint64_t count = effort.count(100'000, 2'000'000);
  const auto measure = [&](const DirectionGuide* by, uint64_t events) {
    const uint64_t seed = effort.seed_of(name + (by ? ", guided" : ", not guided"));
    return sample_moments(kGuideCells + 1, events, seed, [&](Rng& rng, double* out) {
      const Outcome after = scatter(by, rng);
      const double power = sum_channels(after.power);
      out[cell_of(0.5 * away_from(kFacing, after.direction), kGuideRings) * kSectors +
          sector_about(kFacing, after.direction)] = power;
      out[kGuideCells] = power + sum_channels(after.absorbed - kArrivingPower);
    });
  };
  // So many without a guide that their errors hardly count, which are not quite independent from cell to cell.
  const std::vector<Moments> guided = measure(&guide, count), plain = measure(nullptr, 10 * count);
  std::vector<Moments> cells;
  std::vector<double> means, errors;
  for (size_t i = 0; i < kGuideCells; ++i) {
    if (effective_sample_size(plain[i]) < kLeastSampleSize) continue;  // hardly anything goes there
    cells.push_back(guided[i]);
    means.push_back(plain[i].mean());
    errors.push_back(std::sqrt(plain[i].variance_of_mean()));
  }
  return {check_weights(name + ", power by direction", cells, means, errors),
          check_mean(name + ", power that goes on and is absorbed, less what came", guided[kGuideCells], 0.0)};
}

std::vector<Check> check_media(const DirectionGuide& guide, const Effort& effort) {
  const Ray ray{Vec3(0.1f), glm::normalize(Vec3(0.2f, -0.3f, 0.9f))};
  Medium fog = make_medium(nullptr, Rgb(1.0f));
  fog.sigma_s = Rgb(0.9f, 0.7f, 0.4f);
  std::vector<Check> checks;
  for (const auto& [name, phase] : {std::pair<const char*, Phase>("isotropic medium", Isotropic{}),
                                    {"Rayleigh", Rayleigh{}},
                                    {"Henyey-Greenstein, g = 0.6", HenyeyGreenstein{0.6f}}}) {
    fog.phase = phase;
    append(checks, compare(name, guide, effort, [&](const DirectionGuide* by, Rng& rng) {
             PathState state{ray, 0, kArrivingPower};
             const MediumProperties here = fog.properties(state.ray.origin);
             const bool alive = by ? scatter_in_medium(*by, here, state, rng) : scatter_in_medium(here, state, rng);
             return Outcome{alive ? state.throughput : Rgb(0.0f), kArrivingPower * (Rgb(1.0f) - fog.albedo()),
                            state.ray.direction};
           }));
  }
  return checks;
}

/// A level sheet of that material, shaded as if it leaned.
Scene sheet(const Material& material) {
  Scene scene;
  TriangleMesh mesh = quad_mesh(Vec3d(-1, -1, 0), Vec3d(2, 0, 0), Vec3d(0, 2, 0));
  mesh.normals.assign(mesh.positions.size(), Vec3(0.3f, 0.1f, 1.0f));
  add_shape(scene, mesh, material);
  scene.geometry.commit();
  return scene;
}

/// From both sides: light does not meet the same material from below.
std::vector<Check> check_surfaces(const DirectionGuide& guide, const Effort& effort) {
  std::vector<Check> checks;
  for (const auto& [name, material] :
       {std::pair<const char*, Material>("diffuse sheet", Lambertian{Rgb(0.8f, 0.5f, 0.3f)}),
        {"Phong", Phong{Rgb(0.4f, 0.3f, 0.2f), Rgb(0.3f, 0.4f, 0.5f), 20.0f}},
        {"rough metal", RoughConductor{Rgb(0.2f, 0.9f, 1.2f), Rgb(3.9f, 2.4f, 2.2f), 0.4f}},
        {"rough glass", RoughDielectric{1.5f, 0.4f}},
        {"mirror", Mirror{Rgb(0.9f)}}}) {
    const Scene scene = sheet(material);
    for (const float side : {1.0f, -1.0f}) {
      const Ray ray{Vec3(0.2f, -0.1f, side), glm::normalize(Vec3(-0.4f, 0.3f, -side))};
      const Encounter met = scene.geometry.encounter(ray, kInfinity);
      const std::string full = fmt::format("{} from {}", name, side > 0.0f ? "above" : "below");
      if (!met) {
        checks.push_back(check_bound(full + ", met by a ray", 0.0, 1.0, 0.0));
        continue;
      }
      append(checks, compare(full, guide, effort, [&](const DirectionGuide* by, Rng& rng) {
               PathState state{ray, kVacuum, kArrivingPower};
               Scatter scatter;
               const bool alive = by ? scatter_at_surface(*by, scene, met.hits[0], state, rng, scatter)
                                     : scatter_at_surface(scene, met.hits[0], state, rng, scatter);
               return Outcome{alive ? state.throughput * scatter.flux_scale : Rgb(0.0f),
                              kArrivingPower * (Rgb(1.0f) - scatter.weight * scatter.flux_scale), state.ray.direction};
             }));
    }
  }
  return checks;
}

}  // namespace

std::vector<Experiment> guide_experiments() {
  return {{0, "directions drawn by a guide", [](const Effort& effort) {
             const DirectionGuide guide = lopsided();
             std::vector<Check> checks = check_media(guide, effort);
             append(checks, check_surfaces(guide, effort));
             return checks;
           }}};
}

}  // namespace vpm
