// Photon tracing, map building and the eye pass, in that order.
#include "vpm/render/photon_pass.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <optional>

#include "vpm/base/parallel.h"
#include "vpm/photon/caustics.h"
#include "vpm/photon/density_control.h"
#include "vpm/photon/trace.h"
#include "vpm/render/eye_path.h"
#include "vpm/render/gather_guide.h"
#include "vpm/render/radius_schedule.h"

namespace vpm {
namespace {

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

TraceSettings trace_settings(const RenderSettings& settings, const Stages& stages, int pass,
                             const std::atomic<bool>& stop) {
  TraceSettings trace;
  trace.seed = settings.seed;
  trace.pass = static_cast<uint64_t>(pass);
  trace.emitted = settings.photons_emitted;
  trace.stored = settings.photons_stored;
  trace.max_events = settings.max_events;
  trace.keep_volume = stages.volume_map;
  trace.keep_surface = stages.surface_map;
  trace.keep_direct_volume = !stages.volume_shadow_rays;
  trace.keep_direct_surface = !stages.surface_shadow_rays || stages.final_gather;  // rays that gather end in all light
  trace.keep_caustics = stages.final_gather;
  trace.keep_direct_caustics = !stages.surface_shadow_rays;
  trace.keep_specular_caustics = settings.caustics_emitted == 0;
  trace.keep_from_rough = stages.guided_gather;
  trace.keep_sites = stages.irradiance_points;
  trace.volume_form = settings.volume_form;
  trace.density_floor = settings.density_floor;
  trace.stop = &stop;
  return trace;
}

/// Do radii shrink from pass to pass? Not the largest radius of the nearest mode.
bool shrinks(const GatherSettings& gather, const RenderSettings& settings) {
  return settings.radii != RadiusSchedule::constant && gather.mode != GatherMode::nearest;
}

/// The settings of a map in this pass. Those of pixels with radii of their own are near it: in even light these shrink
/// nearly so.
GatherSettings gather_in_pass(GatherSettings gather, float first_radius, int dimension, const RenderSettings& settings,
                              int pass) {
  gather.radius = shrinks(gather, settings) ? radius_of_pass(first_radius, dimension, pass) : first_radius;
  return gather;
}

/// A kind of map, as a pass uses it.
struct UsedMap {
  const char* name;
  int dimension;
  bool shrinks;  // by the number of the pass
};
std::vector<UsedMap> used_maps(const RenderSettings& settings, const Stages& stages) {
  std::vector<UsedMap> maps;
  if (stages.volume_map) maps.push_back({"volume", stages.beams ? 2 : 3, shrinks(settings.volume, settings)});
  if (stages.surface_map) maps.push_back({"surface", 2, shrinks(settings.surface, settings) && !stages.pixel_discs});
  if (stages.final_gather) maps.push_back({"caustics", 2, shrinks(settings.caustics, settings)});
  return maps;
}

/// The radii of the pixels' discs in a pass, m.
std::vector<float> pixel_radii(const Scene& scene, const RenderSettings& settings, const PixelDiscs& discs) {
  const float first = first_surface_radius(scene, settings);
  std::vector<float> radii(static_cast<size_t>(scene.camera.width) * static_cast<size_t>(scene.camera.height), first);
  assert(discs.empty() || discs.size() == radii.size());
  for (size_t i = 0; i < discs.size(); ++i) radii[i] = disc_radius(discs[i], first);
  return radii;
}

float default_share(const GatherSettings& gather) { return gather.goes_by_count() ? kDefaultSearch : kDefaultRadius; }

/// Adds `emitted` caustic photons that are aimed, with powers as if they were as many as the others.
void add_caustics(const Scene& scene, const DistanceStrategy& strategy, uint64_t emitted, const TraceSettings& trace,
                  TracedPhotons& photons) {
  CausticSettings aimed{trace.seed, trace.pass, emitted, trace.max_events, nullptr, trace.stop};
  if (trace.guide) aimed.importance = &trace.guide->importance;
  const auto share =
      static_cast<float>(static_cast<double>(photons.ledger.emitted_count) / static_cast<double>(aimed.emitted));
  for (Photon& photon : trace_caustics(scene, strategy, aimed)) {
    photon.power *= share;
    photons.caustics.push_back(photon);
  }
}

/// Merges photons where the settings ask for that.
void merge_photons(std::vector<Photon>& photons, const GatherSettings& gather, const RenderSettings& settings,
                   RenderStatistics& statistics) {
  if (settings.photons_in_cube > 0 && gather.mode != GatherMode::nearest)
    statistics.merged_photons += control_density(photons, 0.5f * gather.radius, settings.photons_in_cube);
}

/// A map of photons of which that many were emitted.
PhotonMap make_map(std::vector<Photon>& photons, const GatherSettings& gather, uint64_t emitted,
                   const RenderSettings& settings, RenderStatistics& statistics) {
  merge_photons(photons, gather, settings, statistics);
  PhotonMap map = make_photon_map(std::move(photons), gather, emitted);
  statistics.photon_map_bytes += map.memory_bytes();
  return map;
}

/// The same for the rays of the eye.
/// `shrunk`: the pass's radius over that of the first.
BeamMap make_beam_map(std::vector<Photon>& photons, const GatherSettings& gather, float shrunk, uint64_t emitted,
                      const RenderSettings& settings, RenderStatistics& statistics) {
  merge_photons(photons, gather, settings, statistics);
  const auto scale = static_cast<float>(1.0 / static_cast<double>(emitted));
  BeamMap map{gather, SegmentMap(std::exchange(photons, {}), {gather.radius, gather.beam_count, shrunk}, scale)};
  statistics.photon_map_bytes += map.photons.memory_bytes();
  return map;
}

/// Makes what final gathering needs besides the surface map.
void make_gathering(EyeContext& context, TracedPhotons& photons, int pass, RenderStatistics& statistics) {
  const RenderSettings& settings = context.settings;
  const uint64_t emitted = photons.ledger.emitted_count;
  const float caustic_radius = first_caustic_radius(context.scene, settings);
  statistics.caustic_photons = photons.caustics.size();
  context.caustics = make_map(photons.caustics, gather_in_pass(settings.caustics, caustic_radius, 2, settings, pass),
                              emitted, settings, statistics);
  if (context.stages.guided_gather) {
    GatherSettings gather = kGuidingPhotons;
    gather.radius = kDefaultSearch * context.scene.bounds.diagonal();
    statistics.guiding_photons = photons.from_rough.size();
    context.from_rough = make_map(photons.from_rough, gather, emitted, settings, statistics);
  }
  if (context.stages.irradiance_points) {
    context.irradiance = IrradiancePoints(photons.sites, context.surface, statistics.eye.gather);
    statistics.irradiance_points = context.irradiance.size();
    statistics.photon_map_bytes += context.irradiance.memory_bytes();
  }
}

/// Sorts the photons of a pass into the context's maps.
void make_maps(EyeContext& context, TracedPhotons photons, int pass, RenderStatistics& statistics) {
  const Scene& scene = context.scene;
  const RenderSettings& settings = context.settings;
  const Stopwatch building;
  for (size_t m = 0; context.stages.volume_map && m < scene.media.size(); ++m) {
    const float first = first_volume_radius(scene, settings, scene.media[m]);
    statistics.volume_photons += photons.volume[m].size();
    const GatherSettings gather = gather_in_pass(settings.volume, first, context.stages.beams ? 2 : 3, settings, pass);
    const uint64_t emitted = photons.ledger.emitted_count;
    if (context.stages.beams)
      context.beams.push_back(
          make_beam_map(photons.volume[m], gather, gather.radius / first, emitted, settings, statistics));
    else
      context.volume.push_back(make_map(photons.volume[m], gather, emitted, settings, statistics));
    statistics.last_volume_radius = std::max(statistics.last_volume_radius, gather.radius);
  }
  if (context.stages.surface_map) {
    const float first = first_surface_radius(scene, settings);
    statistics.surface_photons = photons.surface.size();
    context.surface = make_map(photons.surface, gather_in_pass(settings.surface, first, 2, settings, pass),
                               photons.surface_emitted, settings, statistics);
    statistics.last_surface_radius = context.surface.settings.radius;
  }
  if (context.stages.final_gather) make_gathering(context, photons, pass, statistics);
  statistics.build_seconds = building.seconds();
}

}  // namespace

Stages plan_stages(const Scene& scene, const RenderSettings& settings) {
  Scattering scattering;
  for (const Medium& medium : scene.media) scattering.media |= medium.scatters();
  for (const Shape& shape : scene.shapes) scattering.surfaces |= is_rough(scene.materials[shape.material]);
  return plan_stages(scattering, settings);
}

Stages plan_stages(const Scattering& scattering, const RenderSettings& settings) {
  if (settings.integrator == Integrator::path) return {};
  assert(settings.surface_direct != DirectLight::equiangular);
  const auto [scatters, rough] = scattering;
  const bool gather = rough && settings.surface_indirect == IndirectLight::final_gather;
  return {.volume_map = scatters,
          .beams = scatters && settings.volume.mode == GatherMode::beam,
          .surface_map = rough,
          .volume_shadow_rays = scatters && settings.volume_direct != DirectLight::photons,
          .equiangular = scatters && settings.volume_direct == DirectLight::equiangular,
          .surface_shadow_rays = rough && settings.surface_direct == DirectLight::shadow_rays,
          .final_gather = gather,
          .guided_gather = gather && settings.gather_by == GatherBy::photons,
          .irradiance_points = gather && settings.end_irradiance == EndIrradiance::precomputed,
          .pixel_discs = rough && settings.radii == RadiusSchedule::per_pixel};
}

float first_volume_radius(const Scene& scene, const RenderSettings& settings, const Medium& medium) {
  if (settings.volume.radius > 0.0f) return settings.volume.radius;
  return default_share(settings.volume) * (medium.grid ? medium.grid->bounds().diagonal() : scene.bounds.diagonal());
}

float first_surface_radius(const Scene& scene, const RenderSettings& settings) {
  return settings.surface.radius > 0.0f ? settings.surface.radius
                                        : default_share(settings.surface) * scene.bounds.diagonal();
}

float first_caustic_radius(const Scene& scene, const RenderSettings& settings) {
  return settings.caustics.radius > 0.0f ? settings.caustics.radius
                                         : default_share(settings.caustics) * scene.bounds.diagonal();
}

TracedPhotons trace_pass(const Scene& scene, const RenderSettings& settings, const Stages& stages, int pass,
                         const std::atomic<bool>& stop, const PassProgress& progress, RenderStatistics& statistics) {
  TraceSettings trace = trace_settings(settings, stages, pass, stop);
  const std::unique_ptr<DistanceStrategy> strategy = make_distance_strategy(
      settings.distance,
      {.pass = trace.pass, .density = trace.keep_volume && trace.volume_form == VolumeForm::density_at_query});
  std::optional<PhotonGuide> guide;
  if (settings.guide.importons > 0) {
    const Stopwatch learning;
    guide = learn_guide(scene, *strategy, settings.guide, trace.seed, trace.pass, settings.max_events);
    trace.guide = &*guide;
    trace.split = settings.guide.split;
    statistics.guide_seconds = learning.seconds();
    statistics.guide_bytes = guide->memory_bytes();
  }
  const Stopwatch tracing;
  Progress bar("photons", settings.photons_emitted, progress.stages);
  TracedPhotons photons = trace_photons(scene, *strategy, trace, bar);
  bar.finish();
  if (stages.final_gather && settings.caustics_emitted > 0)
    add_caustics(scene, *strategy, settings.caustics_emitted, trace, photons);
  statistics.trace_seconds = tracing.seconds();
  statistics.ledger = photons.ledger;
  return photons;
}

EyeContext make_eye_context(const Scene& scene, const RenderSettings& settings, const Stages& stages, int pass,
                            const std::atomic<bool>& stop, const PassProgress& progress, RenderStatistics& statistics) {
  EyeContext context{scene, settings, stages, {}, {},
                     {},    {},       {},     {}, make_transmittance_estimator(settings.transmittance)};
  if (stages.photons())
    make_maps(context, trace_pass(scene, settings, stages, pass, stop, progress, statistics), pass, statistics);
  return context;
}

double relative_square(const RenderSettings& settings, const Stages& stages, int pass) {
  for (const UsedMap& map : used_maps(settings, stages)) {
    if (!map.shrinks) continue;
    const float radius = radius_of_pass(1.0f, map.dimension, pass);
    return double{radius} * radius;
  }
  return stages.photons() ? 1.0 : 0.0;
}

std::vector<std::string> maps_of_unseen_bias(const RenderSettings& settings, const Stages& stages) {
  std::vector<std::string> names;
  for (const UsedMap& map : used_maps(settings, stages))
    if (!map.shrinks) names.emplace_back(map.name);
  return names;
}

Pass render_photon_pass(const Scene& scene, const RenderSettings& settings, int pass, const std::atomic<bool>& stop,
                        const PassProgress& progress) {
  return render_photon_pass_after({}, scene, settings, pass, stop, progress);
}

Pass render_photon_pass_after(const PixelDiscs& discs, const Scene& scene, const RenderSettings& settings, int pass,
                              const std::atomic<bool>& stop, const PassProgress& progress) {
  RenderStatistics statistics;
  const Stages stages = plan_stages(scene, settings);
  const EyeContext context = make_eye_context(scene, settings, stages, pass, stop, progress, statistics);
  std::vector<float> radii;     // m, under Stages::pixel_discs
  std::vector<uint64_t> found;  // the same
  if (stages.pixel_discs) {
    assert(settings.surface.mode == GatherMode::radius && !stages.final_gather);
    radii = pixel_radii(scene, settings, discs);
    found.resize(radii.size());
    statistics.last_surface_radius = *std::max_element(radii.begin(), radii.end());
  }
  const RayRadiance radiance = [&](const Ray& ray, size_t pixel, Rng& rng, EyeCounters& counters) {
    static thread_local Marcher marcher;
    if (!stages.pixel_discs) return eye_radiance(context, ray, marcher, rng, counters);
    PixelGather own{settings.surface, &found[pixel]};
    own.settings.radius = radii[pixel];
    return eye_radiance(context, ray, marcher, rng, counters, &own);
  };
  Pass result = render_image(scene, settings, pass, radiance, stop, progress);
  result.found = std::move(found);
  result.relative_square = relative_square(settings, stages, pass);
  result.statistics.merge(statistics);
  return result;
}

}  // namespace vpm
