// Pilot photons, and the places at which the eye gathers them.
#include "vpm/integrators/photon_density.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

#include "vpm/base/parallel.h"
#include "vpm/base/progress.h"
#include "vpm/integrators/photon_map/photon_pass.h"
#include "vpm/integrators/photon_map/volume/estimator_info.h"
#include "vpm/path/follow.h"
#include "vpm/path/walk.h"
#include "vpm/photon/map/nearest_map.h"
#include "vpm/photon/photon_beam.h"
#include "vpm/photon/trace.h"

namespace vpm {
namespace {

constexpr uint64_t kStored = 1'000'000;    // of a pilot's photons, at the most
constexpr size_t kEyePaths = 4096;         // that find where the eye gathers
constexpr size_t kProbes = 512;            // places, of these
constexpr size_t kFlightsAround = 32'000;  // by which distances of flights are measured, at the most
constexpr uint32_t kNeighbours = 16;       // counted at a place: the density there is known to a quarter

/// A place at which the eye gathers.
struct Probe {
  Vec3 place{0.0f};           // m
  float pixel = 0.0f;         // m, the edge of a pixel there
  MediumId medium = kVacuum;  // that scatters there
};
/// Probes of the maps.
struct Probes {
  std::vector<Probe> volume, surface;
};

float pixel_at(const Camera& camera, float distance) {
  return distance * 2.0f * camera.tan_half_fov / static_cast<float>(camera.height);
}

/// Follows a path from the eye to where it first gathers.
void find_probe(const Scene& scene, const DistanceStrategy& strategy, uint64_t seed, uint64_t number, Probes& probes) {
  constexpr int kMostEvents = 32;
  Rng rng(seed, rng_stream(RngUse::pilot, 0), number);
  const Ray seen = scene.camera.ray(rng.uniform2() * Vec2(scene.camera.width, scene.camera.height));
  WalkCounters counters;
  float length = 0.0f;
  const auto see = [&](const Event& event, const PathState& from, const PathState& at) {
    if (event.kind == EventKind::escape) return false;
    length += glm::distance(from.ray.origin, at.ray.origin);
    const bool collision = event.kind == EventKind::collision;
    if (!collision && !is_rough(scene.material_of(event.hit))) return true;
    const float pixel = pixel_at(scene.camera, length);
    if (collision)
      probes.volume.push_back({at.ray.origin, pixel, at.medium});
    else
      probes.surface.push_back({at.ray.origin, pixel});
    return false;
  };
  const MediumId medium = medium_of_ray(scene, scene.camera_medium, seen);
  follow({scene, strategy, counters, kMostEvents}, {seen, medium, Rgb(1.0f)}, rng, EyeVisitor{see});
}

/// Every n-th, for the least n that leaves no more than `most`.
template <class T>
std::vector<T> thinned(const std::vector<T>& all, size_t most) {
  const size_t step = chunk_count(std::max<size_t>(all.size(), 1), most);
  std::vector<T> some;
  for (size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
  return some;
}

/// The median of what `value_of` makes of each.
template <class T, class ValueOf>
double median(const std::vector<T>& all, ValueOf&& value_of) {
  std::vector<double> values(all.size());
  std::transform(all.begin(), all.end(), values.begin(), value_of);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// How thick the medium is at a place in it, m: the shortest of the thirteen lines through it to the corners, edges and
/// faces of a cube, each up to the next boundary or surface and the end of its grid; infinite where it has no end.
double thickness_at(const Scene& scene, const Probe& probe) {
  WalkCounters counters;
  const auto length = [&](const Vec3& direction) {
    MediumId medium = probe.medium;
    const Ray ray{probe.place, direction};
    const Encounter met = meet(scene, ray, kInfinity, medium, counters);
    const Interval within{0.0f, met ? met.hits[0].t : kInfinity};
    const auto& grid = scene.media[probe.medium].grid;
    return double{grid ? grid->clip(ray, within).t1 : within.t1};
  };
  double least = kInfinity;
  for (int i = 0; i < 13; ++i) {  // of 27 steps of -1, 0 or 1 along each axis those before the middle one
    const Vec3 direction = glm::normalize(Vec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1));
    least = std::min(least, length(direction) + length(-direction));
  }
  return least;
}

/// Of each medium in which a sixteenth of the places lie at least, the least.
void bound_by_media(const Scene& scene, const std::vector<Probe>& probes, MapDensity& density) {
  for (size_t number = 0; number < scene.media.size(); ++number) {
    std::vector<Probe> inside;
    std::copy_if(probes.begin(), probes.end(), std::back_inserter(inside),
                 [&](const Probe& probe) { return probe.medium == static_cast<MediumId>(number); });
    if (inside.empty() || 16 * inside.size() < probes.size()) continue;
    const Medium& medium = scene.media[number];
    const double thickness = median(inside, [&](const Probe& probe) { return thickness_at(scene, probe); });
    const double free_path = median(
        inside, [&](const Probe& probe) { return 1.0 / (mean_channel(medium.sigma_t) * medium.density(probe.place)); });
    density.thickness = std::min(density.thickness, thickness);
    density.free_path = std::min(density.free_path, free_path);
  }
}

/// What lies around the probes of a map, whose photons or flights are at these distances of theirs.
MapDensity density_of(const Scene& scene, const std::vector<Probe>& probes, const std::vector<double>& reaches,
                      double emitted, int dimension) {
  MapDensity density{median(reaches, std::identity()), kNeighbours, emitted, dimension,
                     median(probes, [](const Probe& probe) { return probe.pixel; })};
  bound_by_media(scene, probes, density);
  return density;
}

/// How far from places the photons are; nothing where either are too few.
std::optional<MapDensity> density_around(const Scene& scene, const std::vector<Probe>& all,
                                         const std::vector<Photon>& photons, double emitted, int dimension) {
  const std::vector<Probe> probes = thinned(all, kProbes);
  if (probes.size() < kNeighbours || photons.size() < 2 * kNeighbours) return std::nullopt;
  const NearestMap map(photons, 1.0f);
  Neighbours neighbours;
  std::vector<double> reaches;
  for (const Probe& probe : probes) {
    map.find(probe.place, kNeighbours, kInfinity, neighbours, [](const auto&, const auto&) { return true; });
    reaches.push_back(std::sqrt(neighbours.limit()));
  }
  return density_of(scene, probes, reaches, emitted, dimension);
}

float distance2_from(const PhotonBeam& flight, const Vec3& place) {  // m^2
  const Vec3 from = place - flight.origin;
  const Vec3 across = from - std::clamp(glm::dot(from, flight.direction), 0.0f, flight.length) * flight.direction;
  return glm::dot(across, across);
}

/// The distance from the place within which kNeighbours of the flights pass, m.
double reach_among(const std::vector<PhotonBeam>& flights, const Vec3& place) {
  Neighbours neighbours;
  neighbours.start(kNeighbours, kInfinity);
  for (size_t first = 0; first < flights.size(); first += kBlock) {
    const size_t number = std::min<size_t>(kBlock, flights.size() - first);
    float distances2[kBlock] = {};
    for (size_t i = 0; i < number; ++i) distances2[i] = distance2_from(flights[first + i], place);
    neighbours.add(distances2, static_cast<uint32_t>(number), static_cast<uint32_t>(first), [](auto) { return true; });
  }
  neighbours.finish();
  return std::sqrt(neighbours.limit());
}

/// How near to places flights pass; nothing where either are too few. As many pass within a radius as go through a disc
/// of it: where flights are much shorter than the radius there are more, by the ends that lie within it.
std::optional<MapDensity> density_of_flights(const Scene& scene, const std::vector<Probe>& all,
                                             const std::vector<PhotonBeam>& flights, double emitted) {
  const std::vector<Probe> probes = thinned(all, kProbes);
  const std::vector<PhotonBeam> some = thinned(flights, kFlightsAround);
  if (probes.size() < kNeighbours || some.size() < 2 * kNeighbours) return std::nullopt;
  std::vector<double> reaches(probes.size());
  parallel_for_chunks(probes.size(), 1,
                      [&](size_t i, size_t, size_t) { reaches[i] = reach_among(some, probes[i].place); });
  const double share = static_cast<double>(some.size()) / static_cast<double>(flights.size());
  MapDensity density = density_of(scene, probes, reaches, share * emitted, 2);
  density.records = "flights";
  return density;
}

/// Where photons of a map are, seen straight: for caustics, and for what hardly a path from the eye comes to.
std::vector<Probe> places_of(const Camera& camera, const std::vector<Photon>& photons, MediumId medium = kVacuum) {
  std::vector<Probe> places;
  for (const Photon& photon : thinned(photons, kProbes))
    places.push_back({photon.position, pixel_at(camera, glm::distance(camera.position, photon.position)), medium});
  return places;
}

/// The probes of a map, or, where they are too few, places of its photons.
std::vector<Probe> probes_or_places(const Camera& camera, const std::vector<Probe>& probes, const MapInfo& map) {
  if (probes.size() >= kNeighbours) return probes;
  if (map.surfaces) return places_of(camera, *map.surfaces);
  std::vector<Probe> places;
  for (size_t medium = 0; medium < map.media->size(); ++medium)
    for (const Probe& place : places_of(camera, (*map.media)[medium], static_cast<MediumId>(medium)))
      places.push_back(place);
  return places;
}

/// The records of all media together.
template <class Record>
std::vector<Record> of_all_media(const std::vector<std::vector<Record>>& by_medium) {
  std::vector<Record> all;
  for (const std::vector<Record>& medium : by_medium) all.insert(all.end(), medium.begin(), medium.end());
  return all;
}

/// A map's photons before it is sorted, those of media together.
std::vector<Photon> photons_of(const MapInfo& map) { return map.surfaces ? *map.surfaces : of_all_media(*map.media); }

/// The pilot's only pass, traced.
struct PilotPass {
  Estimators estimators;
  Ledger ledger;
};
PilotPass trace(const Scene& scene, const RenderSettings& settings) {
  RenderStatistics statistics;
  Estimators estimators = plan_estimators(scene, settings, 0);
  trace_pass(scene, settings, estimators, {}, statistics);
  return {std::move(estimators), statistics.ledger};
}

}  // namespace

RenderSettings pilot_settings(RenderSettings settings, uint64_t photons) {
  settings.seed = ~settings.seed;
  settings.photons.emitted = photons;
  settings.photons.stored = kStored;
  settings.radii = RadiusSchedule::constant;
  return settings;
}

MapDensities map_densities(const Scene& scene, const RenderSettings& settings, uint64_t photons) {
  RenderSettings pilot = pilot_settings(settings, photons);
  pilot.caustics.emitted = std::min(pilot.aimed_photons(), pilot.photons.emitted);
  // Collisions end the tracing where they are many; flights do not.
  if (!pilot.volume.info().collisions) pilot.volume.choose("photon-beams");
  const PilotPass pass = trace(scene, pilot);
  const std::unique_ptr<DistanceStrategy> strategy = make_distance_strategy(settings.distance);
  Probes probes;
  for (uint64_t i = 0; i < kEyePaths; ++i) find_probe(scene, *strategy, settings.seed, i, probes);
  MapDensities densities;
  for (const MapInfo& map : pass.estimators.maps()) {
    const std::vector<Photon> stored = photons_of(map);
    const auto emitted = static_cast<double>(map.emitted > 0 ? map.emitted : pass.ledger.emitted_count);
    if (map.section == "caustics") {
      densities.caustics = density_around(scene, places_of(scene.camera, stored), stored, emitted, 2);
      continue;
    }
    densities.stored_per_photon =
        std::max(densities.stored_per_photon,
                 static_cast<double>(stored.size()) / static_cast<double>(pass.ledger.emitted_count));
    const bool media = map.section == "volume";
    const std::vector<Probe> places = probes_or_places(scene.camera, media ? probes.volume : probes.surface, map);
    std::optional<MapDensity>& density = media ? densities.volume : densities.surface;
    density = media && map.flights ? density_of_flights(scene, places, of_all_media(*map.flights), emitted)
                                   : density_around(scene, places, stored, emitted, media ? 3 : 2);
  }
  return densities;
}

double photons_of_pass(const RenderSettings& settings, double stored_per_photon) {
  const auto limit = static_cast<double>(settings.photons.emitted);
  const bool fills_maps = settings.integrator == Integrator::photon && settings.photons.stored > 0;
  if (!fills_maps || stored_per_photon == 0.0) return limit;
  const double full = static_cast<double>(settings.photons.stored) / stored_per_photon;
  return settings.photons.emitted == 0 ? full : std::min(limit, full);
}

}  // namespace vpm
