// What is not known of an error: how noisy its estimates are, and how the bias goes with the radius.
#include "vpm/render/stated_error.h"

#include <algorithm>
#include <cmath>

namespace vpm {
namespace {

/// Squared biases over FilmErrors::bias_part: 1 where biases go as r^2, 4 where they go as r, as at edges of light and
/// of media. Which it is cannot be seen: a render states the middle.
constexpr double kLeastFactor = 1.0, kMostFactor = 4.0, kMiddle = 0.5 * (kLeastFactor + kMostFactor),
                 kHalfRange = 0.5 * (kMostFactor - kLeastFactor);
/// So many standard errors that a normal distribution is beyond them with 5 %, on both sides, or with 20 %, on one.
/// That a jackknife over few groups only estimates its standard error is made up for by its being rather too large.
constexpr double kBothSides = 1.96, kOneSide = 0.84;

}  // namespace

StatedError stated_error(const FilmErrors& errors) {
  const Estimated& variance = errors.variance_part;
  const double bias = std::max(0.0, errors.bias_part.value), of_bias = errors.bias_part.standard_error;
  StatedError stated;
  stated.variance = variance;
  stated.squared_bias = {kMiddle * bias, std::hypot(kMiddle * of_bias, kHalfRange * bias / kBothSides)};
  stated.total = {variance.value + stated.squared_bias.value,
                  std::hypot(variance.standard_error, stated.squared_bias.standard_error)};
  stated.bias_seen = errors.bias_part.value > kBothSides * of_bias;
  stated.highest_squared_bias = kMostFactor * (bias + kOneSide * of_bias);
  stated.highest = stated.total.value +
                   std::hypot(kOneSide * variance.standard_error, kOneSide * kMiddle * of_bias, kHalfRange * bias);
  return stated;
}

}  // namespace vpm
