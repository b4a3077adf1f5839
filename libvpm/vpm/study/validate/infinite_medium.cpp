// Photons in an endless medium: how often they collide, where the n-th collision is, where they are absorbed.
//
// Flights are independent of directions, with means 1/sigma_t and 2/sigma_t^2; the cosine between the directions of
// flights i and j has the mean g^(j-i), the square of the cosine to the first direction of flight i the mean
// (1 + 2 h^(i-1))/3, where h is the second Legendre moment of the phase function. That gives all means below.
#include <fmt/format.h>
#include <array>

#include "vpm/medium/grid/make_grid.h"
#include "vpm/path/follow.h"
#include "vpm/study/careful_settings.h"
#include "vpm/study/sample_moments.h"
#include "vpm/study/validate/groups.h"

namespace vpm {

namespace {

const Vec3 kStart = glm::normalize(Vec3(0.4f, -0.5f, 0.7f));

Scene endless(const Medium& medium) {
  Scene scene;
  scene.media.push_back(medium);
  scene.world_medium = 0;
  scene.geometry.commit();
  return scene;
}

/// Follows a photon from the origin and calls see(const PathState&) at every event.
template <class See>
void walk(const Scene& scene, const DistanceStrategy& strategy, int events, Rng& rng, See&& see) {
  WalkCounters counters;
  const auto visit = [&](const Event&, const PathState&, const PathState& at) {
    see(at);
    return true;
  };
  follow({scene, strategy, counters, events}, {{Vec3(0.0f), kStart}, 0, Rgb(1.0f)}, rng, PhotonVisitor{visit});
}

/// Every strategy for photons, in grey and in colour: 1/(1 - albedo) collisions on average.
std::vector<Check> check_counts(const Effort& effort) {
  std::vector<Check> checks;
  for (const bool grey : {true, false}) {
    Medium medium = make_medium(nullptr, grey ? Rgb(2.0f) : Rgb(1.0f, 2.0f, 3.0f));
    medium.sigma_s = (grey ? Rgb(0.8f) : Rgb(0.6f, 0.8f, 0.7f)) * medium.sigma_t;
    medium.phase = HenyeyGreenstein{0.5f};
    const Scene scene = endless(medium);
    for (const StrategyInfo& info : distance_strategies()) {
      if (!info.positive) continue;
      const auto strategy = make_distance_strategy(careful_settings(info.name));
      const std::string name = fmt::format("{}, {}", grey ? "grey" : "colour", info.name);
      const auto samples =
          sample_moments(3, effort.count(20'000, 5'000'000), effort.seed_of(name), [&](Rng& rng, double* out) {
            walk(scene, *strategy, kNoEventLimit, rng, [&](const PathState& now) {
              for (int c = 0; c < 3; ++c) out[c] += now.throughput[c];
            });
          });
      const Rgb albedo = medium.albedo();
      for (int c = 0; c < (grey ? 1 : 3); ++c)
        checks.push_back(check_weighted_mean(name + (grey ? "" : kOfChannel[static_cast<size_t>(c)]),
                                             samples[static_cast<size_t>(c)], 1.0 / (1.0 - albedo[c])));
    }
  }
  return checks;
}

struct NamedPhase {
  const char* name;
  Phase phase;
  double g, h;  // first and second Legendre moment
};

/// The position of the n-th collision.
std::vector<Check> check_positions(const Effort& effort) {
  constexpr float kSigmaT = 2.0f;
  constexpr std::array<int, 3> kCollisions{2, 4, 10};
  std::vector<Check> checks;
  for (const NamedPhase& named :
       {NamedPhase{"isotropic", Isotropic{}, 0.0, 0.0}, NamedPhase{"Rayleigh", Rayleigh{}, 0.0, 0.1},
        NamedPhase{"g = 0.8", HenyeyGreenstein{0.8f}, 0.8, 0.64},
        NamedPhase{"g = -0.5", HenyeyGreenstein{-0.5f}, -0.5, 0.25}}) {
    Medium medium = make_medium(nullptr, Rgb(kSigmaT), 1.0f);
    medium.phase = named.phase;
    const Scene scene = endless(medium);
    const auto strategy = make_distance_strategy({});
    const auto samples =
        sample_moments(3 * kCollisions.size(), effort.count(40'000, 5'000'000),
                       effort.seed_of(std::string("positions, ") + named.name), [&](Rng& rng, double* out) {
                         int collision = 0;
                         walk(scene, *strategy, kCollisions.back(), rng, [&](const PathState& now) {
                           ++collision;
                           for (size_t i = 0; i < kCollisions.size(); ++i) {
                             if (collision != kCollisions[i]) continue;
                             const double along = glm::dot(Vec3d(now.ray.origin), Vec3d(kStart));
                             out[3 * i] = along;
                             out[3 * i + 1] = along * along;
                             out[3 * i + 2] = glm::dot(Vec3d(now.ray.origin), Vec3d(now.ray.origin));
                           }
                         });
                       });
    for (size_t i = 0; i < kCollisions.size(); ++i) {
      const int n = kCollisions[i];
      double forward = 0.0, squares = 0.0, forward_squares = 0.0;
      for (int j = 0; j < n; ++j) {
        double following = 0.0;  // sum of g^k over the flights from j on
        for (int k = 0; k < n - j; ++k) following += std::pow(named.g, k);
        forward += std::pow(named.g, j) / kSigmaT;
        squares += 2.0 / (kSigmaT * kSigmaT) * following;
        forward_squares += 2.0 / (kSigmaT * kSigmaT) * following * (1.0 + 2.0 * std::pow(named.h, j)) / 3.0;
      }
      const std::string name = fmt::format("{}, collision {}, mean ", named.name, n);
      checks.push_back(check_mean(name + "z", samples[3 * i], forward));
      checks.push_back(check_mean(name + "z^2", samples[3 * i + 1], forward_squares));
      checks.push_back(check_mean(name + "r^2", samples[3 * i + 2], squares));
    }
  }
  return checks;
}

/// The place where a photon is absorbed has the mean square distance 2/(sigma_a (sigma_a + sigma_s (1 - g))).
std::vector<Check> check_absorption(const Effort& effort) {
  std::vector<Check> checks;
  for (const float g : {-0.5f, 0.0f, 0.85f}) {
    constexpr double kSigmaA = 0.5, kSigmaS = 1.5;
    Medium medium = make_medium(nullptr, Rgb(static_cast<float>(kSigmaA + kSigmaS)));
    medium.sigma_s = Rgb(static_cast<float>(kSigmaS));
    medium.phase = HenyeyGreenstein{g};
    const Scene scene = endless(medium);
    const auto strategy = make_distance_strategy({});
    const std::string name = fmt::format("g = {:.2g}, absorbed at mean r^2", g);
    const auto samples =
        sample_moments(1, effort.count(40'000, 5'000'000), effort.seed_of(name), [&](Rng& rng, double* out) {
          walk(scene, *strategy, kNoEventLimit, rng, [&](const PathState& now) {
            out[0] = glm::dot(Vec3d(now.ray.origin), Vec3d(now.ray.origin));  // the last one stays
          });
        });
    checks.push_back(check_mean(name, samples[0], 2.0 / (kSigmaA * (kSigmaA + kSigmaS * (1.0 - double{g})))));
  }
  return checks;
}

}  // namespace

std::vector<Experiment> infinite_medium_experiments() {
  return {{1, "endless medium: collisions of a photon", check_counts},
          {1, "endless medium: where collisions are", check_positions},
          {1, "endless medium: where photons end", check_absorption}};
}

}  // namespace vpm
