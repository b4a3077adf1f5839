// Straight lines through points, by least squares.
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

/// A number that goes with another by a line: at + by x.
struct Line {
  double at = 0.0, by = 0.0;

  double operator()(double x) const { return at + by * x; }
};
struct PointOfLine {
  double x, y, weight;
};
/// The line of least relative squares of y that neither falls nor begins below 0. Values of 0 count for nothing.
inline Line rising_line(std::span<const PointOfLine> values) {
  double w = 0.0, x = 0.0, xx = 0.0, y = 0.0, xy = 0.0;  // weighted sums, of relative values
  for (const PointOfLine& value : values) {
    if (!(value.y > 0.0)) continue;
    w += value.weight / (value.y * value.y);
    x += value.weight * value.x / (value.y * value.y);
    xx += value.weight * value.x * value.x / (value.y * value.y);
    y += value.weight / value.y;
    xy += value.weight * value.x / value.y;
  }
  if (w == 0.0) return {};
  const double spread = w * xx - x * x;
  const double by = spread > 1e-9 * w * xx ? (w * xy - x * y) / spread : 0.0;
  if (by <= 0.0) return {y / w, 0.0};
  const double at = (y - by * x) / w;
  return at >= 0.0 ? Line{at, by} : Line{0.0, xy / xx};
}

}  // namespace vpm
