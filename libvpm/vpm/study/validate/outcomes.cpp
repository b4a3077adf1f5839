// What becomes of a path at an event: roulette keeps the mean power, media and surfaces take their share of it, glass
// reflects as Fresnel's equations say.
#include <fmt/format.h>
#include <cmath>

#include "vpm/medium/make_grid.h"
#include "vpm/path/walk.h"
#include "vpm/scene/build.h"
#include "vpm/study/sample_moments.h"
#include "vpm/study/validate/groups.h"

namespace vpm {

namespace {

const Rgb kPower(1.0f, 0.3f, 2.0f);
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
        PathState state{{Vec3(0.0f), kTravel}, 0, kPower};
        if (!draw(state, rng)) return;
        for (int c = 0; c < 3; ++c) out[c] = state.throughput[c];
      });
  std::vector<Check> checks;
  for (size_t c = 0; c < 3; ++c) {
    const auto channel = static_cast<int>(c);
    checks.push_back(check_mean(name + kOfChannel[c], samples[c], double{kPower[channel]} * kept[channel]));
  }
  return checks;
}

std::vector<Check> check_collision(const Effort& effort) {
  Medium medium = make_medium(nullptr, Rgb(1.0f, 2.0f, 3.0f));
  const Rgb albedo(0.9f, 0.5f, 0.2f);
  medium.sigma_s = albedo * medium.sigma_t;
  return check_kept("collision", albedo, effort,
                    [&](PathState& state, Rng& rng) { return scatter_in_medium(medium, state, rng); });
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

}  // namespace vpm
