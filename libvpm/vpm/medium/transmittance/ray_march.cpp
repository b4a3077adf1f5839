// Transmittance by marches, whose density integrals have errors: what is made of that.
#include <algorithm>
#include <array>
#include <limits>

#include "vpm/medium/transmittance/estimator.h"
#include "vpm/medium/transmittance/marched_integrals.h"

namespace vpm {
namespace {

class RayMarchedTransmittance final : public TransmittanceEstimator {
 public:
  explicit RayMarchedTransmittance(float step) : step_(step) {}
  TransmittanceEstimate estimate(const Medium&, const Ray&, const Interval&, Rng&) const override;

 private:
  float step_;  // in voxels
};

class JackknifeTransmittance final : public TransmittanceEstimator {
 public:
  explicit JackknifeTransmittance(float step) : step_(step) {}
  TransmittanceEstimate estimate(const Medium&, const Ray&, const Interval&, Rng&) const override;

 private:
  float step_;  // in voxels
};

class UnbiasedRayMarchedTransmittance final : public TransmittanceEstimator {
 public:
  explicit UnbiasedRayMarchedTransmittance(float samples) : samples_(samples) {}
  TransmittanceEstimate estimate(const Medium&, const Ray&, const Interval&, Rng&) const override;

 private:
  float samples_;  // times as many in a comb as the paper has
};

// `ray-march`: quadrature of the optical thickness in equal steps with one random offset. Biased: the exponential of an
// unbiased density integral is not an unbiased transmittance; the bias falls as step^2.
TransmittanceEstimate RayMarchedTransmittance::estimate(const Medium& medium, const Ray& ray, const Interval& interval,
                                                        Rng& rng) const {
  const Interval inside = medium.clip(ray, interval);
  if (const auto known = known_transmittance(medium, inside)) return *known;
  const double steps = step_count(medium, inside, step_);
  const double integral = comb_integral(medium, ray, inside, steps, rng.uniform());
  return {transmittance(medium, integral), static_cast<uint32_t>(steps)};
}

// `jackknife`: two independent marches of the density integral, each with a random offset in every step, joined as if
// their errors were normal: for such density integrals exp(-mean) cos(half their difference) is the unbiased estimator
// of least variance [Peters2025]. Biased only by what the density integrals' errors differ from normal ones: the
// variance, which makes the bias of `ray-march`, cancels, and the third cumulant takes its place. Without the paper's
// sampling by precomputed second moments of bricks.
//
// Known failure: few steps in a dense medium. The errors are far from normal then, and a difference of more than pi
// makes the value negative, which is legal.
TransmittanceEstimate JackknifeTransmittance::estimate(const Medium& medium, const Ray& ray, const Interval& interval,
                                                       Rng& rng) const {
  const Interval inside = medium.clip(ray, interval);
  if (const auto known = known_transmittance(medium, inside)) return *known;
  const double steps = step_count(medium, inside, step_);
  const double length = inside.length() / steps;
  const DensityAlong along = medium.density_along(ray);
  double sums[2] = {0.0, 0.0};
  for (double i = 0.0; i < steps; ++i) {
    const Vec2 offsets = rng.uniform2();
    for (int j = 0; j < 2; ++j) sums[j] += along.at(inside.t0 + (i + offsets[j]) * length);
  }
  const Rgbd sigma_t(medium.sigma_t);
  const double mean = 0.5 * (sums[0] + sums[1]) * length, half = 0.5 * (sums[0] - sums[1]) * length;
  const Rgb value(glm::exp(-sigma_t * mean) * glm::cos(sigma_t * half));
  return {value, 2 * static_cast<uint32_t>(steps)};
}

// `unbiased-ray-march`: the exponential of an unbiased density integral is biased, but its power series about one such
// density integral,
//
//   exp(-tau) = exp(-X_0) sum_k (X_0 - tau)^k / k!,
//
// is not once each power is a product of independent estimates X_0 - X_j. A roulette stops the series, nine times out
// of ten at once: then it is a ray march. All density integrals take their turn as X_0, and products are averaged over
// every choice of the others (U-statistics), so that no sample is wasted [Kettunen2021].
//
// A density integral is a comb of equidistant samples with one offset, from which the straight line between the
// densities at the stretch's ends is taken out: the comb's error for it is known. So there is no noise where the
// density is linear.
//
// Known failure: a comb too coarse for the field. Differences of many optical thicknesses make rare powers enormous, of
// either sign: values below 0 and above 1 are legal, and their variance may be too large to be seen in few samples.
// And in media that vary by many optical thicknesses a comb has as many samples as these, also where no light is left.
constexpr double kHigherOrders = 0.1;  // probability that the series goes on after its first term
constexpr int kMostOrder = 24;         // that a uniform number of 53 bits can reach

/// The order at which the series stops: 0, or at least 2, each further order k with probability 2/k [Kettunen2021,
/// alg. 2].
int draw_order(Rng& rng) {
  const double u = rng.uniform_double();
  double reached = kHigherOrders;
  if (!(u < reached)) return 0;
  int order = 2;
  while (order < kMostOrder && u < (reached *= 2.0 / (order + 1))) ++order;
  return order;
}

/// 1/k! over the probability that order k is reached, kHigherOrders 2^(k - 1) / k! from k = 1 on.
double series_weight(int k) { return k == 0 ? 1.0 : std::ldexp(1.0 / kHigherOrders, 1 - k); }

/// The optical thickness by which the extinction may differ from a constant along a stretch: of its local majorants
/// less the least of its local bounds. (The paper's control, whose minorant is 0, has more samples in even media.)
double control_thickness(const Medium& medium, const Ray& ray, const Interval& inside, uint32_t& bricks) {
  double majorant = 0.0, covered = 0.0, least_bound = std::numeric_limits<double>::infinity();  // m, m, 1
  bricks = medium.visit_majorants(ray, inside, [&](const DensityStretch& stretch) {
    const double length = stretch.t1 - stretch.t0;
    majorant += length * stretch.max;
    covered += length;
    least_bound = std::min(least_bound, double{stretch.min});
    return true;
  });
  constexpr double kRounding = 1e-6;
  const double length = double{inside.t1} - inside.t0;
  if (covered < (1.0 - kRounding) * length) least_bound = 0.0;  // empty bricks are left out
  return max_channel(medium.sigma_t) * (majorant - least_bound * covered);
}

/// Samples in a comb [Kettunen2021, alg. 4].
double comb_size(double control, double times) {
  const double of_tracking = std::ceil(std::cbrt((0.015 + control) * (0.65 + control) * (60.3 + control)));
  constexpr double kMeanDensityIntegrals = 1.31945;  // by draw_order()
  return std::max(1.0, std::round(times * of_tracking / kMeanDensityIntegrals));
}

/// The mean over all choices of k of the thicknesses, without the pivot, of the product of their differences to the
/// pivot, for k from 0 to `order` [Kettunen2021, alg. 1].
void elementary_means(const double* thicknesses, int order, int pivot, double* means) {
  means[0] = 1.0;
  std::fill(means + 1, means + order + 1, 0.0);
  int seen = 0;
  for (int j = 0; j <= order; ++j) {
    if (j == pivot) continue;
    ++seen;
    const double difference = thicknesses[pivot] - thicknesses[j];
    for (int k = seen; k >= 1; --k) means[k] += static_cast<double>(k) / seen * (means[k - 1] * difference - means[k]);
  }
}

/// The mean over pivots of their power series for exp(-thickness).
double power_series(const double* thicknesses, int order) {
  double sum = 0.0, means[kMostOrder + 1];
  for (int pivot = 0; pivot <= order; ++pivot) {
    elementary_means(thicknesses, order, pivot, means);
    double series = 0.0;
    for (int k = 0; k <= order; ++k) series += series_weight(k) * means[k];
    sum += std::exp(-thicknesses[pivot]) * series;
  }
  return sum / (order + 1);
}

TransmittanceEstimate UnbiasedRayMarchedTransmittance::estimate(const Medium& medium, const Ray& ray,
                                                                const Interval& interval, Rng& rng) const {
  const Interval inside = medium.clip(ray, interval);
  if (const auto known = known_transmittance(medium, inside)) return *known;
  TransmittanceEstimate result;
  const double count = comb_size(control_thickness(medium, ray, inside, result.bricks), samples_);
  const DensityAlong along = medium.density_along(ray);
  const double rise = double{along.at(inside.t1)} - along.at(inside.t0);
  const double of_rise = rise * inside.length() / count;  // m: the error over a straight line is (offset - 1/2) of it
  const int order = draw_order(rng);
  double integrals[kMostOrder + 1], thicknesses[kMostOrder + 1];
  for (int i = 0; i <= order; ++i) {
    const double offset = rng.uniform_double();
    integrals[i] = comb_integral(medium, ray, inside, count, offset) - (offset - 0.5) * of_rise;
  }
  for (int c = 0; c < 3; ++c) {
    for (int i = 0; i <= order; ++i) thicknesses[i] = medium.sigma_t[c] * integrals[i];
    result.value[c] = static_cast<float>(power_series(thicknesses, order));
  }
  result.lookups = static_cast<uint32_t>(2.0 + count * (order + 1));
  return result;
}

constexpr std::array kRayMarchedTransmittanceNumbers{Parameter{"step", 1.0f, kVoxels, "voxels", "length of a step"}};
constexpr std::array kJackknifeTransmittanceNumbers{Parameter{"step", 1.0f, kVoxels, "voxels", "length of a step"}};
constexpr std::array kUnbiasedRayMarchedTransmittanceNumbers{
    Parameter{"samples", 1.0f, {1e-3, 1e6, false, false}, "", "samples of a march over those of the paper"}};

}  // namespace

extern const EstimatorInfo kRayMarchedTransmittance{
    .name = "ray-march",
    .summary = "quadrature in equal steps with one random offset; bias falls as step^2",
    .failure = "spikes thinner than a step; by Jensen's inequality too bright on average",
    .source = "Jarosz2008",
    .unbiased = false,
    .parameters = kRayMarchedTransmittanceNumbers,
    .make = [](ParameterValues n) -> std::unique_ptr<TransmittanceEstimator> {
      return std::make_unique<RayMarchedTransmittance>(n[0]);
    }};

extern const EstimatorInfo kJackknife{
    .name = "jackknife",
    .summary = "two marches with a random offset in each step, joined; bias falls faster than one's",
    .failure = "few steps in a dense medium: errors far from normal, values below 0",
    .source = "Peters2025",
    .unbiased = false,
    .parameters = kJackknifeTransmittanceNumbers,
    .make = [](ParameterValues n) -> std::unique_ptr<TransmittanceEstimator> {
      return std::make_unique<JackknifeTransmittance>(n[0]);
    }};

extern const EstimatorInfo kUnbiasedRayMarch{
    .name = "unbiased-ray-march",
    .summary = "power series of the density integrals of a few marches, mostly of one",
    .failure = "spikes thinner than a march's steps: rare terms of great size, of either sign",
    .source = "Kettunen2021",
    .parameters = kUnbiasedRayMarchedTransmittanceNumbers,
    .make = [](ParameterValues n) -> std::unique_ptr<TransmittanceEstimator> {
      return std::make_unique<UnbiasedRayMarchedTransmittance>(n[0]);
    }};

}  // namespace vpm
