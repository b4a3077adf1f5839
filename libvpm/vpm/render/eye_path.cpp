// Radiance along camera rays.
#include "vpm/render/eye_path.h"

#include <optional>
#include <span>

#include "vpm/base/count.h"
#include "vpm/base/exp_negative.h"
#include "vpm/estimate/volume_estimate.h"
#include "vpm/estimate/volume_region.h"
#include "vpm/medium/columns_along.h"
#include "vpm/render/single_scattering.h"
#include "vpm/render/surface_light.h"

namespace vpm {
namespace {

/// The most steps among photons in one stretch of a ray.
constexpr float kMostSteps = 10'000.0f;

/// How long steps among photons are, m: a gather radius, so that none is passed by. In stretches of too many of these
/// (thin media that reach ever so far) longer: noisier then, but no less right.
float step_among(const PhotonMap& map, const Interval& interval) {
  return std::max(map.settings.radius, interval.length() / kMostSteps);
}

/// transmittance() of a finite column, as quick as photons along a ray need it: off by 1e-7 of the optical thickness.
inline Rgb beam_transmittance(const Rgb& sigma_t, float column) {
  const Rgb optical = sigma_t * column;
  return {exp_negative(-optical.r), exp_negative(-optical.g), exp_negative(-optical.b)};
}

/// beam_transmittance() from feet on a ray through a grid; times the density there and `per_density`, where that is not
/// 0.
void pass_grid(const ColumnsAlong& columns, const Rgb& sigma_t, float per_density, std::span<const float> feet,
               Passed& passed) {
  float column[PhotonBatch::kMost], share[PhotonBatch::kMost];
  for (size_t i = 0; i < feet.size(); ++i) {
    const ColumnsAlong::Place place = columns.at(feet[i]);
    column[i] = static_cast<float>(place.column);
    share[i] = per_density > 0.0f ? static_cast<float>(place.density) * per_density : 1.0f;
  }
  for (size_t i = 0; i < feet.size(); ++i) {
    const Rgb kept = beam_transmittance(sigma_t, column[i]) * share[i];
    passed.r[i] = kept.r;
    passed.g[i] = kept.g;
    passed.b[i] = kept.b;
  }
}

class EyePath {
 public:
  EyePath(const EyeContext& context, const Ray& ray, Marcher& marcher, Rng& rng, EyeCounters& counters,
          const PixelGather* own)
      : c_(context),
        ray_(ray),
        marcher_(marcher),
        rng_(rng),
        counters_(counters),
        own_(own),
        medium_(medium_of_ray(context.scene, context.scene.camera_medium, ray)) {}

  Rgb follow() {
    for (int events = 0; events < c_.settings.max_events;) {
      const Encounter met = meet(c_.scene, ray_, kInfinity, medium_, counters_.walk);
      cross_segment({0.0f, met ? met.hits[0].t : kInfinity});
      if (is_black(throughput_)) return radiance_;
      if (!met) {
        for (const Light& light : c_.scene.lights)
          radiance_ += throughput_ * environment_radiance(light, ray_.direction);
        return radiance_;
      }
      const Hit& hit = met.hits[0];
      const Material material = material_at(c_.scene, hit);
      see_lamp(hit);
      if (is_boundary(material)) {  // no event
        cross_boundaries(c_.scene, met, ray_, medium_, counters_.walk);
        continue;
      }
      if (!meet_surface(hit, material)) return radiance_;
      ++events;
    }
    ++counters_.cut_paths;
    return radiance_;
  }

