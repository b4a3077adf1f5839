// Even steps out of uneven ones, and the cumulative distribution.
#include "vpm/medium/phase/phase_table.h"

#include <fmt/format.h>
#include <array>
#include <cmath>

#include "vpm/base/error.h"
#include "vpm/base/vec.h"

namespace vpm {
namespace {

constexpr double kStep = 1.0 / PhaseTable::kCells;

void check(std::span<const double> degrees, std::span<const double> values) {
  if (degrees.size() < 2 || degrees.size() != values.size())
    throw InputError("a table of a phase function has two angles at least, and a value for each");
  if (degrees.front() != 0.0 || degrees.back() != 180.0)
    throw InputError(fmt::format("the angles of a phase function go from 0 to 180 degrees, not from {:g} to {:g}",
                                 degrees.front(), degrees.back()));
  for (size_t i = 0; i < values.size(); ++i) {
    if (i > 0 && !(degrees[i] > degrees[i - 1]))
      throw InputError(fmt::format("the angles of a phase function rise, but {:g} follows {:g} degrees", degrees[i],
                                   degrees[i - 1]));
    if (!(values[i] >= 0.0 && std::isfinite(values[i])))
      throw InputError(
          fmt::format("the value of a phase function at {:g} degrees is {:g}: it must be finite and at "
                      "least 0",
                      degrees[i], values[i]));
  }
}

/// Calls add(s, weight) at the points of a rule that is exact for polynomials of degree 7 on a cell.
template <class Add>
void integrate(size_t cell, Add&& add) {
  constexpr std::array kPoints{0.0694318442029737, 0.3300094782075719, 0.6699905217924281, 0.9305681557970263};
  constexpr std::array kWeights{0.1739274225687269, 0.3260725774312731, 0.3260725774312731, 0.1739274225687269};
  for (size_t k = 0; k < kPoints.size(); ++k)
    add((static_cast<double>(cell) + kPoints[k]) * kStep, kPoints[k], kWeights[k] * kStep);
}

}  // namespace

/// The integral over the part [0, x] of a cell: solid angles are 8 pi s ds.
double PhaseTable::within(size_t cell, double x) const {
  const double s = static_cast<double>(cell) * kStep, p = values_[cell], rise = values_[cell + 1] - p;
  return 8.0 * kPiD * kStep * x * (s * p + x * (0.5 * (s * rise + kStep * p) + x * kStep * rise / 3.0));
}

PhaseTable::PhaseTable(std::span<const double> degrees, std::span<const double> values, int columns)
    : values_(kCells + 1), columns_(columns) {
  check(degrees, values);
  std::vector<double> sampled(kCells + 1);
  size_t next = 1;
  for (size_t i = 0; i <= kCells; ++i) {
    const double angle = 2.0 * std::asin(static_cast<double>(i) * kStep) * 180.0 / kPiD;
    while (next + 1 < degrees.size() && degrees[next] < angle) ++next;
    const double part = std::min(1.0, (angle - degrees[next - 1]) / (degrees[next] - degrees[next - 1]));
    sampled[i] = values[next - 1] + part * (values[next] - values[next - 1]);
  }
  for (size_t cell = 0; cell < kCells; ++cell)
    integrate(cell, [&](double s, double x, double weight) {
      total_ += weight * 8.0 * kPiD * s * (sampled[cell] + x * (sampled[cell + 1] - sampled[cell]));
    });
  if (!(total_ > 0.0)) throw InputError("a phase function is not 0 at all angles");
  for (size_t i = 0; i <= kCells; ++i) values_[i] = static_cast<float>(sampled[i] / total_);
  cumulative_.push_back(0.0);
  for (size_t cell = 0; cell < kCells; ++cell) cumulative_.push_back(cumulative_.back() + within(cell, 1.0));
  for (double& share : cumulative_) share /= cumulative_.back();
  for (size_t cell = 0; cell < kCells; ++cell)
    integrate(cell, [&](double s, double x, double weight) {
      const double cosine = 1.0 - 2.0 * s * s;
      const double share = weight * 8.0 * kPiD * s * (values_[cell] + x * (values_[cell + 1] - values_[cell]));
      mean_cosine_ += share * cosine;
      mean_square_cosine_ += share * cosine * cosine;
    });
}

double PhaseTable::away_within(double u) const {
  const auto above = std::upper_bound(cumulative_.begin() + 1, cumulative_.end() - 1, u);
  const auto cell = static_cast<size_t>(above - cumulative_.begin()) - 1;
  const double target = (u - cumulative_[cell]) / (cumulative_[cell + 1] - cumulative_[cell]) * within(cell, 1.0);
  double lo = 0.0, hi = 1.0;
  for (int step = 0; step < 40; ++step) {  // the integral rises: a bracket that is halved ends at the last digit
    const double x = 0.5 * (lo + hi);
    (within(cell, x) < target ? lo : hi) = x;
  }
  const double s = (static_cast<double>(cell) + 0.5 * (lo + hi)) * kStep;
  return 2.0 * s * s;
}

}  // namespace vpm
