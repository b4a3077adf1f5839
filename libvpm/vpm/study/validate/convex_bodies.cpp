// Photons through convex bodies that absorb nothing, lit evenly: whatever the medium, they stay inside for 4 V/S on
// average [Blanco2003], collide 4 integral(sigma_t dV)/S times, and leave as evenly as they came.
#include <fmt/format.h>

#include "vpm/path/follow.h"
#include "vpm/study/careful_settings.h"
#include "vpm/study/sample_moments.h"
#include "vpm/study/validate/groups.h"
#include "vpm/study/validate/scenes/directions.h"
#include "vpm/study/validate/scenes/fields.h"
#include "vpm/study/validate/scenes/lit_body.h"

namespace vpm {

namespace {

constexpr size_t kEscapeRings = 6;

/// What is summed over a photon's way, for each channel.
enum Tally : size_t { length, collisions, escapes, tallies = escapes + kEscapeRings * kSectors };

/// The area that the lit box shows to a direction, over its mean, a quarter of the surface: what even light enters by.
double shown_share(const Box& lit, const Vec3& direction) {
  const Vec3d e(lit.extent()), faces(e.y * e.z, e.z * e.x, e.x * e.y);
  return 2.0 * glm::dot(glm::abs(Vec3d(direction)), faces) / (faces.x + faces.y + faces.z);
}

/// Adds up one photon's way. `hit_share` is the share of the photons that meet the body.
void follow(const LitBody& body, const DistanceStrategy& strategy, double hit_share, Rng& rng, double* out) {
  const Emission emission = emit(body.scene.lights[0], body.scene.bounds, rng);
  const Encounter entry = body.scene.geometry.encounter(emission.ray);
  Vec3 last = entry ? entry.hits[0].position : emission.ray.origin;
  WalkCounters counters;
  const auto see = [&](const Event& event, const PathState&, const PathState& now) {
    const double flown = entry ? glm::distance(Vec3d(last), Vec3d(now.ray.origin)) : 0.0;
    last = now.ray.origin;
    for (int c = 0; c < 3; ++c) {
      double* sums = out + static_cast<size_t>(c) * tallies;
      sums[length] += flown * now.throughput[c] / hit_share;
      if (event.kind == EventKind::collision) sums[collisions] += now.throughput[c] / hit_share;
      if (event.kind == EventKind::escape) {
        const size_t ring = cell_of(0.5 * away_from(Vec3(0.0f, 0.0f, 1.0f), now.ray.direction), kEscapeRings);
        sums[escapes + ring * kSectors + sector_about(Vec3(0.0f, 0.0f, 1.0f), now.ray.direction)] +=
            now.throughput[c] / shown_share(body.scene.bounds, now.ray.direction);
      }
    }
    return true;
  };
  follow({body.scene, strategy, counters}, {emission.ray, kVacuum, Rgb(1.0f)}, rng, PhotonVisitor{see});
}

void check_body(std::vector<Check>& checks, const LitBody& body, std::string_view strategy_name, const Effort& effort) {
  const Medium& medium = body.scene.media[0];
  const auto strategy = make_distance_strategy(careful_settings(strategy_name));
  const Vec3d lit(body.scene.bounds.extent());
  const double hit_share =
      0.5 * body.area / (lit.x * lit.y + lit.y * lit.z + lit.z * lit.x);  // of surfaces, as of mean projections
  const std::string name = fmt::format("{}, {}", body.name, strategy_name);
  const auto samples = sample_moments(3 * tallies, effort.count(40'000, 1'200'000), effort.seed_of(name),
                                      [&](Rng& rng, double* out) { follow(body, *strategy, hit_share, rng, out); });
  for (size_t c = 0; c < (medium.grey() ? 1 : 3); ++c) {
    const Moments* sums = samples.data() + c * tallies;
    const std::string channel = name + (medium.grey() ? "" : kOfChannel[c]);
    const double sigma_t = medium.sigma_t[static_cast<int>(c)] * body.mean_density;
    checks.push_back(check_weighted_mean(channel + ", path length", sums[length], 4.0 * body.volume / body.area));
    checks.push_back(
        check_weighted_mean(channel + ", collisions", sums[collisions], 4.0 * body.volume * sigma_t / body.area));
    checks.push_back(check_weights(channel + ", directions of escape", {sums + escapes, sums + tallies},
                                   std::vector<double>(kEscapeRings * kSectors, 1.0 / (kEscapeRings * kSectors))));
  }
}

std::vector<Check> check_bodies(const Effort& effort) {
  const auto fields = test_fields();
  const Rgb grey(1.5f);
  std::vector<Check> checks;
  check_body(checks, lit_sphere("sphere, isotropic", white_medium(nullptr, grey, Isotropic{})), "homogeneous", effort);
  check_body(checks, lit_sphere("sphere, g = 0.8", white_medium(nullptr, grey, HenyeyGreenstein{0.8f})), "regular",
             effort);
  check_body(checks, lit_box("box, Rayleigh", white_medium(nullptr, grey, Rayleigh{})), "homogeneous", effort);
  for (const size_t i : {size_t{1}, size_t{2}, size_t{5}})
    for (const StrategyInfo& info : distance_strategies())
      if (info.heterogeneous && info.positive)
        check_body(checks,
                   lit_box(fields[i].name, white_medium(fields[i].grid, tested_extinction(info, *fields[i].grid),
                                                        HenyeyGreenstein{-0.4f})),
                   info.name, effort);
  const Rgb colour(0.7f, 1.5f, 3.0f);
  check_body(checks, lit_box("random grid in colour", white_medium(fields[5].grid, colour, Isotropic{})), "regular",
             effort);
  return checks;
}

}  // namespace

std::vector<Experiment> convex_body_experiments() {
  return {{1, "convex bodies in even light: paths of 4 V/S", check_bodies}};
}

}  // namespace vpm