 private:
  /// Adds what media scatter towards the eye along the segment, and attenuates by it.
  void cross_segment(const Interval& segment) {
    const bool at_photon = c_.stages.volume_map && c_.settings.volume_form == VolumeForm::density_at_photon;
    if (at_photon && !c_.stages.beams) gather_photon_densities(segment);
    const std::optional<double> crossed = c_.stages.beams ? gather_beams(segment) : std::nullopt;
    if (medium_ == kVacuum) return;
    const Medium& medium = c_.scene.media[medium_];
    if (c_.stages.equiangular)
      radiance_ += single_scattering(c_, {ray_, segment, medium_, throughput_}, rng_, counters_);
    const bool marches = c_.stages.volume_map && !c_.stages.beams && !at_photon;
    const PhotonMap* map = marches && c_.volume[medium_].size() > 0 ? &c_.volume[medium_] : nullptr;
    if (!medium.scatters() || (!map && !c_.stages.marched_shadow_rays())) {
      throughput_ *= transmittance(medium, crossed ? *crossed : counted_column(medium, ray_, segment, counters_.walk));
      return;
    }
    // Fine steps where there are photons to gather; elsewhere only single scattering is left to find, in steps of
    // optical thickness.
    const Interval near = map ? clip(segment, map->bounds(), map->settings.radius) : Interval{segment.t1, segment.t1};
    if (near.empty()) {
      march_media(medium, segment, nullptr);
    } else {
      march_media(medium, {segment.t0, near.t0}, nullptr);
      march_media(medium, near, map);
      march_media(medium, {near.t1, segment.t1}, nullptr);
    }
  }

  /// Adds what the medium scatters towards the eye along an interval, and attenuates by it.
  void march_media(const Medium& medium, const Interval& interval, const PhotonMap* map) {
    if (interval.empty() || is_black(throughput_)) return;
    if (!map && !c_.stages.marched_shadow_rays()) {
      throughput_ *= transmittance(medium, counted_column(medium, ray_, interval, counters_.walk));
      return;
    }
    const StepLimits limits{map ? step_among(*map, interval) : kInfinity, c_.settings.max_optical_step};
    const float densest = medium.max_density();
    const glm::bvec3 matters = glm::greaterThan(throughput_ * medium.sigma_s, Rgb(0.0f));
    const Marched marched =
        marcher_.march(medium, ray_, interval, limits, matters, rng_, [&](const Vec3& point, const Rgb& weight) {
          if (map) {
            count(counters_.volume_queries);
            radiance_ += throughput_ * (weight / densest) * medium.albedo() * sum_at_query(medium, point, *map);
          }
          if (c_.stages.marched_shadow_rays()) {
            const PickedLight light = pick_light(c_.scene, rng_.uniform_double());
            radiance_ += throughput_ * (weight * medium.sigma_s) *
                         scattered_light(c_, {light, {}}, {point, medium_}, ray_.direction, rng_, counters_);
          }
        });
    count(counters_.steps, marched.steps);
    count(counters_.walk.lookups, marched.lookups);
    throughput_ *= transmittance(medium, marched.column);
  }

  /// The estimate with the density at the photon: photons of any medium count wherever they lie within the radius of
  /// the ray, also where the ray itself is in empty space or outside the medium.
  void gather_photon_densities(const Interval& segment) {
    const Medium* around = medium_ == kVacuum ? nullptr : &c_.scene.media[medium_];
    for (size_t m = 0; m < c_.volume.size(); ++m) {
      const PhotonMap& map = c_.volume[m];
      const Interval near = clip(segment, map.bounds(), map.settings.radius);
      if (map.size() == 0 || near.empty()) continue;
      const double before = around ? counted_column(*around, ray_, {segment.t0, near.t0}, counters_.walk) : 0.0;
      const Medium& medium = c_.scene.media[m];
      const uint32_t lookups = march_evenly(
          around, ray_, near, before, step_among(map, near), rng_, [&](const Vec3& point, const Rgb& weight) {
            count(counters_.volume_queries);
            radiance_ += throughput_ * weight * medium.albedo() *
                         volume_sum(medium.phase, point, -ray_.direction, CountedMap{map, counters_.gather});
          });
      count(counters_.walk.lookups, lookups);
    }
  }

