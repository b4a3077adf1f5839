// A straight line through points, by least squares.
#pragma once

#include <cassert>
#include <cmath>
#include <limits>
#include <span>

#include "vpm/base/statistics/moments.h"

namespace vpm {

struct LineFit {
  double slope = 0.0;
  double slope_error = 0.0;  // standard error, from what the points are off the line; NaN of two, which are not
};

/// The line through the points (x[i], y[i]), of which two at least differ in x.
inline LineFit fit_line(std::span<const double> x, std::span<const double> y) {
  assert(x.size() == y.size() && x.size() >= 2);
  const auto n = static_cast<double>(x.size());
  Moments of_x, of_y;
  for (const double value : x) of_x.add(value);
  for (const double value : y) of_y.add(value);
  double products = 0.0;
  for (size_t i = 0; i < x.size(); ++i) products += (x[i] - of_x.mean()) * (y[i] - of_y.mean());
  const double squares = of_x.variance() * (n - 1.0);
  assert(squares > 0.0);
  const double slope = products / squares;
  double residuals = 0.0;
  for (size_t i = 0; i < x.size(); ++i) residuals += std::pow(y[i] - of_y.mean() - slope * (x[i] - of_x.mean()), 2);
  const double error = n > 2.0 ? std::sqrt(residuals / (n - 2.0) / squares) : std::numeric_limits<double>::quiet_NaN();
  return {slope, error};
}

}  // namespace vpm
