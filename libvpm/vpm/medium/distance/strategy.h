// Distance sampling: one interface, and the list of strategies. Strategies of one kind share a file of this folder.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vpm/base/rng.h"
#include "vpm/base/settings/parameter.h"
#include "vpm/base/settings/range.h"
#include "vpm/base/vec.h"
#include "vpm/medium/medium.h"

namespace vpm {

inline constexpr double kNotKnown = -1.0;

/// A free flight through one medium.
struct Flight {
  float t = 0.0f;  // m along the ray: the collision's, or the interval's end
  bool collided = false;
  float density = 0.0f;  // that the collision was drawn from: sigma_t there is medium.sigma_t * density > 0 unless the
                         // weight is black
  Rgb weight{1.0f};      // the photon's power is multiplied by it
  double integral = kNotKnown;  // of density, up to t, m; not known to strategies that do not compute it
  uint32_t lookups = 0;         // of density
  uint32_t bricks = 0;          // of a grid, whose bounds were looked up
  uint32_t null_collisions = 0;
  uint32_t majorant_violations = 0;  // look-ups that found more than a majorant
};

/// Samples where a photon or a path from the eye collides next. Its weight makes the power the right one whatever the
/// distances' density: at a collision at distance d sigma_t(x) Tr(d) / pdf(d), at the interval's end Tr(D) / P(d > D)
/// [Jarosz2008, alg. 7.3, corrected]. Chromatic media are sampled by the mixture of the channels' densities, each with
/// the share of the photon's power in it.
class DistanceStrategy {
 public:
  virtual ~DistanceStrategy() = default;
  virtual Flight sample(const Medium& medium, const Ray& ray, const Interval& interval, const Rgb& power,
                        Rng& rng) const = 0;
};

struct DistanceSettings {
  std::string strategy = "regular";
  Parameters parameters{};  // numbers of that strategy: "step", ...
};

/// What flights are for.
struct FlightUse {
  uint64_t pass = 0;    // of the render; progressive-null goes by it
  bool density = true;  // is Flight::density needed? Else it may be any lower bound of it above 0
};

/// Majorants as a share of the largest density, as a parameter.
inline constexpr Range kMajorants{1e-6, 1.0, false, false};

template <class Strategy, class... Arguments>
std::unique_ptr<DistanceStrategy> made(Arguments... arguments) {
  return std::make_unique<Strategy>(arguments...);
}

/// A strategy, with what a user should know of it: each file of this folder has some, and strategy.cpp the list.
struct StrategyInfo {
  std::string_view name;
  std::string_view summary;
  std::string_view failure;   // where it costs much or errs
  std::string_view source;    // key of papers/references.bib
  bool heterogeneous = true;  // false: refused in grids
  bool unbiased = true;
  bool marches = false;  // in steps, whose length is its bias
  bool analog = true;    // draws from the medium's own transmittance, to the order of its bias
  bool bounded_weight = true;
  bool positive = true;  // false: weights of either sign; refused for photons, whose power must not be negative
  std::span<const Parameter> parameters{};
  std::unique_ptr<DistanceStrategy> (*make)(ParameterValues numbers, const FlightUse& use) = nullptr;
};
std::span<const StrategyInfo> distance_strategies();
/// The strategy of that name; null where there is none.
const StrategyInfo* find_strategy(std::string_view name);
/// The same of one that there is.
const StrategyInfo& strategy_info(std::string_view name);
/// The names of those of which this is so: strategies_that(&StrategyInfo::analog).
std::vector<std::string> strategies_that(bool StrategyInfo::*is);
/// The strategy of that name; null where there is none. Throws std::invalid_argument where it has no parameter of a
/// name that is given.
std::unique_ptr<DistanceStrategy> make_distance_strategy(const DistanceSettings& settings, const FlightUse& use = {});

/// Describes `type`, of these words, and the parameters of the strategy that it names.
void describe(DistanceSettings& settings, std::vector<std::string> types, const std::string& default_type,
              Description& description);

}  // namespace vpm
