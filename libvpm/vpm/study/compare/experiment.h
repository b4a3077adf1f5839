// What a comparison of methods is asked for: which scenes, which methods, how much each may cost, how often. Its TOML
// file becomes an Experiment; scenes/experiments/README.md describes the format.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vpm/base/counters.h"

namespace vpm {

/// What a method's cost is measured in.
enum class CostUnit {
  seconds,  // of CPU time, all threads together
  passes,
  photons,  // emitted
  lookups   // of density by photons and eye paths
};

/// A way to render: keys of the scene file, changed.
struct Method {
  std::string name;
  std::vector<std::string> settings;  // key.path=value
  std::string place;                  // in the experiment's file, for messages
};

/// What a scene's pictures are compared with.
enum class ReferenceSource { rendered, file, exact };

/// How a reference is rendered.
struct RenderedReference {
  std::vector<std::string> settings{"integrator.type=\"path\""};  // key.path=value
  double error = 1e-4;                                            // estimated relative MSE that it goes down to, > 0
};

struct ComparedScene {
  std::string name;
  std::string file;                   // a scene file
  std::vector<std::string> settings;  // key.path=value, of all methods and the reference
  ReferenceSource source = ReferenceSource::rendered;
  std::string reference_file;
  RenderedReference rendered;
  std::string place;  // in the experiment's file, for messages
};

struct ComparisonPlan {
  std::string title;
  std::string text;  // of its file
  std::vector<ComparedScene> scenes;
  std::vector<Method> methods;
  std::optional<size_t> baseline;  // the method whose bias all methods have in common, as that of a kernel
  CostUnit unit = CostUnit::seconds;
  std::vector<double>
      budgets;           // in that unit, > 0, rising: a run goes on to the last and is looked at as it passes each
  int repetitions = 10;  // >= 3, with seeds of their own
  uint64_t seed = 1;     // of the first repetition
};

/// What a run had cost when it passed a budget, and what it had counted.
struct RunCost {
  double cpu_seconds = 0.0, wall_seconds = 0.0;
  uint64_t passes = 0;
  uint64_t photons = 0;                      // emitted
  uint64_t stored = 0;                       // in all maps
  uint64_t lookups = 0, photon_lookups = 0;  // of density: by all, by photons
  uint64_t bricks = 0;                       // of grids, whose bounds were looked up
  uint64_t null_collisions = 0;              // of flights
  uint64_t majorant_violations = 0;          // see WalkCounters
  uint64_t searches = 0;                     // of photon maps
  uint64_t photons_visited = 0;              // by these, see GatherCounters
  uint64_t photons_used = 0;
  uint64_t bytes = 0;                  // of photon maps and guides, of the largest pass
  double largest_weight = 0.0;         // of photons, see Ledger; of paths, see EyeCounters
  double effective_sample_size = 0.0;  // of these

  /// With the names they have in files.
  static constexpr auto counters() {
    using C = RunCost;
    return std::tuple{Counter{"cpu_seconds", &C::cpu_seconds},
                      Counter{"wall_seconds", &C::wall_seconds},
                      Counter{"passes", &C::passes},
                      Counter{"photons", &C::photons},
                      Counter{"stored", &C::stored},
                      Counter{"lookups", &C::lookups},
                      Counter{"photon_lookups", &C::photon_lookups},
                      Counter{"bricks", &C::bricks},
                      Counter{"null_collisions", &C::null_collisions},
                      Counter{"majorant_violations", &C::majorant_violations},
                      Counter{"searches", &C::searches},
                      Counter{"photons_visited", &C::photons_visited},
                      Counter{"photons_used", &C::photons_used},
                      Counter{"bytes", &C::bytes},
                      Counter{"largest_weight", &C::largest_weight},
                      Counter{"effective_sample_size", &C::effective_sample_size}};
  }
};
static_assert(lists_every_member<RunCost>());

/// That cost in a unit.
inline double cost_in(CostUnit unit, const RunCost& cost) {
  switch (unit) {
    case CostUnit::seconds:
      return cost.cpu_seconds;
    case CostUnit::passes:
      return static_cast<double>(cost.passes);
    case CostUnit::photons:
      return static_cast<double>(cost.photons);
    case CostUnit::lookups:
      break;
  }
  return static_cast<double>(cost.lookups);
}

/// Reads an experiment. `overrides` are `key.path=value` options that change keys of the file first, as those of
/// load_scene(). Paths in the file are relative to its folder. The scenes it names are not read. Throws InputError for
/// anything that is not right, with file:line:column, or the option.
ComparisonPlan load_comparison_plan(const std::string& path, const std::vector<std::string>& overrides = {});

}  // namespace vpm
