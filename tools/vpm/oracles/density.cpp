// S6: kernels, k nearest and fixed-radius estimates, their bias, and progressive radii.
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "oracles/cases.h"
#include "vpm/estimate/radius_schedule.h"
#include "vpm/study/estimates/density.h"

namespace vpm::tools {
namespace {

/// The kernel of that name; none where the framework has no such kernel.
std::optional<KernelKind> kernel_named(const std::string& name) {
  if (name == "biweight_simpson") return KernelKind::biweight;
  for (const KernelInfo& kernel : kKernels)
    if (kernel.name == name) return kernel.kind;
  return std::nullopt;
}

CaseResult no_kernel(const std::string& name) {
  CaseResult result;
  result.unchecked = "the framework has no kernel \"" + name + "\"";
  return result;
}

int read_dimension(const OracleCase& c) {
  const double d = c.number_in("dimension", 1.0, 3.0);
  if (d != std::floor(d)) c.refuse("\"dimension\" must be a whole number");
  return static_cast<int>(d);
}

CaseResult run_kernel(const OracleCase& c, const Effort&) {
  const std::optional<KernelKind> kernel = kernel_named(c.text("kernel"));
  if (!kernel) return no_kernel(c.text("kernel"));
  const int d = read_dimension(c);
  const KernelIntegrals sums = integrate_kernel(d, *kernel);
  CaseResult result;
  const auto check = [&](const char* field, double found) {
    const double exact = c.number(field);
    result.checks.push_back(check_bound(field, found, exact, 1e-6 * std::abs(exact)));
  };
  check("mean_one_factor_value", sums.volume / sums.profile);
  check("roughness_m2_value", sums.square * sums.volume / (sums.profile * sums.profile));
  check("laplacian_bias_value", sums.second_moment / sums.profile / (2.0 * d));
  check("unit_integral_prefactor", d == 1   ? kernel_norm_1d(*kernel, 1.0f)
                                   : d == 2 ? kernel_norm_2d(*kernel, 1.0f)
                                            : kernel_norm_3d(*kernel, 1.0f));
  return result;
}

/// The volume of the ball or disc that holds the k nearest is distributed as it must be.
Check check_volumes(const std::string& name, const std::vector<double>& volumes, uint32_t k, uint64_t n) {
  constexpr size_t kBins = 20;
  std::vector<double> counts(kBins, 0.0);
  for (const double v : volumes)
    counts[std::min<size_t>(static_cast<size_t>(nearest_volume_below(v, k, n) * kBins), kBins - 1)] += 1.0;
  return check_distribution(name, counts, std::vector<double>(kBins, 1.0 / kBins));
}

/// What cases of k nearest photons share: maps of N photons.
class NearestMaps {
 public:
  explicit NearestMaps(const Effort& effort) : effort_(effort) {}
  const DensityFacts& facts(int dimension, uint64_t n, uint32_t k) {
    const auto key = std::tuple(dimension, n, k);
    const auto found = facts_.find(key);
    if (found != facts_.end()) return found->second;
    const double photons = effort_.full ? 5e9 : 5e7;
    const auto maps =
        static_cast<uint64_t>(std::clamp(photons / static_cast<double>(n), 1000.0, effort_.full ? 1e6 : 2e4));
    const uint64_t seed = effort_.seed_of(fmt::format("nearest {} {} {}", dimension, n, k));
    return facts_.emplace(key, estimate_nearest_density(dimension, n, k, maps, seed)).first->second;
  }

