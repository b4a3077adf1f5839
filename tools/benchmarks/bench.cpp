// The measuring itself: times of repetitions, medians of paired ratios, and their tables.
#include "benchmarks/bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <nlohmann/json.hpp>

namespace vpm::bench {
namespace {

double seconds(Clock clock) {
  timespec now{};
  clock_gettime(clock == Clock::processor ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::string time_text(double s) {
  if (s < 1e-6) return fmt::format("{:.1f} ns", 1e9 * s);
  if (s < 1e-3) return fmt::format("{:.2f} us", 1e6 * s);
  return s < 1.0 ? fmt::format("{:.2f} ms", 1e3 * s) : fmt::format("{:.2f} s", s);
}

/// What was measured of one alternative.
struct Measured {
  std::vector<double> times;  // s, of the repetitions
  double checksum = 0.0;
};

std::vector<Measured> measure(const Comparison& comparison, int repetitions) {
  const auto& alternatives = comparison.alternatives;
  std::vector<Measured> measured(alternatives.size());
  for (int r = 0; r < repetitions; ++r)
    for (size_t i = 0; i < alternatives.size(); ++i) {
      const size_t a = (i + static_cast<size_t>(r)) % alternatives.size();
      if (!alternatives[a].run) continue;
      const double start = seconds(comparison.clock);
      measured[a].checksum = alternatives[a].run();
      measured[a].times.push_back(seconds(comparison.clock) - start);
    }
  return measured;
}

Spread ratios(const Measured& other, const Measured& ours) {
  std::vector<double> values;
  for (size_t i = 0; i < ours.times.size(); ++i) values.push_back(other.times[i] / ours.times[i]);
  return spread_of(values);
}

}  // namespace

Spread spread_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto quantile = [&](double q) {
    const double place = q * static_cast<double>(values.size() - 1);
    const auto below = static_cast<size_t>(place);
    const size_t above = std::min(below + 1, values.size() - 1);
    return std::lerp(values[below], values[above], place - static_cast<double>(below));
  };
  return {quantile(0.25), quantile(0.5), quantile(0.75)};
}

void Bench::compare(const Comparison& comparison) {
  fmt::print("\n{} (per {})\n", comparison.title, comparison.item);
  const std::vector<Measured> measured = measure(comparison, repetitions_);
  nlohmann::json rows = nlohmann::json::array();
  for (size_t a = 0; a < measured.size(); ++a) {
    const auto& [name, run, target] = comparison.alternatives[a];
    if (!run) {
      fmt::print("  {:<44} missing: not installed\n", name);
      rows.push_back({{"name", name}, {"missing", true}});
      continue;
    }
    const double time = spread_of(measured[a].times).median / comparison.items;
    const Spread ratio = ratios(measured[a], measured[0]);
    const double expected = measured[0].checksum, off = std::abs(measured[a].checksum - expected);
    const bool agrees = off <= comparison.tolerance * std::abs(expected);
    agrees_ = agrees_ && agrees;
    fmt::print("  {:<44}{:>11}", name, time_text(time));
    if (a > 0) fmt::print("  {:6.2f}x [{:.2f}, {:.2f}]", ratio.median, ratio.low, ratio.high);
    if (target > 0.0) fmt::print("  target {:g}: {}", target, ratio.median >= target ? "met" : "MISSED");
    if (!agrees) fmt::print("  DISAGREES: {:.9g}, not {:.9g}", measured[a].checksum, expected);
    fmt::print("\n");
    rows.push_back({{"name", name},
                    {"seconds", time},
                    {"ratio", ratio.median},
                    {"quartiles", {ratio.low, ratio.high}},
                    {"checksum", measured[a].checksum},
                    {"agrees", agrees}});
    if (target > 0.0) rows.back()["target"] = target;
  }
  std::fflush(stdout);
  json_.push_back(
      nlohmann::json{{"title", comparison.title}, {"item", comparison.item}, {"alternatives", rows}}.dump());
}

void Bench::note(const std::string& title, double value, const std::string& unit) {
  fmt::print("  {}: {:.4g} {}\n", title, value, unit);
  json_.push_back(nlohmann::json{{"title", title}, {"value", value}, {"unit", unit}}.dump());
}

}  // namespace vpm::bench
