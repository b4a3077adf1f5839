// Radii by the density of photons, numbers of photons by what they cost.
#include "vpm/tune/choice_rules.h"

#include <fmt/format.h>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>

#include "vpm/estimate/photon_map.h"
#include "vpm/render/render.h"
#include "vpm/tune/forecast.h"

namespace vpm {
namespace {

constexpr double kHalfPixel = 0.5;           // pixels: the least radius
constexpr double kLeastPhotonShare = 0.125;  // of what the eye pass costs, for photons

}  // namespace

double rounded(double value, int digits) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) + 1 - digits);
  return unit >= 1.0 ? std::round(value / unit) * unit : std::round(value / unit) / std::round(1.0 / unit);
}

float rounded_radius(double radius) { return static_cast<float>(rounded(radius, 3)); }

ChosenRadius choose_radius(const MapDensity& density, double emitted, double diagonal) {
  const auto holding = [&](double records) {  // the radius, m
    const double share = records / density.within * density.emitted / emitted;
    return density.reach * std::pow(share, 1.0 / density.dimension);
  };
  const auto within = [&](double records) {
    return fmt::format("{:g} {} of the first pass are within it at a typical place of the picture", records,
                       density.records);
  };
  const double wanted = holding(kPhotonsWithin), half_pixel = kHalfPixel * density.footprint;
  const std::string would = fmt::format("{:.3g} m would hold {:g} {} at a typical place of the picture", wanted,
                                        kPhotonsWithin, density.records);
  double radius = wanted;
  std::string reason = within(kPhotonsWithin);
  if (radius < half_pixel) std::tie(radius, reason) = std::pair(half_pixel, "half a pixel; " + would);
  const auto keep_below = [&](double bound, const std::string& name) {
    if (radius > bound) std::tie(radius, reason) = std::pair(bound, name + "; " + would);
  };
  const auto keep_in_medium = [&](double bound, const std::string& name) {
    const double least = holding(kLeastWithin);
    if (bound < least)
      keep_below(least, within(kLeastWithin) + ", and fewer within " + name);
    else
      keep_below(bound, name);
  };
  keep_in_medium(kShareOfMedium * density.thickness, "a tenth of the medium's thickness");
  keep_in_medium(density.free_path, "the mean free path there");
  keep_below(kLargestRadius * diagonal, "a twentieth of the scene");
  return {rounded_radius(radius), reason};
}

ChosenCount choose_count(const PassCost& cost, double seconds) {
  const char* const others = cost.caustics > 0.0 ? "eye pass with the caustic photons" : "eye pass";
  const double rest = cost.rest(), balanced = rest / cost.photon;
  double count = balanced;
  std::string reason = fmt::format("tracing and sorting them takes as long as the {}, {:.2g} s", others, rest);
  const auto fit = [&](double passes) { return (seconds / passes - rest) / cost.photon; };  // so many passes
  const double least = kLeastPhotonShare * balanced;
  if (seconds > 0.0 && fit(kLeastPasses) < balanced) {
    count = std::max(fit(kLeastPasses), least);
    reason =
        count > least
            ? fmt::format("{} passes fit into {:g} s; the {} takes {:.2g} s", kLeastPasses, seconds, others, rest)
            : fmt::format("an eighth of the time of the {}, {:.2g} s; {} passes of that alone do not fit into {:g} s",
                          others, rest, kLeastPasses, seconds);
    if (fit(1) < count && fit(1) >= kLeastCount) {
      count = fit(1);
      reason = fmt::format("a pass fits into {:g} s; the {} takes {:.2g} s of these", seconds, others, rest);
    }
  }
  if (count * cost.stored_per_photon > kMostStored) {
    count = kMostStored / cost.stored_per_photon;
    reason = fmt::format("maps of {:g} photons, the most", kMostStored);
  }
  if (count < kLeastCount) return {kLeastCount, "the least; " + reason};
  return {static_cast<uint64_t>(rounded(count, 2)), reason};
}

ChosenCount make_fit(ChosenCount chosen, double seconds, const std::function<double(uint64_t)>& pass_seconds) {
  constexpr double kFewer = 0.125, kGain = 0.8;
  double taken = pass_seconds(chosen.count);
  while (taken > seconds && kFewer * static_cast<double>(chosen.count) >= static_cast<double>(kLeastCount)) {
    const auto fewer = static_cast<uint64_t>(rounded(kFewer * static_cast<double>(chosen.count), 2));
    const double less = pass_seconds(fewer);
    if (less > kGain * taken) break;
    chosen = {fewer,
              fmt::format("with more the radii would be smaller, and the eye pass longer: a pass takes {:.2g} s, "
                          "and would take {:.2g} s with {}",
                          less, taken, chosen.count)};
    taken = less;
  }
  return chosen;
}

ChosenCount choose_count_of_flights(double seconds, const std::function<PassCost(uint64_t)>& cost_of) {
  constexpr uint64_t kMore = 4;
  constexpr double kStoredOfFlight = (kFlightBytes + kBeamBytes) / kMapBytes;  // photons that take as much memory
  const double limit = seconds > 0.0 ? seconds / kLeastPasses : kInfinity;
  uint64_t count = kLeastCount;
  for (double before = 0.0;; count *= kMore) {
    const PassCost cost = cost_of(count);
    const auto photons = static_cast<double>(count);
    const double taken = cost.seconds(photons);
    if (taken > limit && count == kLeastCount)
      return {count, fmt::format("the least; a pass takes {:.2g} s, and {} do not fit into {:g} s", taken, kLeastPasses,
                                 seconds)};
    if (taken > limit) {  // between two numbers a pass goes by a power of them
      const double power = std::log(limit / before) / std::log(taken / before);
      return {static_cast<uint64_t>(rounded(photons / kMore * std::pow(double{kMore}, power), 2)),
              fmt::format("{} passes fit into {:g} s; most of their time goes with the flights that eye rays cross",
                          kLeastPasses, seconds)};
    }
    if (photons * cost.photon >= cost.rest())
      return {count,
              fmt::format("tracing and sorting them takes as long as the eye pass, {:.2g} s, or longer", cost.rest())};
    if (kMore * photons * (cost.stored_per_photon + kStoredOfFlight * cost.flights_per_photon) > kMostStored)
      return {count, fmt::format("maps of {} times as many would take the memory of more than {:g} photons, the most",
                                 kMore, kMostStored)};
    before = taken;
  }
}

size_t least_error(std::span<const double> errors) {
  constexpr double kClearlyLess = 0.9;
  size_t best = 0;
  for (size_t i = 1; i < errors.size(); ++i)
    if (errors[i] < kClearlyLess * errors[best]) best = i;
  return best;
}

StrategyCost cheapest(std::span<const StrategyCost> costs) {
  assert(!costs.empty());
  return *std::min_element(costs.begin(), costs.end(),
                           [](const StrategyCost& a, const StrategyCost& b) { return a.cost < b.cost; });
}

}  // namespace vpm