 private:
  Effort effort_;
  std::map<std::tuple<int, uint64_t, uint32_t>, DensityFacts> facts_;
};

/// The relative variance of (k - 1)/(N V_k).
double nearest_variance(double n, double k) { return (n - k + 1.0) / (n * (k - 2.0)); }

// The tail of an estimate falls with the power -k: only from these k on do means and mean squares have tame errors.
constexpr uint32_t kMeanTail = 5, kSquareTail = 10;

Check check_nearest_mean(const std::string& name, const Moments& found, double exact, uint32_t k) {
  if (k < kMeanTail) return not_determined(name, found.mean(), exact, "heavy tail");
  return check_mean(name, found, exact);
}

void check_nearest_kernel(std::vector<Check>& checks, const OracleCase& c, const DensityFacts& facts, size_t kernel) {
  const uint64_t n = c.count("N");
  const auto k = static_cast<uint32_t>(c.count("k"));
  checks.push_back(check_nearest_mean("mean", facts.mean[kernel], c.number("mean"), k));
  if (k < 3) return;  // the variance is infinite
  // The ratio to the constant kernel's estimate does not depend on the volume, and is bounded:
  // E[estimate^2] = E[ratio^2] E[((k - 1)/(N V_k))^2].
  const double constant_square = 1.0 + nearest_variance(static_cast<double>(n), k);
  checks.push_back(check_mean("E[ratio^2] to the constant kernel's, from the variance", facts.square_ratio[kernel],
                              (1.0 + c.number("variance")) / constant_square));
  if (k >= kSquareTail) checks.push_back(check_mean("variance", facts.square_error[kernel], c.number("variance")));
}

void check_nearest_constant(std::vector<Check>& checks, const OracleCase& c, const DensityFacts& facts, int dimension) {
  const uint64_t n = c.count("N");
  const auto k = static_cast<uint32_t>(c.count("k"));
  const double ratio = (k - 1.0) / k;
  const auto name = [&](const char* what) { return fmt::format("{}, {}D", what, dimension); };
  checks.push_back(check_nearest_mean(name("mean_k_minus_1"), facts.mean[0], c.number("mean_k_minus_1"), k));
  checks.push_back(check_nearest_mean(name("mean_k, (k - 1)/k of it"), facts.mean[0], c.number("mean_k") * ratio, k));
  checks.push_back(check_volumes(name("distribution of V_k"), facts.volumes, k, n));
  if (k < kSquareTail) return;
  checks.push_back(check_mean(name("var_k_minus_1"), facts.square_error[0], c.number("var_k_minus_1")));
  checks.push_back(
      check_mean(name("var_k, ((k - 1)/k)^2 of it"), facts.square_error[0], c.number("var_k") * ratio * ratio));
}

CaseResult run_nearest(const OracleCase& c, NearestMaps& maps) {
  CaseResult result;
  const uint64_t n = c.count("N");
  const auto k = static_cast<uint32_t>(c.count("k"));
  if (k < 2 || k > n / 4) c.refuse("\"k\" must be from 2 to N/4");
  const double farthest = std::cbrt(0.75 * 1.5 * (k + 4.0 * std::sqrt(k)) / (kPiD * static_cast<double>(n)));
  if (farthest > 0.5) {
    result.unchecked = "the ball of its k nearest photons reaches beyond the unit cube";
    return result;
  }
  if (c.has("kernel")) {
    const std::optional<KernelKind> kernel = kernel_named(c.text("kernel"));
    if (!kernel) return no_kernel(c.text("kernel"));
    check_nearest_kernel(result.checks, c, maps.facts(read_dimension(c), n, k), static_cast<size_t>(*kernel));
  } else {
    for (const int dimension : {2, 3}) check_nearest_constant(result.checks, c, maps.facts(dimension, n, k), dimension);
  }
  return result;
}

CaseResult run_radius(const OracleCase& c, const Effort& effort) {
  const std::optional<KernelKind> kernel = kernel_named(c.text("kernel"));
  if (!kernel) return no_kernel(c.text("kernel"));
  const int d = read_dimension(c);
  const uint64_t n = c.count("N");
  const double h = c.number_in("h", 1e-6, 0.5);
  const double photons = effort.full ? 5e9 : 2.5e7;
  const auto maps = static_cast<uint64_t>(std::clamp(photons / static_cast<double>(n), 500.0, 1e6));
  const DensityFacts facts = estimate_radius_density(d, n, h, maps, effort.seed_of(c.place()));
  CaseResult result;
  result.checks.push_back(check_mean("mean", facts.mean[static_cast<size_t>(*kernel)], c.number("mean")));
  result.checks.push_back(
      check_mean("variance_binomial", facts.square_error[static_cast<size_t>(*kernel)], c.number("variance_binomial")));
  const double volume = d == 1 ? 2.0 * h : d == 2 ? kPiD * h * h : 4.0 / 3.0 * kPiD * h * h * h;
  result.checks.push_back(check_mean("expected_photons over N V", facts.mean[0],
                                     c.number("expected_photons") / (static_cast<double>(n) * volume)));
  return result;
}

CaseResult run_bias(const OracleCase& c, const Effort& effort) {
  const std::optional<KernelKind> kernel = kernel_named(c.text("kernel"));
  if (!kernel) return no_kernel(c.text("kernel"));
  const int d = read_dimension(c);
  const double h = c.number_in("h", 1e-6, 0.5);
  const std::vector<double> multipliers = c.numbers("cosine_multiplier", 3);
  CaseResult result;
  const KernelIntegrals sums = integrate_kernel(d, *kernel);
  result.checks.push_back(check_bound("quadratic_bias of the profile", h * h * sums.second_moment / sums.profile,
                                      c.number("quadratic_bias"), 1e-6 * h * h));
  for (size_t i = 0; i < 3; ++i)
    result.checks.push_back(check_bound(fmt::format("cosine_multiplier[{}] of the profile", i),
                                        sums.cosine[i] / sums.profile, multipliers[i], 1e-6));
  const auto found = estimate_kernel_bias(d, *kernel, h, effort.count(200, 5000), effort.seed_of(c.place()));
  const std::array<double, kBiasDensities> exact{1.0 + c.number("linear_density_bias"),
                                                 1.0 + c.number("quadratic_bias"), 1.0 + multipliers[0],
                                                 1.0 + multipliers[1], 1.0 + multipliers[2]};
  constexpr std::array kNames{"linear", "quadratic", "cosine, |k|h = 1", "cosine, |k|h = 2", "cosine, |k|h = 4"};
  for (size_t i = 0; i < kBiasDensities; ++i)
    result.checks.push_back(check_mean(fmt::format("map of a {} density", kNames[i]), found[i], exact[i], 1e-6));
  return result;
}

CaseResult run_progressive(const OracleCase& c, const Effort&) {
  const double a = c.number_in("alpha", 1e-6, 1.0);
  const int d = read_dimension(c), n = static_cast<int>(c.count("pass_index_1_based"));
  const double measure = measure_of_pass(a, n - 1);
  CaseResult result;
  const auto check = [&](const char* field, double found) {
    const double exact = c.number(field);
    result.checks.push_back(check_bound(field, found, exact, 1e-9 * exact));
  };
  check("measure_ratio", measure);
  check("radius_ratio", std::pow(measure, 1.0 / d));
  double inverse = 0.0;
  for (int i = 0; i < n; ++i) inverse += 1.0 / measure_of_pass(a, i);
  check("mean_inverse_measure", inverse / n);
  if (std::abs(a - 4.0 / (d + 4.0)) < 1e-9)
    result.checks.push_back(
        check_bound("radius of the pass in a render", radius_of_pass(1.0f, d, n - 1), c.number("radius_ratio"), 1e-6));
  return result;
}

}  // namespace

std::vector<CaseResult> run_density_estimates(const OracleList& list, const Effort& effort) {
  NearestMaps maps(effort);
  return run_each(list, [&](const OracleCase& c) {
    if (list.name == "kernels") return run_kernel(c, effort);
    if (list.name == "knn") return run_nearest(c, maps);
    if (list.name == "fixed_radius") return run_radius(c, effort);
    if (list.name == "bias") return run_bias(c, effort);
    return run_progressive(c, effort);
  });
}

}  // namespace vpm::tools
