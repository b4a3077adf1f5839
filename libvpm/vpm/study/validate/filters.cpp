// Pixel filters: drawn offsets against the curves they stand for.
#include <fmt/format.h>
#include <array>
#include <cmath>

#include "vpm/scene/camera.h"
#include "vpm/study/sample_moments.h"
#include "vpm/study/validate/directions.h"
#include "vpm/study/validate/groups.h"

namespace vpm {

namespace {

/// The part of a filter's weight below `x` half widths from its middle.
double below(FilterKind kind, double x) {
  switch (kind) {
    case FilterKind::box:
      return 0.5 * (1.0 + x);
    case FilterKind::tent:
      return x < 0.0 ? 0.5 * (1.0 + x) * (1.0 + x) : 1.0 - 0.5 * (1.0 - x) * (1.0 - x);
    case FilterKind::gaussian:
      break;
  }
  return 0.5 + 0.5 * std::erf(3.0 * x / std::sqrt(2.0)) / std::erf(3.0 / std::sqrt(2.0));
}

std::vector<Check> check_filters(const Effort& effort) {
  constexpr size_t kAlong = 4;
  const std::array<std::pair<const char*, FilterKind>, 3> filters{
      {{"box", FilterKind::box}, {"tent", FilterKind::tent}, {"gaussian", FilterKind::gaussian}}};
  std::vector<Check> checks;
  for (const auto& [name, kind] : filters) {
    const Filter filter{kind, 1.5f};
    const auto cells = sample_moments(
        kAlong * kAlong, effort.count(100'000, 4'000'000), effort.seed_of(name), [&](Rng& rng, double* out) {
          const Vec2 unit = 0.5f * (sample_filter(filter, rng.uniform2()) / filter.radius + 1.0f);
          out[cell_of(unit.x, kAlong) * kAlong + cell_of(unit.y, kAlong)] = 1.0;
        });
    std::vector<double> probabilities;
    const auto part = [kind = kind](size_t cell) {
      const double lo = 2.0 * static_cast<double>(cell) / kAlong - 1.0;
      return below(kind, lo + 2.0 / kAlong) - below(kind, lo);
    };
    for (size_t x = 0; x < kAlong; ++x)
      for (size_t y = 0; y < kAlong; ++y) probabilities.push_back(part(x) * part(y));
    checks.push_back(check_weights(fmt::format("{} filter", name), cells, probabilities));
  }
  return checks;
}

}  // namespace

std::vector<Experiment> filter_experiments() { return {{0, "pixel filters", check_filters}}; }

}  // namespace vpm
