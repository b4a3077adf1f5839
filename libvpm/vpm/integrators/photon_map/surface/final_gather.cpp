// Maps, and rays that gather.
#include "vpm/integrators/photon_map/surface/final_gather.h"

#include "vpm/base/clock.h"
#include "vpm/base/counters.h"
#include "vpm/estimate/eye_segment.h"
#include "vpm/estimate/surface_estimate.h"
#include "vpm/integrators/photon_map/check.h"
#include "vpm/photon/caustics.h"
#include "vpm/surface/shading.h"

namespace vpm {
namespace {

HitUse use_of_ends(const IndirectSettings& settings) {
  return settings.irradiance == EndIrradiance::precomputed ? HitUse::surface_map_without_cache_points
                                                           : HitUse::surface_map;
}

}  // namespace

FinalGather::FinalGather(const Scene& scene, const RenderSettings& settings, const PassOfMaps& pass,
                         std::optional<SurfaceShadowRays> direct)
    : scene_(scene),
      settings_(settings.indirect),
      caustic_settings_(settings.caustics),
      max_events_(settings.max_events),
      pass_(pass),
      direct_(std::move(direct)),
      ends_(scene, settings.surface, pass, any_photon, use_of_ends(settings.indirect)),
      caustic_photons_(scene, caustic_photons(!direct_, settings.caustics.emitted == 0), HitUse::other_map) {
  caustic_settings_.boundary = settings.surface.boundary;
  if (settings_.rays_by == GatherBy::photons) guiding_photons_.emplace(scene, photon_from_rough, HitUse::other_map);
  if (settings_.irradiance == EndIrradiance::precomputed) cache_points_.emplace(scene);
}

std::vector<MapInfo> FinalGather::maps() const {
  MapInfo ends = ends_.info();
  ends.shows_bias = !cache_points_;
  return {ends,
          {.section = "caustics",
           .dimension = 2,
           .surfaces = &caustic_photons_.photons,
           .emitted = caustic_settings_.emitted,
           .surface_histories = &caustic_photons_.histories}};
}

Recorders FinalGather::recorders() {
  Recorders all{ends_.recorder(), &caustic_photons_};
  if (guiding_photons_) all.push_back(&*guiding_photons_);
  if (cache_points_) all.push_back(&*cache_points_);
  return all;
}

/// Adds caustic photons that are aimed, with powers as if they were as many as the others.
void FinalGather::trace_more(const TracedPass& pass, RenderStatistics& statistics) {
  if (caustic_settings_.emitted == 0) return;
  const Stopwatch tracing;
  const TraceSettings& trace = pass.settings;
  CausticSettings aimed{trace.seed, trace.pass, caustic_settings_.emitted, trace.max_events, nullptr};
  if (trace.guide) aimed.importance = &trace.guide->importance;
  const auto share = static_cast<float>(static_cast<double>(pass.emitted) / static_cast<double>(aimed.emitted));
  for (Photon& photon : trace_caustics(scene_, pass.strategy, aimed)) {
    photon.power *= share;
    caustic_photons_.photons.push_back(photon);
    ++statistics.aimed_photons;
  }
  statistics.caustic_seconds = tracing.seconds();
}

void FinalGather::build(uint64_t emitted, RenderStatistics& statistics) {
  ends_.build(statistics);
  statistics.caustic_photons = caustic_photons_.photons.size();
  const GatherSettings gather = gather_in_pass(caustic_settings_, first_radius(caustic_settings_, scene_), 2, pass_);
  caustics_ = make_map(caustic_photons_.photons, gather, emitted, pass_, statistics);
  if (guiding_photons_) {
    GatherSettings nearest = kGuidingPhotons;
    nearest.radius = kDefaultSearch * scene_.bounds.diagonal();
    statistics.guiding_photons = guiding_photons_->photons.size();
    guiding_ = make_map(guiding_photons_->photons, nearest, emitted, pass_, statistics);
  }
  if (cache_points_) {
    irradiance_ = IrradianceCache(cache_points_->points, ends_.map(), statistics.eye.gather);
    statistics.irradiance_points = irradiance_.size();
    statistics.photon_map_bytes += irradiance_.memory_bytes();
  }
}

KernelEstimate FinalGather::found_by_rays(const SurfaceView& view, EyeWork& work) const {
  const KernelEstimate blurred = gathered(view, work);
  return blurred + not_gathered(view, work);
}

/// What rays do not gather, because few of them would find it: the light of lights, straight or by way of mirrors,
/// glass and media.
KernelEstimate FinalGather::not_gathered(const SurfaceView& view, EyeWork& work) const {
  const Rgb direct = direct_ ? direct_->sent(view, work) : Rgb(0.0f);
  return gather_from(caustics_, scene_, view, work) + direct;
}

/// The light that rough surfaces scattered last, by rays.
KernelEstimate FinalGather::gathered(const SurfaceView& view, EyeWork& work) const {
  const GatherGuide guide = make_guide(view, work);
  KernelEstimate sum;
  for (int i = 0; i < settings_.rays; ++i) {
    const Scatter scatter = guide.sample(work.rng);
    if (is_black(scatter.weight)) continue;
    const Shape& shape = scene_.shapes[view.hit.shape];
    const MediumId medium =
        scatter.transmitted ? medium_beyond(shape, view.hit.normal, scatter.direction, view.medium) : view.medium;
    const Ray ray{leave_surface(view.hit, scatter.direction), scatter.direction};
    sum += scatter.weight * scatter.radiance_scale * met_along({ray, medium, Rgb(1.0f)}, work);
  }
  return sum * Rgb(1.0f / static_cast<float>(settings_.rays));
}

GatherGuide FinalGather::make_guide(const SurfaceView& view, EyeWork& work) const {
  if (!guiding_photons_) return GatherGuide(view);
  count(work.counters.surface_queries);
  return {view, guiding_, work.gather()};
}

/// Radiance of the rough surface that a gathering ray meets. Lights on its way are left out: their light is direct, or
/// the caustic map's.
///
/// At the end of a ray that is too short for the map the path goes on as a path tracer's would, with one ray at a
/// time and the same roulette, until a ray is long enough.
KernelEstimate FinalGather::met_along(PathState path, EyeWork& work) const {
  KernelEstimate result;
  float length = 0.0f;  // of the present ray so far, m
  for (int events = 0; events < max_events_;) {
    if (length == 0.0f) count(work.counters.gather_rays);
    const Encounter met = meet(scene_, path.ray, kInfinity, path.medium, work.counters.walk);
    if (!met) return result;
    const Hit& hit = met.hits[0];
    if (path.medium != kVacuum) {
      const Medium& medium = scene_.media[path.medium];
      path.throughput *=
          transmittance(medium, counted_density_integral(medium, path.ray, {0.0f, hit.t}, work.counters.walk));
    }
    if (is_black(path.throughput)) return result;
    length += hit.t;
    const Material material = material_at(scene_, hit);
    if (is_boundary(material)) {  // no event
      cross_boundaries(scene_, met, path.ray, path.medium, work.counters.walk);
      continue;
    }
    if (is_rough(material)) {
      const SurfaceView view{hit, material, path.ray.direction, path.medium};
      if (!is_too_short(length, view, work)) return result + path.throughput * at_end(view, work);
      result += path.throughput * not_gathered(view, work);
      length = 0.0f;  // of the next ray
    }
    Scatter scatter;
    if (!scatter_at_surface(scene_, hit, path, work.rng, scatter)) return result;
    path.throughput *= scatter.radiance_scale;
    ++events;
  }
  ++work.counters.cut_paths;
  return result;
}

/// What a gathering ray sees of all light where it ends: from the points where it was computed beforehand, or, where
/// none is near, and of surfaces that are not diffuse, from the map.
KernelEstimate FinalGather::at_end(const SurfaceView& view, EyeWork& work) const {
  const Rgb* diffuse = diffuse_reflectance(view.material);
  if (!cache_points_ || !diffuse) return ends_.gather(view, work);
  const std::optional<Rgb> irradiance = irradiance_.irradiance(view.hit, -view.travel, work.gather());
  if (irradiance) {
    count(work.counters.irradiance_lookups);
    return *diffuse / kPi * *irradiance;
  }
  count(work.counters.irradiance_misses);
  return ends_.gather(view, work);
}

/// Is a ray shorter than the radius of the gather at its end? At borders the k nearest of a region may reach
/// farther than those of all photons: the largest radius stands for theirs.
bool FinalGather::is_too_short(float length, const SurfaceView& view, EyeWork& work) const {
  const CountedMap map{ends_.map(), work.gather()};
  return length < map.settings.radius && (map.settings.boundary == BoundaryRule::corrected ||
                                          length < scattered_radius(view.material, view.hit, -view.travel, map));
}

void check_final_gather(const RenderSettings& s) {
  if (s.indirect.type != IndirectLight::final_gather) return;
  const bool precomputed = s.indirect.irradiance == EndIrradiance::precomputed;
  refuse_count_in_blocks(s, s.caustics, "integrator.caustics.type", "write \"radius\"");
  refuse_in_blocks(s, s.indirect.rays_by == GatherBy::photons, "integrator.indirect.rays_by",
                   "the photons of one block would guide its rays otherwise than those of another",
                   "write \"material\"");
  refuse_in_blocks(s, precomputed, "integrator.indirect.irradiance",
                   "irradiance would be computed at the places of one block's photons, from these alone",
                   "write \"estimate\"");
  refuse_in_blocks(s, s.caustics.emitted > 0, "integrator.caustics.emitted",
                   "photons that are aimed have none of their own", "leave out 'emitted' of [integrator.caustics]");
  refuse_if(precomputed && s.surface.boundary == BoundaryRule::corrected, "integrator.indirect.irradiance",
            "irradiance is computed beforehand without a correction at borders",
            "write \"estimate\", or make 'boundary' of [integrator.surface] \"none\"");
  refuse_if(precomputed && kernel_order(s.surface.kernel) > 2, "integrator.surface.kernel",
            "irradiance computed beforehand must not be negative, as that by a kernel of order 4 may be",
            "use another kernel, or make 'irradiance' \"estimate\"");
}

}  // namespace vpm