  /// The beam radiance estimate, in one query of each map: with the density at the query of the medium that the ray is
  /// in, with that at the photon of all. Returns the column of the segment, m, where the medium was walked along.
  std::optional<double> gather_beams(const Interval& segment) {
    static thread_local ColumnsAlong columns;
    const bool at_query = c_.settings.volume_form == VolumeForm::density_at_query;
    const Medium* around = medium_ == kVacuum ? nullptr : &c_.scene.media[medium_];
    std::optional<double> crossed;
    for (size_t m = 0; m < c_.beams.size(); ++m) {
      const BeamMap& map = c_.beams[m];
      const Medium& medium = c_.scene.media[m];
      if (map.photons.size() == 0 || (at_query && &medium != around)) continue;
      const Interval near = clip(segment, map.photons.bounds(), map.settings.radius);
      if (near.empty()) continue;
      count(counters_.volume_queries);
      const Rgb scale = throughput_ * medium.albedo();
      if (!around || around->homogeneous()) {
        const Rgb sigma_t = around ? around->sigma_t : Rgb(0.0f);
        const auto passed = each_foot([&](float t) { return beam_transmittance(sigma_t, t - segment.t0); });
        radiance_ += scale * beam_sum(medium.phase, ray_, near, passed, map, counters_.gather);
        continue;
      }
      if (!crossed) {
        count(counters_.walk.lookups, columns.walk(around, ray_, segment));
        crossed = columns.column();
      }
      const auto passed = [&](std::span<const float> feet, Passed& into) {
        pass_grid(columns, around->sigma_t, at_query ? 1.0f / medium.max_density() : 0.0f, feet, into);
      };
      radiance_ += scale * beam_sum(medium.phase, ray_, near, passed, map, counters_.gather);
    }
    return crossed;
  }

  /// volume_sum() towards the eye, at a point of the medium that the ray is in.
  Rgb sum_at_query(const Medium& medium, const Vec3& point, const PhotonMap& map) {
    if (map.settings.boundary == BoundaryRule::none)
      return volume_sum(medium.phase, point, -ray_.direction, CountedMap{map, counters_.gather});
    const VolumeRegion region(c_.scene, medium_, point, map.settings.kernel);
    return volume_sum(medium.phase, point, -ray_.direction, BoundedMap{map, region, counters_.gather});
  }

  /// The part of the segment in the box grown by `margin`.
  Interval clip(const Interval& segment, const Box& box, float margin) const {
    double t0 = segment.t0, t1 = segment.t1;
    clip_to_box(Vec3d(ray_.origin), Vec3d(ray_.direction), Vec3d(box.lo - margin), Vec3d(box.hi + margin), t0, t1);
    return {static_cast<float>(t0), static_cast<float>(t1)};
  }

  /// Adds what a surface emits towards the eye.
  void see_lamp(const Hit& hit) {
    const int light = c_.scene.shapes[hit.shape].light;
    if (light >= 0) radiance_ += throughput_ * surface_radiance(c_.scene.lights[light], hit.normal, ray_.direction);
  }

  /// Adds what a rough surface scatters towards the eye; goes on from others. Returns whether the path goes on.
  bool meet_surface(const Hit& hit, const Material& material) {
    if (is_rough(material)) {
      const SurfaceView view{hit, material, ray_.direction, medium_, own_};
      radiance_ += throughput_ * surface_light(c_, view, c_.settings.gather_rays, rng_, counters_);
      return false;
    }
    PathState state{ray_, medium_, throughput_};
    Scatter scatter;
    if (!scatter_at_surface(c_.scene, hit, state, rng_, scatter)) return false;
    ray_ = state.ray;
    medium_ = state.medium;
    throughput_ = state.power * scatter.radiance_scale;
    return true;
  }

  const EyeContext& c_;
  Ray ray_;
  Marcher& marcher_;
  Rng& rng_;
  EyeCounters& counters_;
  const PixelGather* own_;
  MediumId medium_;
  Rgb throughput_{1.0f};
  Rgb radiance_{0.0f};
};

}  // namespace

Rgb eye_radiance(const EyeContext& context, const Ray& camera_ray, Marcher& marcher, Rng& rng, EyeCounters& counters,
                 const PixelGather* own) {
  return EyePath(context, camera_ray, marcher, rng, counters, own).follow();
}

}  // namespace vpm
