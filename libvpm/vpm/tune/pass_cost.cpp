// A part of the photons of a pass, and a part of its rays.
#include "vpm/tune/pass_cost.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "vpm/base/clock.h"
#include "vpm/base/counters.h"
#include "vpm/base/parallel.h"
#include "vpm/integrators/combined/combined_pass.h"
#include "vpm/integrators/integrator.h"
#include "vpm/integrators/photon_map/eye_path.h"
#include "vpm/integrators/photon_map/photon_pass.h"
#include "vpm/photon/caustics.h"
#include "vpm/tune/counted_cost.h"
#include "vpm/tune/eye_blocks.h"
#include "vpm/tune/forecast.h"
#include "vpm/tune/pilot.h"

namespace vpm {
namespace {

/// What rays of one block of pixels counted.
struct RenderedBlock {
  EyeCounters counters;
  bool together = false;  // all of them, but for the first?
};
/// Renders one ray, and all others together where so many seconds allow, else one by one until these are over.
RenderedBlock render_block(const Scene& scene, const RenderSettings& settings, const RadianceOfRays& radiance,
                           size_t block, double seconds) {
  RenderedBlock rendered;
  EyeCounters& counters = rendered.counters;
  EyeScratch scratch;
  const Stopwatch rendering;
  const auto taken = [&] {
    return goes_by_clock(settings) ? rendering.seconds() : counted_work(scene, settings, counters).seconds;
  };
  for (size_t i = 0; i < kRaysOfBlock && (i == 0 || taken() < seconds);) {
    rendered.together |= i == 1 && kRaysOfBlock * taken() < seconds;
    const size_t end = rendered.together ? kRaysOfBlock : i + 1;
    RaysOfBlock rays(scene.camera, block, BlockPixels::side_by_side, counters, scratch);
    for (; i < end; ++i) rays.add(i, Rng(settings.seed, rng_stream(RngUse::pilot, 1), block * kRaysOfBlock + i));
    radiance(rays.all());
    counters.rays += rays.all().size();
  }
  return rendered;
}

/// What an eye pass takes, by rays of blocks of pixels all over the picture.
struct EyeCost {
  double seconds = 0.0;
  double of_photons = 0.0;  // the share of them that goes with the number of photons; 0 where nothing is counted
};
/// Takes about so many seconds. The clock measures rays that are taken together, as a pass does, which saves up to nine
/// tenths of their time; where the time was too short for that, they are counted.
EyeCost time_eye_pass(const Scene& scene, const RenderSettings& settings, const RadianceOfRays& radiance,
                      double seconds) {
  std::array<RenderedBlock, kEyeBlocks> blocks;
  const Stopwatch rendering;
  parallel_for_chunks(kEyeBlocks, 1, [&](size_t block, size_t, size_t) {
    blocks[block] = render_block(scene, settings, radiance, block, seconds / kEyeBlocks);
  });
  const double timed = rendering.seconds();
  EyeCounters sum;
  size_t together = 0;
  for (const RenderedBlock& block : blocks) {
    sum.merge(block.counters);
    together += block.together ? 1 : 0;
  }
  const CountedWork counted = counted_work(scene, settings, sum);
  const double all = double(scene.camera.width) * scene.camera.height * settings.samples_per_pixel;
  double taken = counted.seconds;  // of one thread
  const bool alone_as_quick = settings.integrator == Integrator::path;
  if (goes_by_clock(settings))
    taken = !kCounts || alone_as_quick || 2 * together > kEyeBlocks ? timed : taken / thread_count();
  return {taken * all / static_cast<double>(sum.rays),
          counted.seconds > 0.0 ? counted.of_photons / counted.seconds : 0.0};
}

/// What the eye pass takes where so many times as many photons are found, in so many blocks.
double with_more_photons(const EyeCost& eye, double times, double blocks = 1.0) {
  return eye.seconds * (1.0 + eye.of_photons * (times - 1.0) + (1.0 - eye.of_photons) * (blocks - 1.0));
}

/// Tracing and sorting, s.
double seconds_of_photons(const RenderSettings& settings, const RenderStatistics& s) {
  return goes_by_clock(settings) ? s.trace_seconds + s.build_seconds : counted_seconds_of_photons(settings, s);
}

/// By as many light sub-paths as take a half of the time. All that they store counts as photons of a map that take as
/// much memory.
PassCost time_combined_pass(const Scene& scene, const RenderSettings& settings, double seconds) {
  constexpr uint64_t kFirst = 1000;
  constexpr double kMostBytes = 2e8;  // of what they store
  const auto all = static_cast<double>(settings.photons.emitted);
  RenderSettings pilot = with_light_paths(pilot_settings(settings, settings.photons.emitted), kFirst);
  RaysOfPass ready = rays_of_pass(scene, pilot, 0);
  const auto each = [&] {
    return seconds_of_photons(pilot, ready.statistics) / static_cast<double>(pilot.photons.emitted);
  };
  const double bytes =
      static_cast<double>(ready.statistics.photon_map_bytes) / static_cast<double>(pilot.photons.emitted);
  const double affordable = std::min({all, 0.5 * seconds / std::max(1e-9, each()), kMostBytes / std::max(1.0, bytes)});
  if (affordable > 2.0 * kFirst) {
    pilot = with_light_paths(pilot_settings(settings, settings.photons.emitted), static_cast<uint64_t>(affordable));
    ready = rays_of_pass(scene, pilot, 0);
  }
  const EyeCost eye = time_eye_pass(scene, pilot, ready.radiance, 0.5 * seconds);
  const auto paths = static_cast<double>(pilot.photons.emitted);
  const RenderStatistics& s = ready.statistics;
  return {.photon = each(),
          .eye = with_more_photons(eye, all / paths),
          .stored_per_photon = static_cast<double>(s.photon_map_bytes) / (kMapBytes * paths)};
}

/// A part of a pass made ready, and what that took.
struct ReadyPass {
  RenderSettings settings;
  Estimators estimators;
  RenderStatistics statistics;
};
ReadyPass make_ready(const Scene& scene, const RenderSettings& settings, PassOf of) {
  ReadyPass ready{
      settings,
      of == PassOf::picture ? plan_estimators(scene, settings, 0) : plan_surface_estimators(scene, settings, 0),
      {}};
  prepare_pass(scene, settings, ready.estimators, {}, ready.statistics);
  return ready;
}

/// A share of a pass's photons, and of those that are aimed for caustics, one of either at the least.
RenderSettings part_of(RenderSettings pass, double share, double photons) {
  const auto part = [&](double count) { return static_cast<uint64_t>(std::max(1.0, std::round(share * count))); };
  pass.photons.emitted = part(photons);
  pass.caustics.emitted = std::min(pass.aimed_photons(), part(static_cast<double>(pass.aimed_photons())));
  return pass;
}

/// Tracing those that are aimed for caustics.
double caustic_seconds(const ReadyPass& ready) {
  if (goes_by_clock(ready.settings)) return ready.statistics.caustic_seconds;
  return counted_seconds_of_caustics(caustic_paths(ready.settings.aimed_photons()));
}

/// Makes as large a part of a pass ready as that many seconds allow, a thousand of its photons at the least.
ReadyPass make_ready_within(const Scene& scene, const RenderSettings& settings, PassOf of, double seconds) {
  constexpr double kFewest = 1000.0, kMost = 0x1p40;
  const RenderSettings pilot = pilot_settings(settings, settings.photons.emitted);
  const auto stored = static_cast<double>(pilot.photons.stored);  // of either kind at the most
  const auto caustics = static_cast<double>(settings.aimed_photons());
  // Where nothing but the stored photons is limited, each is taken to be stored once: the share may end above 1.
  const double photons = photons_of_pass(settings, 1.0);
  const double limit = settings.photons.emitted > 0 ? static_cast<double>(settings.photons.emitted) : kMost;
  const double largest = std::min(std::min(limit, kMost) / photons, caustics > stored ? stored / caustics : kInfinity);
  const Stopwatch tracing;
  double counted = 0.0;
  for (double share = std::isfinite(seconds) ? kFewest / std::max(photons, caustics) : largest;;) {
    share = std::min(share, largest);
    ReadyPass ready = make_ready(scene, part_of(pilot, share, photons), of);
    const RenderStatistics& s = ready.statistics;
    const double aimed = caustic_seconds(ready), taken = seconds_of_photons(pilot, s) + aimed;
    counted += taken;
    const double left = seconds - (goes_by_clock(pilot) ? tracing.seconds() : counted);
    const bool stored_all = std::max(s.volume_photons, s.surface_photons) >= pilot.photons.stored;
    const bool traced_none = s.ledger.emitted_count == 0;  // there is no map
    if (share == largest || stored_all || traced_none || left < 2.0 * taken) return ready;
    share *= std::clamp(0.5 * left / std::max(taken, 1e-6), 2.0, 16.0);
  }
}

/// What a pass's photons cost, by a part of them. Sorting goes by the number stored.
PassCost cost_of_photons(const RenderSettings& settings, const ReadyPass& ready) {
  const RenderStatistics& s = ready.statistics;
  if (s.ledger.emitted_count == 0) return {};
  const auto emitted = static_cast<double>(s.ledger.emitted_count), aimed = static_cast<double>(s.aimed_photons);
  const double others = static_cast<double>(s.volume_photons + s.surface_photons + s.caustic_photons) - aimed;
  const auto flights = static_cast<double>(s.flights);
  const bool clock = goes_by_clock(settings);
  // Sorting one photon or flight, s: counts have it in those of photons.
  const double sorting = clock ? s.build_seconds / std::max(1.0, others + aimed + flights) : 0.0;
  PassCost cost;
  cost.photon =
      (clock ? s.trace_seconds + sorting * (others + flights) : counted_seconds_of_photons(settings, s)) / emitted;
  cost.stored_per_photon = others / emitted;
  cost.flights_per_photon = flights / emitted;
  if (settings.aimed_photons() == 0) return cost;
  const uint64_t all = settings.aimed_photons(), part = ready.settings.aimed_photons();
  cost.stored_caustics = aimed * static_cast<double>(all) / static_cast<double>(part);
  cost.caustics = caustic_seconds(ready) * caustic_paths(all) / caustic_paths(part) + sorting * cost.stored_caustics;
  return cost;
}

}  // namespace

bool goes_by_clock(const RenderSettings& settings) { return settings.until.seconds > 0.0 || !kCounts; }

PassCost time_photons(const Scene& scene, const RenderSettings& settings, PassOf of, double seconds) {
  return cost_of_photons(settings, make_ready_within(scene, settings, of, seconds));
}

PassCost time_pass(const Scene& scene, const RenderSettings& settings, double seconds) {
  if (settings.integrator == Integrator::path) {
    const RenderSettings pilot = pilot_settings(settings, settings.photons.emitted);
    return {.eye = time_eye_pass(scene, pilot, rays_of_pass(scene, pilot, 0).radiance, seconds).seconds};
  }
  if (settings.integrator == Integrator::combined) return time_combined_pass(scene, settings, seconds);
  const ReadyPass ready = make_ready_within(scene, settings, PassOf::picture, 0.5 * seconds);
  const EyeContext context{scene, ready.estimators, settings.max_events};
  const RadianceOfRays radiance = [&](std::span<EyeRay> rays) { eye_radiance(context, rays); };
  const EyeCost eye = time_eye_pass(scene, ready.settings, radiance, 0.5 * seconds);
  const RenderStatistics& s = ready.statistics;
  PassCost cost = cost_of_photons(settings, ready);
  const auto found = static_cast<double>(s.volume_photons + s.surface_photons + s.caustic_photons + s.flights);
  const double photons = photons_of_pass(settings, cost.stored_per_photon);
  const double whole = cost.stored(photons) + photons * cost.flights_per_photon;
  const double guide =
      goes_by_clock(settings) ? s.guide_seconds : counted_seconds_of_guide(settings.importance.importons);
  const auto blocks = static_cast<double>(block_count(settings));
  const double tracings = tracings_of_pass(scene, settings);
  cost.photon *= tracings;  // at the most: what is sorted and stored is so once
  const double more = std::max(1.0, whole / std::max(1.0, found));
  cost.eye = tracings * blocks * guide + with_more_photons(eye, more, blocks);
  cost.gathered = eye.seconds * eye.of_photons * more;
  return cost;
}

}  // namespace vpm
