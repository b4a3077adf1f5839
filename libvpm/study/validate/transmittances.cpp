// Transmittance: every estimator against the exact one, in all fields; and what marches of eye rays see through it.
#include <fmt/format.h>
#include <cmath>

#include "medium/make_grid.h"
#include "medium/transmittance/estimator.h"
#include "render/march.h"
#include "study/sample_moments.h"
#include "study/validate/fields.h"
#include "study/validate/groups.h"

namespace vpm {

namespace {

constexpr float kSigmaT = 1.2f;  // 1/m

/// Mean column -log(T)/sigma_t and mean transmittance. A quadrature with one random offset has the right mean column at
/// any step; its mean transmittance is too large by sigma_t^2 Var(column)/2 in the first place, so the check of that
/// one takes the bias for an error of its reference.
std::vector<Check> estimates_by(const EstimatorInfo& info, const Effort& effort) {
  std::vector<TestField> fields{{"homogeneous", nullptr}};
  for (TestField& field : test_fields()) fields.push_back(std::move(field));
  const Ray ray = test_ray();
  const Interval stretch = test_stretch();
  std::vector<Check> checks;
  for (const TestField& field : fields) {
    const Medium medium = make_medium(field.grid, Rgb(kSigmaT));
    const auto estimator = make_transmittance_estimator({.estimator = std::string(info.name), .step = 0.5f});
    const double column = looked_up_column(medium, ray, stretch.t0, stretch.t1);
    const std::string name = fmt::format("{}, {}", field.name, info.name);
    const auto samples =
        sample_moments(2, effort.count(10'000, 1'000'000), effort.seed_of(name), [&](Rng& rng, double* out) {
          const double value = estimator->estimate(medium, ray, stretch, rng).value.g;
          out[0] = value;
          out[1] = -std::log(value) / kSigmaT;
        });
    const double exact = std::exp(-kSigmaT * column);
    if (samples[0].variance() == 0.0) {
      checks.push_back(check_bound(name, samples[0].mean(), exact, 2e-6 * exact));
      continue;
    }
    const double bias = 0.5 * exact * kSigmaT * kSigmaT * samples[1].variance();
    checks.push_back(check_mean(name + ", column", samples[1], column, 1e-6 * column));
    checks.push_back(
        check_bound(name, samples[0].mean(), exact, bias + 5.0 * std::sqrt(samples[0].variance_of_mean())));
    checks.back().note = fmt::format("bound: its bias {:.1g}, and 5 standard errors", bias);
  }
  return checks;
}

/// A medium that glows the brighter the deeper a ray looks: a sixteenth of what arrives comes from beyond the depth
/// where the transmittance falls below 1 % and marches go on by roulette. It glows less than marches thin out, so that
/// what they bring has a variance.
std::vector<Check> check_march(const Effort& effort) {
  constexpr double kRise = 0.4, kDepth = 20.0;  // 1/m and m, where sigma_t is 1/m
  const Medium medium = make_medium(nullptr, Rgb(1.0f));
  const Ray ray{Vec3(0.0f), Vec3(0.0f, 0.0f, 1.0f)};
  const StepLimits limits{.length = kInfinity, .optical = 0.5f};
  const auto samples =
      sample_moments(1, effort.count(20'000, 2'000'000), effort.seed_of("march"), [&](Rng& rng, double* out) {
        Marcher().march(medium, ray, {0.0f, static_cast<float>(kDepth)}, limits, glm::bvec3(true), rng,
                        [&](const Vec3& point, const Rgb& weight) { out[0] += weight.g * std::exp(kRise * point.z); });
      });
  const double exact = -std::expm1((kRise - 1.0) * kDepth) / (1.0 - kRise);
  return {check_weighted_mean("light from deep inside", samples[0], exact)};
}

}  // namespace

std::vector<Experiment> transmittance_experiments() {
  std::vector<Experiment> all{{0, "marches of eye rays", check_march}};
  for (const EstimatorInfo& info : transmittance_estimators())
    all.push_back({0, fmt::format("transmittance, {}", info.name),
                   [&info](const Effort& effort) { return estimates_by(info, effort); }});
  return all;
}

}  // namespace vpm
