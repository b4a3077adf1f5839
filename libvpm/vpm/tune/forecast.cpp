// Estimates by what a pilot's photons and rays cost.
#include "vpm/tune/forecast.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "vpm/base/error.h"
#include "vpm/base/parallel.h"
#include "vpm/estimate/photon_map.h"
#include "vpm/integrators/combined/combined_pass.h"
#include "vpm/integrators/integrator.h"
#include "vpm/integrators/photon_map/photon_blocks.h"
#include "vpm/integrators/photon_map/plan.h"
#include "vpm/integrators/photon_map/volume/estimator_info.h"
#include "vpm/tune/choice_rules.h"
#include "vpm/tune/eye_blocks.h"
#include "vpm/tune/pilot.h"

namespace vpm {
namespace {

constexpr double kMostGathered = 100'000.0;    // photons a ray, without a word
constexpr uint64_t kSafePhotons = 10'000'000;  // that fit everywhere, unless each is stored hundreds of times
constexpr double kMostIndexed = 0x1p32;        // photons of a map, or pieces of beams: their numbers have 32 bits
constexpr double kPiecesOfBeam = 9.0;          // in the mean, at the most

/// What the records of a pass take of the memory while maps are made, and how many must be numbered in one map.
struct Room {
  double bytes, numbers;
};
Room room_of(const PassCost& cost, const RenderSettings& settings, double photons) {
  const double stored = cost.stored(photons), flights = photons * cost.flights_per_photon;
  const double recorders = settings.volume.info().planes ? 2.0 : 1.0;
  const double kept =
      settings.volume.flights > 0 ? std::min(flights, static_cast<double>(settings.volume.flights)) : flights;
  return {kMapBytes * stored + recorders * kFlightBytes * flights + kBeamBytes * kept,
          std::max(stored, kPiecesOfBeam * kept)};
}

/// Two digits of a number of photons and then zeros, "210000000": as the setting takes it.
std::string photons_text(double photons) {
  const double unit = std::pow(10.0, std::max(0.0, std::floor(std::log10(photons)) - 1.0));
  return fmt::format("{:.0f}", std::floor(photons / unit) * unit);
}

/// What memory holds at a time: a block of a pass, if it has blocks.
RenderSettings at_a_time(RenderSettings settings) {
  settings.photons.emitted = photon_block(settings, 0).count;
  return settings;
}

/// "about 210000 integrator.photons.emitted": that share of the photons of a pass, and of those aimed for caustics.
std::string fitting_text(double photons, const RenderSettings& settings, double share) {
  std::string text = fmt::format("about {} integrator.photons.emitted", photons_text(share * photons));
  if (settings.aimed_photons() > 0)
    text += fmt::format(" and {} integrator.caustics.emitted",
                        photons_text(share * static_cast<double>(settings.aimed_photons())));
  return text;
}

/// Light sub-paths are kept whole, and sorted into a copy: estimated from the first of them.
double bytes_of_sub_path(const Scene& scene, const RenderSettings& settings) {
  constexpr uint64_t kFew = 1000;
  const RenderSettings few = with_light_paths(settings, kFew);
  const CombinedPass pass(scene, few, 0);
  return 2.0 * static_cast<double>(pass.statistics().photon_map_bytes) / static_cast<double>(few.photons.emitted);
}

void check_memory_of_sub_paths(const Scene& scene, const RenderSettings& settings, double memory) {
  const auto paths = static_cast<double>(settings.photons.emitted);
  const double each = bytes_of_sub_path(scene, settings);
  if (paths * each <= memory) return;
  throw InputError(fmt::format(
      "integrator.photons.emitted: the light sub-paths of a pass would take {:.2g} GB of memory; this machine has "
      "{:.2g} GB, where about {} integrator.photons.emitted would fit; more passes do what more light sub-paths would",
      paths * each * 1e-9, memory * 1e-9, photons_text(0.5 * memory / each)));
}

/// A thousand photons or light sub-paths, and nothing that guides them.
RenderSettings few_photons(const RenderSettings& settings) {
  constexpr uint64_t kFew = 1000;
  const bool combined = settings.integrator == Integrator::combined;
  RenderSettings few = combined ? with_light_paths(settings, kFew) : pilot_settings(settings, kFew);
  few.caustics.emitted = std::min(few.aimed_photons(), kFew);
  few.importance.importons = 0;
  return few;
}

/// How many photons a ray gathers: the mean of rays all over the picture.
double gathered_by_a_ray(const Scene& scene, const RenderSettings& settings, const RadianceOfRays& radiance) {
  std::array<EyeCounters, kEyeBlocks> counters;
  parallel_for_chunks(kEyeBlocks, 1, [&](size_t block, size_t, size_t) {
    EyeScratch scratch;
    RaysOfBlock rays(scene.camera, block, BlockPixels::side_by_side, counters[block], scratch);
    rays.add(0, Rng(settings.seed, rng_stream(RngUse::pilot, 1), block));
    radiance(rays.all());
  });
  GatherCounters all;
  for (const EyeCounters& each : counters) all.merge(each.gather);
  return static_cast<double>(all.used) / kEyeBlocks;
}

}  // namespace

std::string photons_that_fit(const PassCost& cost, const RenderSettings& settings, double seconds) {
  const double photons = photons_of_pass(settings, cost.stored_per_photon), pass = cost.seconds(photons);
  const double of_rays = cost.eye - cost.gathered;  // whatever photons there are
  const double share = (seconds - of_rays) / (pass - of_rays);
  const double most = std::max(photons, static_cast<double>(settings.aimed_photons()));
  if (share * most >= static_cast<double>(kLeastCount)) return fitting_text(photons, settings, share);
  return "";
}

std::string radius_that_fits(const Scene& scene, RenderSettings settings, double seconds, double looking) {
  constexpr int kHalves = 6;
  const bool media = facts_of(scene).scattering_media;
  AskedGather& gather = media ? settings.volume : settings.surface;
  if (settings.integrator != Integrator::photon || gather.goes_by_count()) return "";
  float radius = media ? first_radius_of_merges(gather, scene) : first_radius(gather, scene);
  for (int i = 0; i < kHalves; ++i) {
    radius *= 0.5f;
    gather.radius = radius;
    const PassCost cost = time_pass(scene, settings, looking / kHalves);
    if (cost.seconds(photons_of_pass(settings, cost.stored_per_photon)) < seconds)
      return fmt::format("integrator.{}.radius = {:.2g}", media ? "volume" : "surface", radius);
  }
  return "";
}

std::string wide_gather_text(const Scene& scene, const RenderSettings& settings) {
  if (settings.integrator == Integrator::path) return "";
  const RenderSettings few = few_photons(settings);
  const RaysOfPass pass = rays_of_pass(scene, few, 0);
  const RenderStatistics& s = pass.statistics;
  double times = static_cast<double>(settings.photons.emitted) / static_cast<double>(few.photons.emitted);
  if (settings.integrator == Integrator::photon) {
    const auto emitted = static_cast<double>(std::max<uint64_t>(1, s.ledger.emitted_count));
    times = photons_of_pass(settings, static_cast<double>(std::max(s.volume_photons, s.surface_photons)) / emitted) /
            emitted;
  }
  const double photons = times * gathered_by_a_ray(scene, few, pass.radiance);
  if (photons <= kMostGathered) return "";
  return fmt::format(
      "a ray from the eye gathers about {:.2g} photons of a pass: smaller radii, or fewer photons and "
      "more passes, would be quicker",
      photons);
}

double bytes_of_maps(const Scene& scene, const RenderSettings& settings, PassOf of) {
  if (settings.integrator == Integrator::path) return 0.0;
  if (settings.integrator == Integrator::combined)
    return static_cast<double>(settings.photons.emitted) * bytes_of_sub_path(scene, settings);
  const RenderSettings held = at_a_time(settings);
  const PassCost cost = time_photons(scene, held, of, 0.1);
  return room_of(cost, held, photons_of_pass(held, cost.stored_per_photon)).bytes;
}

void check_memory(const Scene& scene, const RenderSettings& settings, PassOf of, double memory) {
  if (settings.integrator == Integrator::path) return;
  if (settings.integrator == Integrator::combined) return check_memory_of_sub_paths(scene, settings, memory);
  const double each = settings.volume.info().flights ? kFlightBytes + kBeamBytes : kMapBytes;
  const RenderSettings held = at_a_time(settings);
  const auto asked = static_cast<double>(std::max({held.photons.emitted, held.photons.stored, held.aimed_photons()}));
  if (asked * each <= kMapBytes * static_cast<double>(kSafePhotons)) return;
  const PassCost cost = time_photons(scene, held, of, 0.1);
  const double photons = photons_of_pass(held, cost.stored_per_photon), stored = cost.stored(photons);
  const Room room = room_of(cost, held, photons);
  const double fits = std::min(memory / room.bytes, kMostIndexed / room.numbers);
  if (fits >= 1.0) return;
  const double flights = photons * cost.flights_per_photon;
  const bool by_blocks = settings.photons.block > 0;
  const char* const key = by_blocks                             ? "integrator.photons.block"
                          : cost.stored_caustics > 0.5 * stored ? "integrator.caustics.emitted"
                                                                : "integrator.photons.emitted";
  throw InputError(fmt::format(
      "{}: the maps of a {} would hold about {:.2g} photons{} and take {:.2g} GB of memory; this machine has {:.2g} "
      "GB, where {}",
      key, by_blocks ? "block" : "pass", stored, flights > 0.0 ? fmt::format(" and {:.2g} flights", flights) : "",
      room.bytes * 1e-9, memory * 1e-9,
      by_blocks
          ? fmt::format("about {} integrator.photons.block would fit", photons_text(0.5 * fits * photons))
          : fitting_text(photons, settings, 0.5 * fits) + " would fit; more passes do what more photons would, and "
                                                          "integrator.photons.block gathers as many in blocks"));
}

double physical_memory() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace vpm
