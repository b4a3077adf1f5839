// One run of a comparison: a method on a scene with a seed of its own, looked at as it passes each budget.
#pragma once

#include <atomic>
#include <vector>

#include "base/progress.h"
#include "image/image.h"
#include "input/scene_file.h"
#include "render/render.h"
#include "study/compare/plan.h"

namespace vpm::tools {

/// What a run had reached when it passed a budget.
struct Snapshot {
  RunCost cost;
  Image mean;
};

/// Renders passes until the last budget is passed. CPU time is that of rendering alone: what is done with snapshots
/// does not count. Fewer snapshots than budgets where `stop` was set.
std::vector<Snapshot> run_method(const LoadedScene& loaded, const ComparisonPlan& plan, int repetition,
                                 const std::atomic<bool>& stop);

/// Renders a scene by the path tracer until its estimated relative MSE is down to `error`. Its variance is that of its
/// mean. Without passes where `stop` was set before there were some.
RenderResult run_referee(const LoadedScene& loaded, double error, const std::atomic<bool>& stop, ProgressMode progress);

}  // namespace vpm::tools
