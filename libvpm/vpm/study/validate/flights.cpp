// Free flights: every distance strategy against the exact law of distances, in all fields, in grey and in colour.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "vpm/medium/distance/strategy.h"
#include "vpm/medium/grid/make_grid.h"
#include "vpm/study/sample_moments.h"
#include "vpm/study/validate/groups.h"
#include "vpm/study/validate/scenes/fields.h"

namespace vpm {

namespace {

constexpr size_t kCells = 16;  // of distance, about equally probable; one more stands for flights without a collision

/// Where the cells end, and the density integrals up to there.
struct Law {
  std::vector<double> ends;       // m along the ray
  std::vector<double> integrals;  // m

  /// The probability that a flight under extinction coefficient sigma_t (1/m) ends in a cell.
  double probability(double sigma_t, size_t cell) const {
    const double before = cell == 0 ? 0.0 : integrals[cell - 1];
    if (cell == kCells) return std::exp(-sigma_t * before);
    return std::exp(-sigma_t * before) * -std::expm1(-sigma_t * (integrals[cell] - before));
  }
};

/// The law along the test's stretch, with cells that are equally probable in the green channel, as near as a table of
/// 1024 distances allows.
Law flight_law(const Medium& medium) {
  constexpr int kTable = 1024;
  const Ray ray = test_ray();
  const Interval stretch = test_stretch();
  std::vector<double> ends, integrals;
  double integral = 0.0, t = stretch.t0;
  for (int i = 1; i <= kTable; ++i) {
    const double next = stretch.t0 + (double{stretch.t1} - stretch.t0) * i / kTable;
    integral += looked_up_integral(medium, ray, t, next);
    ends.push_back(t = next);
    integrals.push_back(integral);
  }
  const double all = -std::expm1(-medium.sigma_t.g * integral);
  Law law;
  for (size_t cell = 1; cell <= kCells; ++cell) {
    const double share = all * static_cast<double>(cell) / kCells;
    const auto place = std::find_if(integrals.begin(), integrals.end() - 1,
                                    [&](double c) { return -std::expm1(-medium.sigma_t.g * c) >= share; });
    const auto i = static_cast<size_t>(cell == kCells ? kTable - 1 : place - integrals.begin());
    law.ends.push_back(ends[i]);
    law.integrals.push_back(integrals[i]);
  }
  return law;
}

float number_of(const DistanceSettings& settings, std::string_view name) {
  return vpm::number_of(strategy_info(settings.strategy).parameters, settings.parameters, name);
}

/// The density integral along the test's ray up to `t` (m), by the midpoint rule in the steps that `ray-march-adaptive`
/// takes in the bricks on its way: for stating its bias.
double adaptively_marched_integral(const Medium& medium, double t, const DistanceSettings& settings) {
  const Ray ray = test_ray();
  const double longest = double{number_of(settings, "step")} * double{medium.voxel_size()};
  const double optical_step = number_of(settings, "optical_step");
  double sum = 0.0;
  medium.visit_majorants(ray, test_stretch(), [&](const DensityStretch& brick) {
    const double length = brick.t1 - brick.t0, extinction = double{max_channel(medium.sigma_t)} * double{brick.max};
    const double wanted = std::min(std::max(optical_step / extinction, longest / 16.0), longest);
    const int steps = brick.min == brick.max ? 1 : static_cast<int>(std::ceil(length / wanted));
    for (int i = 0; i < steps; ++i) {
      const double from = brick.t0 + length * i / steps;
      const auto middle = static_cast<float>(from + 0.5 * length / steps);
      sum += std::clamp(t - from, 0.0, length / steps) * double{medium.density(ray.at(middle))};
    }
    return true;
  });
  return sum;
}

/// By how much the law of a march is off in each cell, in probability.
std::vector<double> marched_bias(const Medium& medium, const Law& law, const DistanceSettings& settings,
                                 double sigma_t) {
  Law marched = law;
  for (size_t i = 0; i < kCells; ++i)
    marched.integrals[i] =
        settings.strategy == "ray-march-adaptive"
            ? adaptively_marched_integral(medium, law.ends[i], settings)
            : marched_integral(medium, law.ends[i], double{number_of(settings, "step")} * double{medium.voxel_size()});
  std::vector<double> bias;
  for (size_t cell = 0; cell <= kCells; ++cell)
    bias.push_back(std::fabs(marched.probability(sigma_t, cell) - law.probability(sigma_t, cell)));
  return bias;
}

constexpr Rgb kPower(1.0f, 0.5f, 2.0f);  // of coloured flights

/// The weights of `count` flights by channel and cell.
std::vector<Moments> fly(const Medium& medium, const DistanceStrategy& strategy, const Rgb& power, const Law& law,
                         uint64_t count, uint64_t seed) {
  const Ray ray = test_ray();
  const Interval stretch = test_stretch();
  return sample_moments(3 * (kCells + 1), count, seed, [&](Rng& rng, double* out) {
    const Flight flight = strategy.sample(medium, ray, stretch, power, rng);
    const auto end = std::lower_bound(law.ends.begin(), law.ends.end() - 1, flight.t);
    const auto cell = flight.collided ? static_cast<size_t>(end - law.ends.begin()) : kCells;
    for (size_t c = 0; c < 3; ++c) out[c * (kCells + 1) + cell] = flight.weight[static_cast<int>(c)];
  });
}

/// Along the ramp the middle of a step of any length is exact: there a march is tested as it is used by default, and
/// elsewhere in short steps. What needs no majorants that bound is tested under those of a quarter of the density.
DistanceSettings tested_settings(const std::string& field, const StrategyInfo& info, const Effort& effort) {
  Parameters numbers{{"majorant", info.positive ? 1.0f : 0.25f}};
  if (field != "ramp grid") {
    const float step = effort.full ? 0.02f : 0.1f;                // voxels of most fields
    numbers["step"] = field == "fine grid" ? 4.0f * step : step;  // as many metres
    if (info.name == "ray-march-adaptive") numbers["step"] *= 5.0f;
    numbers["optical_step"] = 0.2f * step;  // in the densest voxels about as long as the others' steps
  }
  return {std::string(info.name), among(info.parameters, numbers)};
}

void check_flights(std::vector<Check>& checks, const TestField& field, const Rgb& sigma_t, const StrategyInfo& info,
                   const Effort& effort) {
  const Medium medium = make_medium(field.grid, sigma_t);
  const Law law = flight_law(medium);
  const DistanceSettings settings = tested_settings(field.name, info, effort);
  const auto strategy = make_distance_strategy(settings);
  const std::string name = fmt::format("{}, {}", field.name, info.name);
  const bool marches = info.marches && field.grid;
  const bool short_steps = marches && field.name != "ramp grid";
  const uint64_t count = (short_steps ? effort.count(10'000, 200'000) : effort.count(40'000, 800'000)) *
                         (info.positive ? 1 : 12);  // weights of either sign cancel
  // Flights whose weights may be negative can have left a path powers of unlike sign.
  const Rgb power = medium.grey() ? Rgb(1.0f) : kPower * Rgb(1.0f, info.positive ? 1.0f : -1.0f, 1.0f);
  const auto cells =
      fly(medium, *strategy, power, law, count, effort.seed_of(name + (medium.grey() ? "" : ", colour")));
  for (int c = 0; c < (medium.grey() ? 1 : 3); ++c) {
    std::vector<double> probabilities, bias;
    for (size_t cell = 0; cell <= kCells; ++cell) probabilities.push_back(law.probability(sigma_t[c], cell));
    if (marches) bias = marched_bias(medium, law, settings, sigma_t[c]);
    const auto first = cells.begin() + c * static_cast<ptrdiff_t>(kCells + 1);
    checks.push_back(check_weights(name + (medium.grey() ? "" : kOfChannel[static_cast<size_t>(c)]),
                                   {first, first + kCells + 1}, probabilities, bias));
    if (marches)
      checks.back().note +=
          fmt::format("; steps of up to {} voxels, bias up to {:.1g} in a cell of about {:.1g} allowed for",
                      number_of(settings, "step"), *std::max_element(bias.begin(), bias.end()), probabilities[0]);
  }
}

std::vector<Check> flights_by(const StrategyInfo& info, const Effort& effort) {
  std::vector<TestField> fields{{"homogeneous", nullptr}};
  if (info.heterogeneous) {
    for (TestField& field : test_fields()) fields.push_back(std::move(field));
    fields.push_back(fine_field());
  }
  // Beyond majorants weights grow with the optical thickness: in thin media they can still be judged.
  const float sigma_t = info.positive ? 1.2f : 0.1f;
  std::vector<Check> checks;
  for (const TestField& field : fields) {
    check_flights(checks, field, Rgb(sigma_t), info, effort);
    if (!field.grid || field.name == "ramp grid" || field.name == "random grid" || field.name == "fine grid")
      check_flights(checks, field, sigma_t * Rgb(0.5f, 1.0f, 2.0f), info, effort);
  }
  return checks;
}

/// Majorants that do not bound cut the density: flights follow the law of the field cut likewise, until majorants have
/// grown. In a grid of nearest voxels that field is a grid, too.
std::vector<Check> check_majorants_that_cut(const Effort& effort) {
  const std::shared_ptr<const DensityGrid> checker = test_fields()[2].grid;
  std::vector<Check> checks;
  for (const Rgb& sigma_t : {Rgb(1.2f), Rgb(0.6f, 1.2f, 2.4f)})
    for (uint64_t pass = 0; pass < 3; ++pass) {
      const double most = 0.375 * static_cast<double>(1 << pass);
      const auto cut =
          make_grid(checker->frame(), [&](int x, int y, int z) { return std::min((x + y + z) & 1 ? 1.5 : 0.3, most); });
      const Law law = flight_law(make_medium(cut, sigma_t));
      const auto strategy = make_distance_strategy({"progressive-null", {{"majorant", 0.25f}}}, {.pass = pass});
      const std::string name = fmt::format("checker grid, pass {}{}", pass, is_grey(sigma_t) ? "" : ", colour");
      const auto cells = fly(make_medium(checker, sigma_t), *strategy, is_grey(sigma_t) ? Rgb(1.0f) : kPower, law,
                             effort.count(40'000, 800'000), effort.seed_of(name + ", cut"));
      for (int c = 0; c < (is_grey(sigma_t) ? 1 : 3); ++c) {
        std::vector<double> probabilities;
        for (size_t cell = 0; cell <= kCells; ++cell) probabilities.push_back(law.probability(sigma_t[c], cell));
        const auto first = cells.begin() + c * static_cast<ptrdiff_t>(kCells + 1);
        checks.push_back(check_weights(name + (is_grey(sigma_t) ? "" : kOfChannel[static_cast<size_t>(c)]),
                                       {first, first + kCells + 1}, probabilities));
      }
    }
  return checks;
}

/// The references' own reference: look-ups and their quadrature against formulas.
std::vector<Check> check_integrals(const Effort&) {
  const auto fields = test_fields();
  const Ray ray = test_ray();
  const Interval stretch = test_stretch();
  // Both fields depend on the x index alone, as a function of straight pieces; `integral` is from x = -8.
  const Mat4d to_index = glm::inverse(fields[0].grid->frame().index_to_world);
  const double slope = (to_index * glm::dvec4(Vec3d(ray.direction), 0.0)).x;
  const auto index_at = [&](double t) { return (to_index * glm::dvec4(Vec3d(ray.origin), 1.0)).x + t * slope; };
  const auto between = [&](auto&& integral) {
    return (integral(index_at(stretch.t1)) - integral(index_at(stretch.t0))) / slope;
  };
  const auto fade = [](double x) {
    return 0.5 - 0.5 * (8.0 - std::clamp(x, 7.0, 8.0)) * (8.0 - std::clamp(x, 7.0, 8.0));
  };
  const double constant = between([&](double x) { return 0.8 * (std::min(x, 7.0) + 7.5 + fade(x)); });
  const double ramp = between([&](double x) {
    const double rise = std::min(x, 7.0) + 8.0;
    return 0.05 * rise * rise + 1.5 * fade(x);
  });
  const auto looked_up = [&](size_t i) {
    return looked_up_integral(make_medium(fields[i].grid, Rgb(1.0f)), ray, stretch.t0, stretch.t1);
  };
  return {check_bound("constant grid, density integral by look-ups", looked_up(0), constant, 2e-6),
          check_bound("ramp grid, density integral by look-ups", looked_up(1), ramp, 2e-6)};
}

}  // namespace

std::vector<Experiment> flight_experiments() {
  std::vector<Experiment> all{{0, "density integrals", check_integrals}};
  for (const StrategyInfo& info : distance_strategies())
    all.push_back({0, fmt::format("free flights, {}", info.name),
                   [&info](const Effort& effort) { return flights_by(info, effort); }});
  all.push_back({0, "free flights under majorants that cut", check_majorants_that_cut});
  return all;
}

}  // namespace vpm
