// Direct light, photon maps, and rays that gather.
#include "vpm/render/surface_light.h"

#include "vpm/base/count.h"
#include "vpm/estimate/surface_region.h"
#include "vpm/path/direct_light.h"
#include "vpm/render/gather_guide.h"
#include "vpm/surface/shading.h"

namespace vpm {
namespace {

class SurfaceLight {
 public:
  SurfaceLight(const EyeContext& context, Rng& rng, EyeCounters& counters)
      : c_(context), rng_(rng), counters_(counters) {}

  Rgb towards_eye(const SurfaceView& view, int gather_rays) {
    if (c_.stages.final_gather) return not_gathered(view) + gathered(view, gather_rays);
    if (view.own) return direct_light(view) + of_disc(view, *view.own);
    return c_.stages.surface_map ? direct_light(view) + of_map(view, c_.surface) : direct_light(view);
  }

 private:
  Rgb direct_light(const SurfaceView& view) {
    if (!c_.stages.surface_shadow_rays) return Rgb(0.0f);
    Rgb result = direct_light(view, near_side(view.hit, view.travel, view.medium));
    if (scatters_through(view.material))
      result += direct_light(view, far_side(c_.scene, view.hit, view.travel, view.medium));
    return result;
  }

  /// The light of all lamps that arrives on that side.
  Rgb direct_light(const SurfaceView& view, const Receiver& side) {
    Rgb result(0.0f);
    for (int i = 0; i < static_cast<int>(c_.scene.lights.size()); ++i) {
      count(counters_.shadow_rays);
      const DirectSample light = sample_direct({c_.scene, *c_.transmittance, rng_, counters_.walk}, i, side);
      if (is_black(light.irradiance)) continue;
      const ScatterValue scattered = scatter_value(view.material, view.hit, view.travel, light.direction);
      result += scattered.value * scattered.radiance_scale * light.irradiance;
    }
    return result;
  }

  Rgb of_map(const SurfaceView& view, const PhotonMap& map) {
    count(counters_.surface_queries);
    if (map.settings.boundary == BoundaryRule::none)
      return scattered_radiance(view.material, view.hit, -view.travel, CountedMap{map, counters_.gather});
    const SurfaceRegion region(c_.scene, view.hit, -view.travel, map.settings);
    return scattered_radiance(view.material, view.hit, -view.travel, BoundedMap{map, region, counters_.gather});
  }

  /// The surface map's light by a pixel's own radius.
  Rgb of_disc(const SurfaceView& view, const PixelGather& own) {
    count(counters_.surface_queries);
    const uint64_t before = counters_.gather.used;
    const CountedMap disc{c_.surface, counters_.gather, own.settings};
    const Rgb radiance = scattered_radiance(view.material, view.hit, -view.travel, disc);
    *own.found += counters_.gather.used - before;
    return radiance;
  }

  /// What rays do not gather, because few of them would find it: the light of lamps, straight or by way of mirrors,
  /// glass and media.
  Rgb not_gathered(const SurfaceView& view) { return direct_light(view) + of_map(view, c_.caustics); }

  /// The light that rough surfaces scattered last, by rays.
  Rgb gathered(const SurfaceView& view, int rays) {
    const GatherGuide guide = make_guide(view);
    Rgb sum(0.0f);
    for (int i = 0; i < rays; ++i) {
      const Scatter scatter = guide.sample(rng_);
      if (is_black(scatter.weight)) continue;
      const Shape& shape = c_.scene.shapes[view.hit.shape];
      const MediumId medium =
          scatter.transmitted ? medium_beyond(shape, view.hit.normal, scatter.direction, view.medium) : view.medium;
      const Ray ray{leave_surface(view.hit, scatter.direction), scatter.direction};
      sum += scatter.weight * scatter.radiance_scale * met_along({ray, medium, Rgb(1.0f)});
    }
    return sum / static_cast<float>(rays);
  }

  GatherGuide make_guide(const SurfaceView& view) {
    if (!c_.stages.guided_gather) return GatherGuide(view);
    count(counters_.surface_queries);
    return {view, c_.from_rough, counters_.gather};
  }

  /// Radiance of the rough surface that a gathering ray meets. Lamps on its way are left out: their light is direct, or
  /// the caustic map's.
  ///
  /// At the end of a ray that is too short for the map the path goes on as a path tracer's would, with one ray at a
  /// time and the same roulette, until a ray is long enough.
  Rgb met_along(PathState path) {
    Rgb result(0.0f);
    float length = 0.0f;  // of the present ray so far, m
    for (int events = 0; events < c_.settings.max_events;) {
      if (length == 0.0f) count(counters_.gather_rays);
      const Encounter met = meet(c_.scene, path.ray, kInfinity, path.medium, counters_.walk);
      if (!met) return result;
      const Hit& hit = met.hits[0];
      if (path.medium != kVacuum) {
        const Medium& medium = c_.scene.media[path.medium];
        path.power *= transmittance(medium, counted_column(medium, path.ray, {0.0f, hit.t}, counters_.walk));
      }
      if (is_black(path.power)) return result;
      length += hit.t;
      const Material material = material_at(c_.scene, hit);
      if (is_boundary(material)) {  // no event
        cross_boundaries(c_.scene, met, path.ray, path.medium, counters_.walk);
        continue;
      }
      if (is_rough(material)) {
        const SurfaceView view{hit, material, path.ray.direction, path.medium};
        if (!is_too_short(length, view)) return result + path.power * of_end(view);
        result += path.power * not_gathered(view);
        length = 0.0f;  // of the next ray
      }
      Scatter scatter;
      if (!scatter_at_surface(c_.scene, hit, path, rng_, scatter)) return result;
      path.power *= scatter.radiance_scale;
      ++events;
    }
    ++counters_.cut_paths;
    return result;
  }

  /// What a gathering ray sees of all light where it ends: from the points where it was computed beforehand, or, where
  /// none is near, and of surfaces that are not Lambertian, from the map.
  Rgb of_end(const SurfaceView& view) {
    const Rgb* diffuse = diffuse_reflectance(view.material);
    if (!c_.stages.irradiance_points || !diffuse) return of_map(view, c_.surface);
    const std::optional<Rgb> irradiance = c_.irradiance.irradiance(view.hit, -view.travel, counters_.gather);
    if (irradiance) {
      count(counters_.irradiance_lookups);
      return *diffuse / kPi * *irradiance;
    }
    count(counters_.irradiance_misses);
    return of_map(view, c_.surface);
  }

  /// Is a ray shorter than the radius of what the map tells at its end? At borders the k nearest of a region may reach
  /// farther than those of all photons: the largest radius stands for theirs.
  bool is_too_short(float length, const SurfaceView& view) {
    const CountedMap map{c_.surface, counters_.gather};
    return length < map.settings.radius && (map.settings.boundary == BoundaryRule::corrected ||
                                            length < scattered_radius(view.material, view.hit, -view.travel, map));
  }

  const EyeContext& c_;
  Rng& rng_;
  EyeCounters& counters_;
};

}  // namespace

Rgb surface_light(const EyeContext& context, const SurfaceView& view, int gather_rays, Rng& rng,
                  EyeCounters& counters) {
  return SurfaceLight(context, rng, counters).towards_eye(view, gather_rays);
}

}  // namespace vpm
