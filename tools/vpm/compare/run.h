// One run of a comparison: a method on a scene with a seed of its own, looked at as it passes each budget.
#pragma once

#include <vector>

#include "vpm/base/progress.h"
#include "vpm/image/image.h"
#include "vpm/input/scene_file.h"
#include "vpm/integrators/choice.h"
#include "vpm/job/found_by_techniques.h"
#include "vpm/render/render.h"
#include "vpm/study/compare/experiment.h"

namespace vpm::tools {

/// What a run had reached when it passed a budget.
struct Snapshot {
  RunCost cost;
  Image mean;
};

/// A run, with what it chose before its passes.
struct MethodRun {
  std::vector<Choice> choices;
  std::vector<Snapshot> snapshots;
  // At the last budget, where its settings keep layers.
  std::vector<FoundByTechnique> techniques;
  std::vector<Image> parts;  // parts_of_techniques(), of the first repetition alone
};

/// Chooses what the job leaves to be chosen, for the time of the last budget, and renders passes until that is passed.
/// CPU time is that of choosing and rendering: what is done with snapshots does not count. Fewer snapshots than budgets
/// where the work was given up.
MethodRun run_method(const RenderJob& job, const ComparisonPlan& plan, int repetition);

/// Renders a scene until its estimated relative MSE is down to `error`, or the work is given up.
RenderResult run_reference(const RenderJob& job, double error, ProgressMode progress);

}  // namespace vpm::tools
