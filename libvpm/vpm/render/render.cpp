// The loop over passes.
#include "vpm/render/render.h"

#include <algorithm>
#include <cassert>
#include <chrono>

#include "vpm/render/path_tracer.h"
#include "vpm/render/photon_pass.h"
#include "vpm/render/validate.h"

namespace vpm {
namespace {

using Clock = std::chrono::steady_clock;

/// How far a render is, from 0 to 1, in what limits it: passes, time or error (which falls about as passes grow).
double share_done(const RenderSettings& settings, const RenderResult& result) {
  if (settings.seconds == 0.0 && settings.error == 0.0)
    return static_cast<double>(result.film.passes()) / settings.passes;
  if (result.film.passes() == 0) return 0.0;
  double share = 0.0;
  if (settings.seconds > 0.0) share = result.seconds / settings.seconds;
  if (settings.error > 0.0) share = std::max(share, settings.error / estimated_error(result));
  return share;
}

/// Reads the errors off the film, where there are any.
void estimate_errors(RenderResult& result) {
  if (result.film.passes() > 1) result.errors = result.film.errors();
}

}  // namespace

RenderResult nothing_rendered(const Camera& camera) { return {Film(camera.width, camera.height), {}, 0.0, {}}; }

double estimated_error(const RenderResult& result) {
  if (result.film.passes() < kLeastPasses) return std::numeric_limits<double>::infinity();
  assert(result.errors);
  return result.errors->variance_part + std::max(0.0, result.errors->bias_part);
}

RenderResult render(const Scene& scene, const RenderSettings& settings, RenderResult result,
                    const std::atomic<bool>& stop, ProgressMode progress,
                    const std::function<void(const RenderResult&)>& finished) {
  validate(settings, facts_of(scene));
  const auto run = [&](const RenderResult& so_far, const PassProgress& shown) {
    const int pass = so_far.film.next_pass();
    return settings.integrator == Integrator::path
               ? render_path_pass(scene, settings, pass, stop, shown)
               : render_photon_pass_after(so_far.discs, scene, settings, {pass, stop, shown});
  };
  return run_passes(settings, run, tile_count(scene.camera), std::move(result), stop, progress, finished);
}

RenderResult run_passes(const RenderSettings& settings, const RunPass& run, uint64_t work, RenderResult result,
                        const std::atomic<bool>& stop, ProgressMode progress,
                        const std::function<void(const RenderResult&)>& finished) {
  const Clock::time_point start = Clock::now();
  const double before = result.seconds;
  // One pass shows its stages. Of several the whole is shown: as tiles of all passes, or as thousandths of the limit.
  const bool counted = settings.seconds == 0.0 && settings.error == 0.0;
  const int missing = counted ? std::max(0, settings.passes - result.film.passes()) : 0;
  const bool single = counted && missing == 1;
  Progress bar("render", counted ? work * static_cast<uint64_t>(missing) : 1000, progress_enabled(progress) && !single);
  const PassProgress pass_progress{progress_enabled(progress) && single, counted ? &bar : nullptr};
  if (settings.error > 0.0) estimate_errors(result);  // of a render that goes on
  while (!stop && share_done(settings, result) < 1.0) {
    const Pass done = run(result, pass_progress);
    if (stop) break;
    result.film.add(result.film.next_pass(), done.image, done.relative_square);
    result.errors.reset();
    if (settings.error > 0.0) estimate_errors(result);
    result.discs.resize(done.found.size());
    for (size_t i = 0; i < done.found.size(); ++i) shrink(result.discs[i], done.found[i]);
    result.statistics.merge(done.statistics);
    result.seconds = before + std::chrono::duration<double>(Clock::now() - start).count();
    if (!counted) {
      const auto reached = static_cast<uint64_t>(1000.0 * std::min(1.0, share_done(settings, result)));
      bar.advance(reached - std::min(reached, bar.done()));  // estimates of the error may rise
    }
    if (finished) finished(result);
  }
  bar.finish();
  if (!result.errors) estimate_errors(result);
  return result;
}

}  // namespace vpm
