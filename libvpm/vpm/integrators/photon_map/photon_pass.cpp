// Photon tracing, building the estimators, and the eye pass, in that order.
#include "vpm/integrators/photon_map/photon_pass.h"

#include <algorithm>
#include <optional>

#include "vpm/base/clock.h"
#include "vpm/integrators/photon_map/eye_path.h"
#include "vpm/integrators/photon_map/volume/estimator_info.h"
#include "vpm/photon/map/photon_table.h"
#include "vpm/photon/trace.h"

namespace vpm {
namespace {

/// Points of a sequence keep away from each other. Estimates that take photons for independent of each other would be
/// biased: density by how far the nearest ones are, and irradiance at places that photons found. What a guide makes of
/// the points is not even any more.
PhotonSequence sequence_of(const RenderSettings& settings) {
  const bool of_ends =
      settings.caustics.mode == GatherMode::nearest || settings.indirect.irradiance == EndIrradiance::precomputed;
  const bool random = settings.importance.importons > 0 || settings.volume.info().mode == GatherMode::nearest ||
                      settings.surface.mode == GatherMode::nearest || (settings.gathers_finally() && of_ends);
  return random ? PhotonSequence::random : settings.photons.sequence;
}

TraceSettings trace_settings(const RenderSettings& settings, const PassRun& run) {
  TraceSettings trace;
  trace.seed = settings.seed;
  trace.pass = static_cast<uint64_t>(run.pass);
  trace.sequence = sequence_of(settings);
  const PhotonBlock block = run.block.value_or(PhotonBlock{0, settings.photons.emitted});
  trace.first = block.first;
  trace.emitted = block.count;
  trace.stored = settings.photons.stored;
  trace.max_events = settings.max_events;
  return trace;
}

/// The boxes around the photons of all blocks. These are traced for that alone, and dropped.
MediaBounds bounds_of_blocks(const Scene& scene, const RenderSettings& settings, const PassRun& run,
                             RenderStatistics& statistics) {
  MediaBounds around(scene.media.size());
  for (uint64_t number = 0; number < block_count(settings); ++number) {
    Estimators estimators = plan_estimators(scene, settings, run.pass);
    estimators.surface.reset();
    RenderStatistics traced;
    trace_pass(scene, settings, estimators, {run.pass, run.progress, photon_block(settings, number)}, traced);
    statistics.guide_seconds += traced.guide_seconds;
    statistics.trace_seconds += traced.trace_seconds;
    for (const MapInfo& map : estimators.maps())
      for (size_t medium = 0; medium < around.size(); ++medium) around[medium].add(bounds_of((*map.media)[medium]));
  }
  return around;
}

/// Traces and gathers the photons of a block.
Pass render_block(const Scene& scene, const RenderSettings& settings, const PassRun& run,
                  const Estimators& estimators) {
  RenderStatistics statistics;
  prepare_pass(scene, settings, estimators, run, statistics);
  const EyeContext context{scene, estimators, settings.max_events, run.lamp_images};
  const RadianceOfRays radiance = [&](std::span<EyeRay> rays) { eye_radiance(context, rays); };
  Pass result = render_image(scene, settings, run.pass, radiance, run.progress, settings.square);
  if (estimators.surface) result.found = estimators.surface->take_found();
  result.statistics.merge(statistics);
  return result;
}

}  // namespace

void trace_pass(const Scene& scene, const RenderSettings& settings, const Estimators& estimators, const PassRun& run,
                RenderStatistics& statistics, const Recorders& more) {
  Recorders recorders = estimators.recorders();
  recorders.insert(recorders.end(), more.begin(), more.end());
  if (recorders.empty()) return;
  TraceSettings trace = trace_settings(settings, run);
  const bool density = std::any_of(recorders.begin(), recorders.end(),
                                   [](const PhotonRecorder* recorder) { return recorder->reads_density(); });
  const auto strategy = make_distance_strategy(settings.distance, {.pass = trace.pass, .density = density});
  std::optional<PhotonGuide> guide;
  if (settings.importance.importons > 0) {
    const Stopwatch learning;
    guide = learn_guide(scene, *strategy, settings.importance, trace.seed, trace.pass, settings.max_events);
    trace.guide = &*guide;
    trace.split = settings.importance.split;
    statistics.guide_seconds = learning.seconds();
    statistics.guide_bytes = guide->memory_bytes();
  }
  const Stopwatch tracing;
  Progress bar("photons", trace.emitted, run.progress.stages);
  statistics.ledger = trace_photons(scene, *strategy, trace, recorders, bar);
  bar.finish();
  statistics.trace_seconds = tracing.seconds();
  for (Estimator* estimator : estimators.all())
    estimator->trace_more({*strategy, trace, statistics.ledger.emitted_count}, statistics);
}

void trace_pass(const Scene& scene, const RenderSettings& settings, const Estimators& estimators, const PassRun& run,
                RenderStatistics& statistics) {
  trace_pass(scene, settings, estimators, run, statistics, {});
}

void prepare_pass(const Scene& scene, const RenderSettings& settings, const Estimators& estimators, const PassRun& run,
                  RenderStatistics& statistics) {
  trace_pass(scene, settings, estimators, run, statistics);
  const Stopwatch building;
  for (Estimator* estimator : estimators.all()) estimator->build(statistics.ledger.emitted_count, statistics);
  statistics.build_seconds = building.seconds();
}

int tracings_of_pass(const Scene& scene, const RenderSettings& settings) {
  const VolumeEstimatorInfo& volume = settings.volume.info();
  const bool marches = !volume.along_rays && !volume.flights && facts_of(scene).scattering_media;
  return marches && block_count(settings) > 1 ? 2 : 1;
}

Pass render_photon_pass(const Scene& scene, const RenderSettings& settings, int pass, const PassProgress& progress) {
  return render_photon_pass_after({}, scene, settings, {pass, progress});
}

Pass render_photon_pass_after(const PixelDiscs& discs, const Scene& scene, const RenderSettings& settings,
                              const PassRun& run) {
  RenderStatistics looking;
  std::optional<MediaBounds> around;
  if (tracings_of_pass(scene, settings) > 1) around = bounds_of_blocks(scene, settings, run, looking);
  Pass pass = mean_of_blocks(settings, [&](const PhotonBlock& block) {
    return render_block(scene, settings, {run.pass, run.progress, block, run.lamp_images},
                        plan_estimators(scene, settings, run.pass, discs, around ? &*around : nullptr));
  });
  looking.merge(pass.statistics);
  pass.statistics = looking;
  return pass;
}

}  // namespace vpm
