// Phase functions: drawn directions against values, normalisation, mean cosine. And pixel filters: drawn offsets
// against the curves they stand for.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "vpm/medium/phase/phase.h"
#include "vpm/scene/camera.h"
#include "vpm/study/sample_moments.h"
#include "vpm/study/validate/groups.h"
#include "vpm/study/validate/scenes/directions.h"

namespace vpm {
namespace {

struct TestedPhase {
  std::string name;
  Phase phase;
  double mean_cosine = 0.0;
};

std::vector<TestedPhase> phases() {
  std::vector<TestedPhase> all{{"isotropic", Isotropic{}, 0.0}, {"Rayleigh", Rayleigh{}, 0.0}};
  for (const float g : {-0.9f, -0.4f, 0.0f, 0.3f, 0.8f, 0.99f})
    all.push_back({fmt::format("Henyey-Greenstein, g = {:.2g}", g), HenyeyGreenstein{g}, g});
  const auto add = [&](std::string name, const auto& phase) {
    all.push_back({std::move(name), phase, double{phase.mean_cosine()}});
  };
  for (const float g : {-0.6f, 0.0f, 0.009f, 0.011f, 0.5f, 0.97f})
    for (const float alpha : {1.0f, 30.0f})
      add(fmt::format("Draine, g = {:.2g}, alpha = {:g}", g, alpha), Draine{g, alpha});
  add("two lobes", TwoLobes(0.8f, -0.4f, 0.7f));
  std::vector<double> degrees, values;  // of a table that is not smooth, nor normalised
  for (int i = 0; i <= 180; i += 5) {
    degrees.push_back(i);
    values.push_back(i < 10 ? 400.0 : i == 140 ? 30.0 : 2.0);
  }
  add("table", Tabulated{std::make_shared<const PhaseTable>(degrees, values)});
  for (const float diameter : {5.0f, 10.0f, 50.0f})
    add(fmt::format("droplets of {:g} um", diameter), Droplets(diameter));
  return all;
}

/// The integral over the sphere of a phase function, summed from the side its peak is on.
struct PhaseLaw {
  bool backward = false;
  std::vector<double> away;                     // 1 - |cosine to the peak|, at the ends of the pieces
  std::vector<double> cumulative;               // probability up to there
  double mean_cosine = 0.0, mean_square = 0.0;  // of the cosine
};

PhaseLaw phase_law(const TestedPhase& named) {
  constexpr int kPieces = 40'000;
  PhaseLaw law;
  law.backward = named.mean_cosine < 0.0;
  double sum = 0.0;
  for (int i = 0; i < kPieces; ++i) {
    // The midpoint rule in x, away = 2 x^4: pieces gather at the peak.
    const double x = (i + 0.5) / kPieces, end = (i + 1.0) / kPieces;
    const double cosine = (law.backward ? -1.0 : 1.0) * (1.0 - 2.0 * x * x * x * x);
    const double share = 2.0 * kPiD * phase_value(named.phase, static_cast<float>(cosine)) * 8.0 * x * x * x / kPieces;
    law.away.push_back(2.0 * end * end * end * end);
    law.cumulative.push_back(sum += share);
    law.mean_cosine += share * cosine;
    law.mean_square += share * cosine * cosine;
  }
  return law;
}

constexpr size_t kRingsOfPhases = 12;  // cells of the cosine, about equally probable

std::vector<Check> check_phase(const TestedPhase& named, const Effort& effort) {
  const PhaseLaw law = phase_law(named);
  const double total = law.cumulative.back();
  std::vector<double> ends, shares;  // of the rings
  double before = 0.0;
  for (size_t ring = 1; ring <= kRingsOfPhases; ++ring) {
    const double target = total * static_cast<double>(ring) / kRingsOfPhases;
    const auto place = std::lower_bound(law.cumulative.begin(), law.cumulative.end() - 1, target);
    const auto i = static_cast<size_t>(place - law.cumulative.begin());
    ends.push_back(law.away[i]);
    shares.push_back((law.cumulative[i] - before) / total);
    before = law.cumulative[i];
  }
  const Vec3 travel = glm::normalize(Vec3(0.3f, -0.8f, 0.5f)), peak = law.backward ? -travel : travel;
  constexpr size_t kCells = kRingsOfPhases * kSectors;
  const auto samples = sample_moments(
      kCells + 1, effort.count(100'000, 10'000'000), effort.seed_of(named.name), [&](Rng& rng, double* out) {
        const Vec3 direction = phase_sample(named.phase, travel, rng.uniform2());
        const double away = away_from(peak, direction);
        const auto ring = std::lower_bound(ends.begin(), ends.end() - 1, away) - ends.begin();
        out[static_cast<size_t>(ring) * kSectors + sector_about(peak, direction)] = 1.0;
        out[kCells] = law.backward ? away - 1.0 : 1.0 - away;
      });
  std::vector<double> probabilities;
  for (const double share : shares) probabilities.insert(probabilities.end(), kSectors, share / kSectors);
  const double mean_square = std::visit([](const auto& p) { return double{p.mean_square_cosine()}; }, named.phase);
  return {check_weights(named.name + ", directions", {samples.begin(), samples.end() - 1}, probabilities),
          check_mean(named.name + ", mean cosine", samples.back(), named.mean_cosine),
          check_bound(named.name + ", integral of values", total, 1.0, 1e-5),
          check_bound(named.name + ", mean cosine of values", law.mean_cosine, named.mean_cosine, 1e-5),
          check_bound(named.name + ", mean square of the cosine", law.mean_square, mean_square, 1e-5)};
}

}  // namespace

std::vector<Experiment> phase_experiments() {
  return {{0, "phase functions", [](const Effort& effort) {
             std::vector<Check> checks;
             for (const TestedPhase& phase : phases()) append(checks, check_phase(phase, effort));
             return checks;
           }}};
}

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
