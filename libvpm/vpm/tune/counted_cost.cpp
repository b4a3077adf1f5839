// Linear in the counts. The coefficients are those of least relative squares, none negative.
#include "vpm/tune/counted_cost.h"

#include <algorithm>

#include "vpm/estimate/photon_map.h"
#include "vpm/integrators/photon_map/volume/estimator_info.h"

namespace vpm {
namespace {

constexpr double kNanosecond = 1e-9;  // s

double times(double each, uint64_t number) { return each * static_cast<double>(number) * kNanosecond; }

/// What each of them takes, ns.
struct EyeCosts {
  double camera_ray, ray, lookup, surface_query, volume_query, shadow_ray, visited, used;
};
constexpr EyeCosts kPaths{400.0, 220.0, 30.0, 0.0, 0.0, 0.0, 0.0, 0.0};
constexpr EyeCosts kCombinedWithBeams{0.0, 530.0, 42.0, 0.0, 0.0, 0.0, 1.9, 16.0};
constexpr EyeCosts kCombinedPoints{0.0, 570.0, 64.0, 0.0, 0.0, 0.0, 1.4, 7.8};
constexpr EyeCosts kMapsAlongRays{0.0, 300.0, 31.0, 180.0, 3700.0, 130.0, 2.2, 2.6};
constexpr EyeCosts kMapsAtPoints{280.0, 320.0, 44.0, 0.0, 360.0, 0.0, 0.0, 16.0};

const EyeCosts& costs_of(const RenderSettings& settings) {
  if (settings.integrator == Integrator::path) return kPaths;
  if (settings.integrator == Integrator::combined) {
    const TechniqueSet& techniques = settings.combined.techniques;
    const bool beams = techniques.has(Technique::short_beams);
    return beams ? kCombinedWithBeams : kCombinedPoints;
  }
  return settings.volume.info().along_rays ? kMapsAlongRays : kMapsAtPoints;
}

/// What one of many nearest photons on a surface takes that are summed by whole nodes, ns.
constexpr double kUsedByNodes = 1.6;

/// Are all estimates on surfaces such sums? Those on glossy surfaces and those of caustics are none.
bool surfaces_sum_by_nodes(const Scene& scene, const RenderSettings& settings) {
  const auto sums_or_gathers_nothing = [](const Material& material) {
    return !is_rough(material) || is_diffuse(material);
  };
  return settings.integrator == Integrator::photon && sums_by_nodes(settings.surface) &&
         settings.aimed_photons() == 0 &&
         std::all_of(scene.materials.begin(), scene.materials.end(), sums_or_gathers_nothing);
}

/// What all photons take that count in estimates.
double seconds_of_used(const Scene& scene, const RenderSettings& settings, const EyeCounters& eye, double each) {
  const uint64_t in_media = eye.used_in_media, on_surfaces = eye.gather.used - in_media;
  return times(each, in_media) + times(surfaces_sum_by_nodes(scene, settings) ? kUsedByNodes : each, on_surfaces);
}

/// The same of photons and light sub-paths.
struct PhotonCosts {
  double emitted, ray, collision, surface_hit, lookup, null_collision, stored_in_media, stored_on_surfaces, flight;
};
constexpr PhotonCosts kPhotons{0.0, 360.0, 0.0, 55.0, 86.0, 88.0, 115.0, 0.0, 310.0};
constexpr PhotonCosts kSubPaths{84.0, 410.0, 0.0, 450.0, 31.0, 0.0, 420.0, 13.0, 720.0};

}  // namespace

CountedWork counted_work(const Scene& scene, const RenderSettings& settings, const EyeCounters& eye) {
  const EyeCosts& each = costs_of(settings);
  CountedWork work;
  work.of_photons = times(each.visited, eye.gather.visited) + seconds_of_used(scene, settings, eye, each.used);
  work.seconds = work.of_photons + times(each.camera_ray, eye.rays) + times(each.ray, eye.walk.rays) +
                 times(each.lookup, eye.walk.lookups) + times(each.surface_query, eye.surface_queries) +
                 times(each.volume_query, eye.volume_queries) + times(each.shadow_ray, eye.shadow_rays);
  return work;
}

double counted_seconds_of_photons(const RenderSettings& settings, const RenderStatistics& pass) {
  const PhotonCosts& each = settings.integrator == Integrator::combined ? kSubPaths : kPhotons;
  const Ledger& traced = pass.ledger;
  return times(each.emitted, traced.emitted_count) + times(each.ray, traced.walk.rays) +
         times(each.collision, traced.collisions) + times(each.surface_hit, traced.surface_hits) +
         times(each.lookup, traced.walk.lookups) + times(each.null_collision, traced.walk.null_collisions) +
         times(each.stored_in_media, pass.volume_photons) + times(each.stored_on_surfaces, pass.surface_photons) +
         times(each.flight, pass.flights);
}

double counted_seconds_of_caustics(double paths) {
  constexpr double kPath = 1500.0;  // ns
  return kPath * paths * kNanosecond;
}

double counted_seconds_of_guide(uint64_t importons) {
  constexpr double kImporton = 3000.0;  // ns
  return times(kImporton, importons);
}

}  // namespace vpm
