// The list of distance strategies.
#include "vpm/medium/distance/strategy.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "vpm/medium/distance/strategies.h"

namespace vpm {

namespace {

constexpr std::array<StrategyInfo, 11> kStrategies{{
    {.name = "regular",
     .summary = "exact in any medium: cells walked, the quartic density integral inverted",
     .failure = "a step for every cell crossed, however thin the medium is there",
     .source = "Novak2018"},
    {.name = "homogeneous",
     .summary = "exact in a medium of constant density",
     .failure = "no other medium: refused in grids",
     .source = "Jarosz2008",
     .heterogeneous = false},
    {.name = "local-extinction",
     .summary = "exponential at the rate where the segment starts; weights without bound",
     .failure = "a dense start followed by thin voxels: flights that leave have weights without bound",
     .source = "Jarosz2008",
     .analog = false,
     .bounded_weight = false},
    {.name = "mean-extinction",
     .summary = "exponential at the medium's mean rate; weights without bound",
     .failure = "stretches below half the mean extinction: the variance grows without bound along them",
     .source = "Jarosz2008",
     .analog = false,
     .bounded_weight = false},
    {.name = "ray-march",
     .summary = "marched until the transmittance reaches the random number; bias falls as step^2",
     .failure = "spikes thinner than a step are missed",
     .source = "Jarosz2008",
     .unbiased = false,
     .marches = true},
    {.name = "ray-march-adaptive",
     .summary = "the same in steps of an optical thickness, by local majorants; bias falls as step^2",
     .failure = "spikes thinner than a step, which a spike in the same brick shortens to a sixteenth at the least, "
                "are missed",
     .source = "Danskin1992",
     .unbiased = false,
     .marches = true},
    {.name = "delta",
     .summary = "exact: null collisions under the medium's largest density",
     .failure = "one dense voxel makes nearly all collisions null, at a look-up each, everywhere",
     .source = "Woodcock1965"},
    {.name = "delta-local",
     .summary = "exact: null collisions under the largest density of each brick",
     .failure = "one dense voxel makes nearly all collisions in its brick null",
     .source = "SzirmayKalos2011"},
    {.name = "progressive-null",
     .summary = "null collisions under majorants that grow from pass to pass; biased until they bound",
     .failure = "the first passes see a medium too thin, which leaves the mean only as 1/passes",
     .source = "Misso2023",
     .unbiased = false},
    {.name = "weighted",
     .summary = "exact: null collisions under majorants that need not bound, by weights of either sign; for paths",
     .failure = "densities above the majorant: weights beyond 1 multiply along the path, and the variance grows "
                "exponentially with the collisions there",
     .source = "Galtier2013",
     .analog = false,
     .bounded_weight = false,
     .positive = false},
    {.name = "decomposition",
     .summary = "exact: each brick's least density without look-ups, the rest by null collisions",
     .failure = "bricks whose least density is near 0: there it is delta-local",
     .source = "Kutz2017"},
}};

}  // namespace

std::span<const StrategyInfo> distance_strategies() { return kStrategies; }

const StrategyInfo& strategy_info(std::string_view name) {
  const auto all = distance_strategies();
  const auto found = std::find_if(all.begin(), all.end(), [&](const StrategyInfo& info) { return info.name == name; });
  assert(found != all.end());
  return *found;
}

std::unique_ptr<DistanceStrategy> make_distance_strategy(const DistanceSettings& settings, const FlightUse& use) {
  if (settings.strategy == "regular") return std::make_unique<Regular>();
  if (settings.strategy == "homogeneous") return std::make_unique<Homogeneous>();
  if (settings.strategy == "local-extinction") return std::make_unique<LocalExtinction>(settings.extinction_floor);
  if (settings.strategy == "mean-extinction") return std::make_unique<MeanExtinction>();
  if (settings.strategy == "ray-march") return std::make_unique<RayMarch>(settings.step);
  if (settings.strategy == "ray-march-adaptive")
    return std::make_unique<RayMarchAdaptive>(settings.step, settings.optical_step);
  if (settings.strategy == "delta") return std::make_unique<Delta>();
  if (settings.strategy == "delta-local") return std::make_unique<DeltaLocal>();
  if (settings.strategy == "progressive-null") return std::make_unique<ProgressiveNull>(settings.majorant, use.pass);
  if (settings.strategy == "weighted") return std::make_unique<Weighted>(settings.majorant);
  if (settings.strategy == "decomposition") return std::make_unique<Decomposition>(use.density);
  return nullptr;
}

}  // namespace vpm
