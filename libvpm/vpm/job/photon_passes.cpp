// The loop over passes of photons.
#include "vpm/job/photon_passes.h"

#include <algorithm>

#include "vpm/base/cancel.h"
#include "vpm/base/settings/setting_error.h"
#include "vpm/photon/trace.h"

namespace vpm {
namespace {

Ledger trace_pass_number(int pass, const Scene& scene, const RenderSettings& settings, PhotonRecorder& recorder,
                         Progress& bar) {
  TraceSettings trace;
  trace.seed = settings.seed;
  trace.pass = static_cast<uint64_t>(pass);
  trace.emitted = settings.photons.emitted;
  trace.max_events = settings.max_events;
  trace.sequence = settings.photons.sequence;
  const auto strategy = make_distance_strategy(settings.distance, {.pass = trace.pass, .density = false});
  return trace_photons(scene, *strategy, trace, {&recorder}, bar);
}

}  // namespace

void check_photon_passes(const RenderSettings& settings) {
  const StrategyInfo& strategy = strategy_info(settings.distance.strategy);
  refuse_if(!strategy.analog, "integrator.distance.type",
            "flights by '" + settings.distance.strategy + "' do not end as the transmittance says",
            listed("these do", strategies_that(&StrategyInfo::analog)));
  refuse_if(
      !strategy.unbiased && !strategy.marches, "integrator.distance.type",
      "flights by '" + settings.distance.strategy + "' are of another law in each pass, so that errors are not known",
      listed("these are of one", strategies_that(&StrategyInfo::unbiased)));
  refuse_if(settings.importance.importons > 0, "integrator.importance.importons",
            "photons are counted everywhere, and would be guided to what the camera sees", "leave out 'importons'");
  refuse_if(settings.photons.emitted == 0, "integrator.photons.emitted", "passes would have no end",
            "say how many photons a pass emits");
}

PhotonPasses run_photon_passes(const Scene& scene, const RenderSettings& settings, const PhotonRun& run,
                               PhotonRecorder& recorder, const std::function<void(const Ledger&, int)>& take) {
  const auto& [passes, first, seconds, error] = run.until;
  const bool timed = seconds > 0.0;
  const bool shown = progress_enabled(run.progress);
  constexpr uint64_t kParts = 1000;  // of the time
  Progress bar("photons", timed ? kParts : settings.photons.emitted * static_cast<uint64_t>(passes), shown);
  Progress uncounted("", 0, false);
  PhotonPasses made;
  const double start = run.clock->seconds();
  double last = 0.0;  // s that the last pass took
  const auto goes_on = [&] {
    return timed ? made.passes == 0 || run.clock->seconds() + last <= seconds : made.passes < passes;
  };
  try {
    while (goes_on()) {
      const double begin = run.clock->seconds();
      const Ledger ledger = trace_pass_number(first + made.passes, scene, settings, recorder, timed ? uncounted : bar);
      const CancelledWith nothing(nullptr);  // what is finished counts
      take(ledger, ++made.passes);
      made.ledger.merge(ledger);
      last = run.clock->seconds() - begin;
      const double over = (run.clock->seconds() - start) / std::max(seconds - start, last);
      if (timed) bar.advance(static_cast<uint64_t>(kParts * std::min(1.0, over)) - bar.done());
    }
  } catch (const Cancelled&) {
    if (made.passes == 0) throw;
    made.interrupted = true;
  }
  bar.finish();
  return made;
}

}  // namespace vpm
