// The results of a comparison: as JSON for programs and the page, as CSV for tables, as text for the terminal.
#pragma once

#include <string>
#include <vector>

#include "vpm/input/scene_file.h"
#include "vpm/job/found_by_techniques.h"
#include "vpm/study/compare/summary.h"

namespace vpm::tools {

/// What a comparison found on one scene.
struct SceneResults {
  std::vector<std::string> hashes, settings;        // by method: of the scene with its options; settings_line()
  std::string scene_text;                           // of the scene file
  std::string reference;                            // where it is from, and how good it is
  double reference_error = 0.0;                     // relative MSE of the reference itself; 0: taken to be exact
  int width = 0, height = 0;                        // pixels
  std::vector<std::vector<BudgetSummary>> budgets;  // by method, then budget
  SceneSummary summary;
  std::vector<BiasEvidence> verdicts;                     // by method, at the last budget
  std::vector<std::vector<FoundByTechnique>> techniques;  // by method, at the last budget, where it keeps layers
};

/// Everything as JSON text: provenance, formulas, runs, summaries. The format is described in
/// scenes/experiments/README.md.
std::string results_json(const ComparisonPlan& plan, const std::vector<SceneResults>& scenes);

/// A line for each run at each budget, and one of column names before them.
std::string results_csv(const ComparisonPlan& plan, const std::vector<SceneResults>& scenes);

/// Tables at equal cost and at equal error, and which differences are significant.
std::string results_text(const ComparisonPlan& plan, const std::vector<SceneResults>& scenes);

/// "s of CPU time", "passes", ...
std::string unit_name(CostUnit unit);

}  // namespace vpm::tools
