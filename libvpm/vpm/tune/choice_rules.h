// The rules by which a render chooses settings, each a pure function.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "vpm/tune/pass_cost.h"
#include "vpm/tune/pilot.h"

namespace vpm {

/// A positive value of so many decimal digits: enough for a choice, and short to write down.
double rounded(double value, int digits);
/// A radius, of three digits.
float rounded_radius(double radius);

struct ChosenRadius {
  float radius = 0.0f;  // m, of three digits
  std::string reason;
};
/// The radius within which kPhotonsWithin of `emitted` photons or of their flights lie, but no less than half a pixel,
/// as finer kernels show as noise. These bounds go before that: in media no more than a tenth of their thickness and
/// than the mean free path, as wider ones take in photons that have little to do with the place, unless less than
/// kLeastWithin were within; and no more than a twentieth of `diagonal` (m), as wider ones blur the scene.
ChosenRadius choose_radius(const MapDensity& density, double emitted, double diagonal);
inline constexpr double kPhotonsWithin = 50.0, kLeastWithin = 10.0;
inline constexpr double kLargestRadius = 0.05, kShareOfMedium = 0.1;  // of the diagonal, of a medium's thickness

struct ChosenCount {
  uint64_t count = 0;  // of two digits
  std::string reason;
};
/// As many photons as cost what the rest of a pass costs; fewer, down to an eighth, where kLeastPasses passes would not
/// fit into `seconds` (0: no limit), and fewer yet where that lets one pass fit; and no more than fill maps of
/// kMostStored.
ChosenCount choose_count(const PassCost& cost, double seconds);
inline constexpr double kPassesShare = 0.75;  // of the seconds of a render, that a pilot leaves to passes
inline constexpr uint64_t kLeastCount = 1000;
inline constexpr double kMostStored = 2e7;

/// Fewer photons where a pass takes longer than `seconds` and less with fewer, as radii that hold so many photons are
/// wider then; an eighth of them, and again, until a pass fits or gains no more. `pass_seconds`(photons) times a pass.
ChosenCount make_fit(ChosenCount chosen, double seconds, const std::function<double(uint64_t)>& pass_seconds);

/// How many photons there are where flights are gathered. Eye rays cross more flights where there are more photons,
/// also under radii that are chosen for their number. So a pass is timed with ever more photons, by `cost_of`(photons),
/// until kLeastPasses passes would not fit into `seconds` (0: no limit), photons cost what the eye pass costs, or maps
/// are full.
ChosenCount choose_count_of_flights(double seconds, const std::function<PassCost(uint64_t)>& cost_of);

/// Which is least; of those that differ by less than a tenth the first.
size_t least_error(std::span<const double> errors);

/// The cheapest; of equals the first.
StrategyCost cheapest(std::span<const StrategyCost> costs);

}  // namespace vpm
