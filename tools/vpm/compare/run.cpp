// Passes, with a look at their cost after each.
#include "compare/run.h"

#include <atomic>
#include <ctime>
#include <utility>

#include "vpm/base/cancel.h"
#include "vpm/base/clock.h"
#include "vpm/base/parallel.h"
#include "vpm/base/vec.h"
#include "vpm/integrators/describe.h"
#include "vpm/integrators/render_scene.h"
#include "vpm/render/render.h"
#include "vpm/tune/automatic.h"

namespace vpm::tools {
namespace {

/// CPU time of this process, all threads together, s.
double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

RunCost counted(const RenderStatistics& s) {
  RunCost cost;
  cost.passes = static_cast<uint64_t>(s.passes);
  cost.photons = s.ledger.emitted_count;
  cost.stored = s.volume_photons + s.surface_photons + s.caustic_photons + s.guiding_photons;
  WalkCounters walk = s.ledger.walk;
  walk.merge(s.eye.walk);
  cost.lookups = walk.lookups;
  cost.photon_lookups = s.ledger.walk.lookups;
  cost.bricks = walk.bricks;
  cost.null_collisions = walk.null_collisions;
  cost.majorant_violations = walk.majorant_violations;
  cost.searches = s.eye.gather.searches;
  cost.photons_visited = s.eye.gather.visited;
  cost.photons_used = s.eye.gather.used;
  cost.bytes = s.photon_map_bytes + s.guide_bytes;
  const WeightMoments& weights = cost.photons > 0 ? s.ledger.weights : s.eye.weights;
  cost.largest_weight = weights.largest;
  cost.effective_sample_size = weights.effective_sample_size();
  return cost;
}

}  // namespace

MethodRun run_method(const RenderJob& job, const ComparisonPlan& plan, int repetition) {
  RenderSettings settings = job.settings;
  settings.seed = plan.seed + static_cast<uint64_t>(repetition);
  double cpu = 0.0, wall = 0.0;  // s
  double cpu_begin = cpu_seconds();
  Stopwatch rendering;
  MethodRun run;
  if (!job.automatic.keys.empty()) {
    settings.until = {.seconds = plan.budgets.back() / thread_count()};
    run.choices = choose_settings(job.scene, job.automatic, WallClock(), settings);
  }
  settings.until = {.passes = kMostPasses};
  std::vector<Snapshot>& snapshots = run.snapshots;
  std::atomic<bool> done{false};
  const auto look = [&](const RenderResult& so_far) {
    cpu += cpu_seconds() - cpu_begin;
    wall += rendering.seconds();
    RunCost cost = counted(so_far.statistics);
    cost.cpu_seconds = cpu;
    cost.wall_seconds = wall;
    while (snapshots.size() < plan.budgets.size() && cost_in(plan.unit, cost) >= plan.budgets[snapshots.size()])
      snapshots.push_back({cost, so_far.film.mean()});
    done = snapshots.size() == plan.budgets.size();
    cpu_begin = cpu_seconds();
    rendering = {};
  };
  RenderResult result = nothing_rendered(job.scene.camera);
  {
    const CancelScope at_last_budget(done);
    result = render(job.scene, settings, std::move(result), {ProgressMode::never, look});
  }
  run.techniques = found_by_techniques(settings, result);
  if (repetition == 0) run.parts = parts_of_techniques(settings, result);
  return run;
}

RenderResult run_reference(const RenderJob& job, double error, ProgressMode progress) {
  RenderSettings settings = job.settings;
  settings.until = {.error = error};
  return render(job.scene, settings, nothing_rendered(job.scene.camera), {progress});
}

}  // namespace vpm::tools
