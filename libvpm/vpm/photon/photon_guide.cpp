// Importons, then scouts that ask where photons get to.
#include "vpm/photon/photon_guide.h"

#include <utility>

#include "vpm/photon/emission.h"

namespace vpm {

PhotonGuide learn_guide(const Scene& scene, const DistanceStrategy& strategy, const GuideSettings& settings,
                        uint64_t seed, uint64_t pass, int max_events) {
  Importance importance = trace_importons(scene, strategy, settings, seed, pass, max_events);
  PhotonGuide guide{std::move(importance.map), std::move(importance.directions), {}, 0.0};
  const auto score = [&](const EmissionPoint& point, Rng& rng) {
    PathState state = emit_photon(scene, point);
    WalkCounters counters;
    const Event event = next_event(scene, strategy, state, rng, counters);
    if (event.kind == EventKind::escape || !is_finite(state.throughput)) return 0.0f;
    return sum_channels(state.throughput) * guide.importance.at(state.ray.origin);
  };
  guide.emission = EmissionGuide::learn(settings.importons, seed, rng_stream(RngUse::scout, pass), score);
  guide.value = guide.emission.mean_score();
  if (!settings.aim) guide.emission = EmissionGuide();
  return guide;
}

}  // namespace vpm
