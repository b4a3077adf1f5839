// Estimates by what a few photons and rays take and store.
#include "vpm/job/forecast.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "vpm/base/error.h"
#include "vpm/estimate/photon_map.h"
#include "vpm/integrators/combined/combined_pass.h"
#include "vpm/integrators/integrator.h"
#include "vpm/integrators/photon_density.h"
#include "vpm/integrators/photon_map/photon_blocks.h"
#include "vpm/integrators/photon_map/photon_pass.h"
#include "vpm/integrators/photon_map/plan.h"
#include "vpm/integrators/photon_map/volume/estimator_info.h"
#include "vpm/tune/way_pilot.h"

namespace vpm {
namespace {

constexpr double kMostGathered = 100'000.0;    // photons a ray, without a word
constexpr uint64_t kSafePhotons = 10'000'000;  // that fit everywhere, unless each is stored hundreds of times
constexpr double kMostIndexed = 0x1p32;        // photons of a map, or pieces of beams: their numbers have 32 bits
constexpr double kPiecesOfBeam = 9.0;          // in the mean, at the most

/// What photons leave in maps.
struct PhotonYield {
  double stored_per_photon = 0.0, flights_per_photon = 0.0;
  double stored_caustics = 0.0;  // of all photons that are aimed for caustics

  double stored(double photons) const { return stored_caustics + photons * stored_per_photon; }
};
/// By some of the photons of a pass.
PhotonYield yield_of(const Scene& scene, const RenderSettings& settings, PassOf of) {
  constexpr uint64_t kSome = 20'000;
  const uint64_t emitted = settings.photons.emitted, aimed = settings.aimed_photons();
  RenderSettings some = pilot_settings(settings, emitted > 0 ? std::min(emitted, kSome) : kSome);
  some.caustics.emitted = std::min(aimed, kSome);
  some.importance.importons = std::min(some.importance.importons, kSome);
  const Estimators estimators =
      of == PassOf::picture ? plan_estimators(scene, some, 0) : plan_surface_estimators(scene, some, 0);
  RenderStatistics s;
  prepare_pass(scene, some, estimators, {}, s);
  if (s.ledger.emitted_count == 0) return {};
  const auto traced = static_cast<double>(s.ledger.emitted_count), caught = static_cast<double>(s.aimed_photons);
  const double stored = static_cast<double>(s.volume_photons + s.surface_photons + s.caustic_photons) - caught;
  const double of_aimed = some.aimed_photons() > 0 ? caught / static_cast<double>(some.aimed_photons()) : 0.0;
  return {stored / traced, static_cast<double>(s.flights) / traced, of_aimed * static_cast<double>(aimed)};
}

/// What the records of a pass take of the memory while maps are made, and how many must be numbered in one map.
struct Room {
  double bytes, numbers;
};
Room room_of(const PhotonYield& yield, const RenderSettings& settings, double photons) {
  const double stored = yield.stored(photons), flights = photons * yield.flights_per_photon;
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

}  // namespace

ForeseenPass foresee_pass(const Scene& scene, const RenderSettings& settings, double looking, const Clock& clock) {
  const AutomaticSettings nothing;
  WayPilot pilot(scene, nothing, clock, {"", settings});
  pilot.find_size(looking);
  pilot.add_passes(1, pilot.usual());
  const PassModel model = pilot.times();
  ForeseenPass pass{.of_rays = model.seeing.at};
  if (settings.integrator == Integrator::path) return {model.seconds(0.0, 1.0), model.seeing.at};
  pass.photons = static_cast<double>(settings.photons.emitted);
  if (settings.integrator == Integrator::photon) {
    if (settings.photons.stored > 0)
      pass.photons = photons_of_pass(settings, yield_of(scene, settings, PassOf::picture).stored_per_photon);
    pass.of_rays *= static_cast<double>(block_count(settings));
  }
  const double tracings = settings.integrator == Integrator::photon ? tracings_of_pass(scene, settings) : 1;
  pass.seconds = tracings * model.making(pass.photons) + pass.of_rays + model.seeing.by * pass.photons;
  return pass;
}

std::string photons_that_fit(const ForeseenPass& pass, const RenderSettings& settings, double seconds) {
  constexpr double kFewest = 1000.0;
  const double share = (seconds - pass.of_rays) / (pass.seconds - pass.of_rays);
  const double most = std::max(pass.photons, static_cast<double>(settings.aimed_photons()));
  return share * most >= kFewest ? fitting_text(pass.photons, settings, share) : "";
}

std::string radius_that_fits(const Scene& scene, RenderSettings settings, double seconds, double looking,
                             const Clock& clock) {
  constexpr int kHalves = 6;
  const bool media = facts_of(scene).scattering_media;
  AskedGather& gather = media ? settings.volume : settings.surface;
  if (settings.integrator != Integrator::photon || gather.goes_by_count()) return "";
  float radius = media ? first_radius_of_merges(gather, scene) : first_radius(gather, scene);
  for (int i = 0; i < kHalves; ++i) {
    radius *= 0.5f;
    gather.radius = radius;
    if (foresee_pass(scene, settings, looking / kHalves, clock).seconds < seconds)
      return fmt::format("integrator.{}.radius = {:.2g}", media ? "volume" : "surface", radius);
  }
  return "";
}

std::string wide_gather_text(const Scene& scene, const RenderSettings& settings) {
  if (settings.integrator == Integrator::path) return "";
  const RenderSettings few = few_photons(settings);
  const SmallPass pass = render_small(scene, few, 0, WallClock());
  double all = static_cast<double>(settings.photons.emitted);
  if (settings.integrator == Integrator::photon && settings.photons.stored > 0)
    all = photons_of_pass(settings, yield_of(scene, few, PassOf::picture).stored_per_photon);
  const double photons = all / std::max(1.0, pass.photons) * pass.gathered_by_ray;
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
  const PhotonYield yield = yield_of(scene, held, of);
  return room_of(yield, held, photons_of_pass(held, yield.stored_per_photon)).bytes;
}

void check_memory(const Scene& scene, const RenderSettings& settings, PassOf of, double memory) {
  if (settings.integrator == Integrator::path) return;
  if (settings.integrator == Integrator::combined) return check_memory_of_sub_paths(scene, settings, memory);
  const double each = settings.volume.info().flights ? kFlightBytes + kBeamBytes : kMapBytes;
  const RenderSettings held = at_a_time(settings);
  const auto asked = static_cast<double>(std::max({held.photons.emitted, held.photons.stored, held.aimed_photons()}));
  if (asked * each <= kMapBytes * static_cast<double>(kSafePhotons)) return;
  const PhotonYield yield = yield_of(scene, held, of);
  const double photons = photons_of_pass(held, yield.stored_per_photon), stored = yield.stored(photons);
  const Room room = room_of(yield, held, photons);
  const double fits = std::min(memory / room.bytes, kMostIndexed / room.numbers);
  if (fits >= 1.0) return;
  const double flights = photons * yield.flights_per_photon;
  const bool by_blocks = settings.photons.block > 0;
  const char* const key = by_blocks                              ? "integrator.photons.block"
                          : yield.stored_caustics > 0.5 * stored ? "integrator.caustics.emitted"
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
