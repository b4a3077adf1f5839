// Photon tracing, map building and the eye pass, in that order.
#include "render/photon_pass.h"

#include <chrono>

#include "base/parallel.h"
#include "photon/trace.h"
#include "render/eye_path.h"
#include "render/radius_schedule.h"

namespace vpm {
namespace {

constexpr int kTile = 16;                // pixels along an edge; a tile is a chunk of parallel work
constexpr float kDefaultRadius = 0.01f;  // of the diagonal of what the map covers
constexpr float kDefaultSearch = 0.1f;   // the same, as the largest radius of the nearest mode

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
  trace.keep_direct_surface = !stages.surface_shadow_rays;
  trace.volume_form = settings.volume_form;
  trace.density_floor = settings.density_floor;
  trace.stop = &stop;
  return trace;
}

/// The settings of a map in this pass: radii shrink in radius mode; the largest radius of the nearest mode stays.
GatherSettings gather_in_pass(GatherSettings gather, float first_radius, int dimension, const RenderSettings& settings,
                              int pass) {
  const bool shrinks = settings.shrink_radii && gather.mode == GatherMode::radius;
  gather.radius = shrinks ? radius_of_pass(first_radius, dimension, pass) : first_radius;
  return gather;
}

float default_share(const GatherSettings& gather) {
  return gather.mode == GatherMode::radius ? kDefaultRadius : kDefaultSearch;
}

/// Traces the photons and sorts them into the context's maps.
void make_maps(EyeContext& context, const TraceSettings& trace, const PassProgress& progress,
               RenderStatistics& statistics) {
  const int pass = static_cast<int>(trace.pass);
  const auto& [scene, settings, stages, volume, surface, transmittance] = context;
  const Stopwatch tracing;
  const std::unique_ptr<DistanceStrategy> strategy = make_distance_strategy(settings.distance);
  Progress bar("photons", settings.photons_emitted, progress.stages);
  TracedPhotons photons = trace_photons(scene, *strategy, trace, bar);
  bar.finish();
  statistics.trace_seconds = tracing.seconds();
  statistics.ledger = photons.ledger;
  statistics.surface_photons = photons.surface.size();

  const Stopwatch building;
  const uint64_t emitted = photons.ledger.emitted_count;
  for (size_t m = 0; m < scene.media.size(); ++m) {
    const float first = first_volume_radius(scene, settings, scene.media[m]);
    statistics.volume_photons += photons.volume[m].size();
    context.volume.push_back(make_photon_map(std::move(photons.volume[m]),
                                             gather_in_pass(settings.volume, first, 3, settings, pass), emitted));
    statistics.last_volume_radius = std::max(statistics.last_volume_radius, context.volume.back().settings.radius);
    statistics.photon_map_bytes += context.volume.back().memory_bytes();
  }
  const float first = first_surface_radius(scene, settings);
  context.surface =
      make_photon_map(std::move(photons.surface), gather_in_pass(settings.surface, first, 2, settings, pass), emitted);
  statistics.last_surface_radius = context.surface.settings.radius;
  statistics.photon_map_bytes += context.surface.memory_bytes();
  statistics.build_seconds = building.seconds();
}

/// The mean radiance of a pixel's samples. Samples that are not finite are counted and left out as black.
Rgb render_pixel(const EyeContext& context, int x, int y, int pass, Marcher& marcher, EyeCounters& counters) {
  const Camera& camera = context.scene.camera;
  const int samples = context.settings.samples_per_pixel;
  Rgbd sum(0.0);
  for (int s = 0; s < samples; ++s) {
    const uint64_t index = (static_cast<uint64_t>(y) * camera.width + x) * samples + s;
    Rng rng(context.settings.seed, rng_stream(RngUse::pixel, static_cast<uint64_t>(pass)), index);
    const Vec2 film = Vec2(x + 0.5f, y + 0.5f) + sample_filter(camera.filter, rng.uniform2());
    const Rgb radiance = eye_radiance(context, camera.ray(film), marcher, rng, counters);
    if (is_finite(radiance))
      sum += Rgbd(radiance);
    else
      ++counters.non_finite;
  }
  return Rgb(sum / static_cast<double>(samples));
}

void render_image(const EyeContext& context, int pass, const std::atomic<bool>& stop, const PassProgress& progress,
                  Pass& result) {
  const Camera& camera = context.scene.camera;
  const int tiles_x = (camera.width + kTile - 1) / kTile;
  const uint64_t tiles = tile_count(camera);
  std::vector<EyeCounters> counters(tiles);
  Progress bar("image", tiles, progress.stages);
  parallel_for_chunks(tiles, 1, [&](size_t tile, size_t, size_t) {
    if (stop) return;
    static thread_local Marcher marcher;
    const int x0 = static_cast<int>(tile % tiles_x) * kTile, y0 = static_cast<int>(tile / tiles_x) * kTile;
    for (int y = y0; y < std::min(y0 + kTile, camera.height); ++y)
      for (int x = x0; x < std::min(x0 + kTile, camera.width); ++x)
        result.image.at(x, y) = render_pixel(context, x, y, pass, marcher, counters[tile]);
    bar.advance();
    if (progress.tiles) progress.tiles->advance();
  });
  for (const EyeCounters& c : counters) result.statistics.eye.merge(c);
}

}  // namespace

uint64_t tile_count(const Camera& camera) {
  return static_cast<uint64_t>((camera.width + kTile - 1) / kTile) * ((camera.height + kTile - 1) / kTile);
}

Stages plan_stages(const Scene& scene, const RenderSettings& settings) {
  bool scatters = false, diffuse = false;
  for (const Medium& medium : scene.media) scatters |= medium.scatters();
  for (const Shape& shape : scene.shapes) diffuse |= is_diffuse(scene.materials[shape.material]);
  return {.volume_map = scatters,
          .surface_map = diffuse,
          .volume_shadow_rays = scatters && settings.volume_direct == DirectLight::shadow_rays,
          .surface_shadow_rays = diffuse && settings.surface_direct == DirectLight::shadow_rays};
}

float first_volume_radius(const Scene& scene, const RenderSettings& settings, const Medium& medium) {
  if (settings.volume.radius > 0.0f) return settings.volume.radius;
  return default_share(settings.volume) * (medium.grid ? medium.grid->bounds().diagonal() : 2.0f * scene.sphere.radius);
}

float first_surface_radius(const Scene& scene, const RenderSettings& settings) {
  return settings.surface.radius > 0.0f ? settings.surface.radius
                                        : default_share(settings.surface) * 2.0f * scene.sphere.radius;
}

Pass render_photon_pass(const Scene& scene, const RenderSettings& settings, int pass, const std::atomic<bool>& stop,
                        const PassProgress& progress) {
  Pass result{Image(scene.camera.width, scene.camera.height), {}};
  result.statistics.passes = 1;
  EyeContext context{scene, settings, plan_stages(scene, settings),
                     {},    {},       make_transmittance_estimator(settings.transmittance)};
  if (context.stages.photons())
    make_maps(context, trace_settings(settings, context.stages, pass, stop), progress, result.statistics);
  const Stopwatch seeing;
  render_image(context, pass, stop, progress, result);
  result.statistics.eye_seconds = seeing.seconds();
  return result;
}

}  // namespace vpm
