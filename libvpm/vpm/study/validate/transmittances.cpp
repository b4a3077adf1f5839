// Transmittance: every estimator against the exact one, in all fields; and what marches of eye rays see through it.
#include <fmt/format.h>
#include <cmath>
#include <complex>
#include <optional>

#include "vpm/estimate/march.h"
#include "vpm/medium/grid/make_grid.h"
#include "vpm/medium/transmittance/estimator.h"
#include "vpm/study/sample_moments.h"
#include "vpm/study/validate/groups.h"
#include "vpm/study/validate/scenes/fields.h"

namespace vpm {

namespace {

constexpr float kStep = 2.0f;  // of the biased estimators, voxels

/// A medium, the part of the test's ray through it, and how many estimates a quick run makes there.
struct TestedEstimator {
  std::string name;
  Medium medium;
  Interval stretch = test_stretch();
  uint64_t quick = 10'000;
};

/// Every kind of field in three channels; one whose grid the ray enters and leaves; and one through which so little
/// light passes, in all channels, that tracking goes on by roulette.
std::vector<TestedEstimator> subjects() {
  const Rgb sigma_t(0.3f, 0.6f, 1.2f);  // 1/m
  std::vector<TestedEstimator> all{{"homogeneous", make_medium(nullptr, sigma_t)}};
  const std::vector<TestField> fields = test_fields();
  for (const TestField& field : fields) all.push_back({field.name, make_medium(field.grid, sigma_t)});
  all.push_back({"sparse grid from border to border", make_medium(fields[3].grid, sigma_t), {0.0f, 3.0f}, 100'000});
  all.push_back({"opaque", make_medium(fields[5].grid, Rgb(7.0f, 6.5f, 6.0f)), test_stretch(), 100'000});
  return all;
}

/// The steps of a march over the part of the stretch where there is a medium.
struct Steps {
  const Medium& medium;
  Ray ray = test_ray();
  Interval stretch;
  int count;
  double length;  // m

  Steps(const TestedEstimator& subject, double step)
      : medium(subject.medium),
        stretch(medium.clip(ray, subject.stretch)),
        count(medium.homogeneous() ? 1 : static_cast<int>(std::ceil(stretch.length() / (step * medium.voxel_size())))),
        length(stretch.length() / static_cast<double>(count)) {}
  /// The density integral that the density at a share of step number i stands for, m.
  double integral(int i, double share) const {
    return length * medium.density(ray.at(static_cast<float>(stretch.t0 + (i + share) * length)));
  }
};

constexpr int kPlaces = 20000;  // of the midpoint rule in a step
double place(int k) { return (k + 0.5) / kPlaces; }

/// The mean of exp(-density integral) where all steps have the same offset.
double mean_of_march(const Steps& steps, double sigma_t) {
  double mean = 0.0;
  for (int k = 0; k < kPlaces; ++k) {
    double integral = 0.0;
    for (int i = 0; i < steps.count; ++i) integral += steps.integral(i, place(k));
    mean += std::exp(-sigma_t * integral) / kPlaces;
  }
  return mean;
}

/// The mean of exp(-(X + Y) / 2) cos((X - Y) / 2) of two independent marches X, Y with an offset for each step:
/// |E exp(-(1 + i) X / 2)|^2, a product over steps.
double mean_of_jackknife(const Steps& steps, double sigma_t) {
  double mean = 1.0;
  for (int i = 0; i < steps.count; ++i) {
    std::complex<double> of_step = 0.0;
    for (int k = 0; k < kPlaces; ++k)
      of_step += std::exp(std::complex(-0.5, -0.5) * sigma_t * steps.integral(i, place(k))) / double{kPlaces};
    mean *= std::norm(of_step);
  }
  return mean;
}

/// The exact mean of an estimator that is biased, its bias included.
std::optional<double> biased_mean(std::string_view estimator, const TestedEstimator& subject, int channel) {
  const Steps steps(subject, kStep);
  if (estimator == "ray-march") return mean_of_march(steps, subject.medium.sigma_t[channel]);
  if (estimator == "jackknife") return mean_of_jackknife(steps, subject.medium.sigma_t[channel]);
  return std::nullopt;
}

/// Estimates without noise must have the mean to rounding, others within their errors.
Check check_estimates(const std::string& name, const Moments& samples, std::optional<double> mean, bool unbiased) {
  if (!mean) return not_determined(name, samples.mean(), 0.0, "the mean of this biased estimator is not known");
  const double rounding = 2e-6 * *mean, quadrature = unbiased ? 0.0 : 1e-4 * *mean;
  if (std::sqrt(samples.variance()) < rounding) return check_bound(name, samples.mean(), *mean, rounding);
  const double size = effective_sample_size(samples);
  if (size < kLeastSampleSize)
    return not_determined(name, samples.mean(), *mean, fmt::format("effective sample size {:.0f}", size));
  return check_mean(name, samples, *mean, rounding + quadrature);
}

/// Means of the transmittance: the exact one, and where the estimator is biased the mean that it must have then.
std::vector<Check> estimates_by(const EstimatorInfo& info, float comb, const Effort& effort) {
  const Ray ray = test_ray();
  const auto estimator = make_transmittance_estimator(
      {std::string(info.name), among(info.parameters, {{"step", kStep}, {"samples", comb}})});
  std::vector<Check> checks;
  for (const TestedEstimator& subject : subjects()) {
    const Medium& medium = subject.medium;
    const double integral = looked_up_integral(medium, ray, subject.stretch.t0, subject.stretch.t1);
    const std::string name =
        fmt::format("{}, {}{}", subject.name, info.name, comb == 1.0f ? "" : ", combs twice as dense");
    const auto samples =
        sample_moments(3, effort.count(subject.quick, 1'000'000), effort.seed_of(name), [&](Rng& rng, double* out) {
          const Rgb value = estimator->estimate(medium, ray, subject.stretch, rng).value;
          for (int c = 0; c < 3; ++c) out[c] = value[c];
        });
    for (int c = 0; c < (medium.grey() ? 1 : 3); ++c) {
      const double exact = std::exp(-medium.sigma_t[c] * integral);
      const std::optional<double> mean = info.unbiased ? exact : biased_mean(info.name, subject, c);
      Check check = check_estimates(name + (medium.grey() ? "" : kOfChannel[c]), samples[c], mean, info.unbiased);
      if (mean && !info.unbiased) check.note = fmt::format("with its bias, {:+.2g}", *mean - exact);
      checks.push_back(std::move(check));
    }
  }
  return checks;
}

/// A medium that glows the brighter the deeper a ray looks: a sixteenth of what arrives comes from beyond the depth
/// where the transmittance falls below 1 % and marches go on by roulette. It glows less than marches thin out, so that
/// what they bring has a variance.
std::vector<Check> check_march(const Effort& effort) {
  constexpr double kRise = 0.4, kLength = 20.0;  // 1/m and m, where sigma_t is 1/m
  const Medium medium = make_medium(nullptr, Rgb(1.0f));
  const Ray ray{Vec3(0.0f), Vec3(0.0f, 0.0f, 1.0f)};
  const StepLimits limits{.length = kInfinity, .optical = 0.5f};
  const auto samples =
      sample_moments(1, effort.count(20'000, 2'000'000), effort.seed_of("march"), [&](Rng& rng, double* out) {
        Marcher().march(medium, ray, {0.0f, static_cast<float>(kLength)}, limits, rng,
                        [&](const Vec3& point, const Rgb& weight) { out[0] += weight.g * std::exp(kRise * point.z); });
      });
  const double exact = -std::expm1((kRise - 1.0) * kLength) / (1.0 - kRise);
  return {check_weighted_mean("light from deep inside", samples[0], exact)};
}

}  // namespace

std::vector<Experiment> transmittance_experiments() {
  std::vector<Experiment> all{{0, "marches of eye rays", check_march}};
  for (const EstimatorInfo& info : transmittance_estimators())
    all.push_back({0, fmt::format("transmittance, {}", info.name), [&info](const Effort& effort) {
                     std::vector<Check> checks = estimates_by(info, 1.0f, effort);
                     if (info.name == "unbiased-ray-march") append(checks, estimates_by(info, 2.0f, effort));
                     return checks;
                   }});
  return all;
}

}  // namespace vpm
