// Paths from the eye, event by event.
#include "vpm/integrators/path/path_tracer.h"

#include <cmath>

#include "vpm/base/counters.h"
#include "vpm/path/direct_light.h"
#include "vpm/path/emission_along.h"
#include "vpm/path/follow.h"
#include "vpm/path/path_weight.h"
#include "vpm/surface/shading.h"

namespace vpm {
namespace {

/// The visitor of one path's walk.
class TracedPath {
 public:
  TracedPath(const PathContext& context, Rng& rng, EyeCounters& counters)
      : c_(context), rng_(rng), counters_(counters), media_emit_(context.scene.has_emitting_media()) {}

  bool see(const Event& event, const PathState& from, PathState& at) {
    if (!is_finite(at.throughput)) {  // no roulette: that would end it as if it were black
      radiance_ = at.throughput;
      return false;
    }
    if (media_emit_) add_emission(from);
    weight_.meet(weight(at.throughput), event);
    if (event.kind == EventKind::collision) return collide(at);
    if (event.kind == EventKind::surface) return meet_surface(event.hit, from.ray.origin, at);
    see_environment(from.ray.origin, at);
    return false;
  }

  bool scatter(const Scene& scene, const Event& event, PathState& at, Rng& rng) {
    if (event.kind == EventKind::collision) {
      const MediumProperties here = scene.media[at.medium].properties(at.ray.origin);
      const Vec3 travel = at.ray.direction;
      if (!scatter_in_medium(here, at, rng)) return false;
      scatter_pdf_ = phase_value(here.phase, travel, at.ray.direction);
      return true;
    }
    Scatter scatter;
    if (!scatter_at_surface(scene, event.hit, at, rng, scatter)) return false;
    at.throughput *= scatter.radiance_scale;
    scatter_pdf_ = scatter.pdf;
    return true;
  }

  void cut(const PathState&) { ++counters_.cut_paths; }

  /// What the path has found, once it has ended.
  Rgb radiance() {
    weight_.add_to(counters_.weights);
    return radiance_;
  }

 private:
  /// The mean magnitude of the channels' throughput, with the sign of their sum.
  static double weight(const Rgb& throughput) {
    return std::copysign(sum_channels(glm::abs(throughput)) / 3.0, sum_channels(throughput));
  }

  bool collide(PathState& at) {
    if (!survive_roulette(max_channel(glm::abs(at.throughput)), at, rng_)) return false;
    const MediumProperties here = c_.scene.media[at.medium].properties(at.ray.origin);
    const DirectSample light = sample_light({at.ray.origin, at.medium});
    if (is_black(light.irradiance)) return true;
    const float phase = phase_value(here.phase, at.ray.direction, light.direction);
    radiance_ += at.throughput * here.albedo() * phase * light.irradiance * mis_weight(light.pdf, phase);
    return true;
  }

  bool meet_surface(const Hit& hit, const Vec3& from, PathState& at) {
    const Vec3 travel = at.ray.direction;
    const int light = c_.scene.shapes[hit.shape].light;
    if (light >= 0) {
      const Rgb emitted = surface_radiance(c_.scene.lights[light], hit.normal, travel);
      radiance_ += at.throughput * emitted *
                   mis_weight_of_path(light, from, {travel, glm::distance(from, hit.position), hit.normal});
    }
    if (!survive_roulette(max_channel(glm::abs(at.throughput)), at, rng_)) return false;
    const Material material = material_at(c_.scene, hit);
    if (!is_rough(material)) return true;
    const RoughHit met{hit, material, travel, at.throughput};
    add_direct_light(met, near_side(hit, travel, at.medium));
    if (scatters_through(material)) add_direct_light(met, far_side(c_.scene, hit, travel, at.medium));
    return true;
  }

  /// A rough surface that the path meets.
  struct RoughHit {
    const Hit& hit;
    const Material& material;
    const Vec3& travel;
    const Rgb& throughput;
  };

  /// Adds what a rough surface scatters towards the eye of one light that arrives on that side.
  void add_direct_light(const RoughHit& met, const Receiver& side) {
    const DirectSample light = sample_light(side);
    if (is_black(light.irradiance)) return;
    const ScatterValue scattered = scatter_value(met.material, met.hit, met.travel, light.direction);
    radiance_ += met.throughput * scattered.value * scattered.radiance_scale * light.irradiance *
                 mis_weight(light.pdf, scattered.pdf);
  }

  /// Adds what media emit along a flight's ray, up to the next surface, wherever the flight ends.
  void add_emission(const PathState& from) {
    each_emission(c_.scene, from.ray, from.medium, counters_.walk, [&](MediumId medium, const Rgb& radiance) {
      if (is_black(radiance)) return;
      const int light = c_.scene.medium_light[medium];
      radiance_ +=
          from.throughput * radiance * mis_weight_of_path(light, from.ray.origin, {.direction = from.ray.direction});
    });
  }

  /// Adds the environment seen by a ray that left `from`.
  void see_environment(const Vec3& from, const PathState& at) {
    for (size_t i = 0; i < c_.scene.lights.size(); ++i) {
      const Rgb seen = environment_radiance(c_.scene.lights[i], at.ray.direction);
      if (!is_black(seen))
        radiance_ +=
            at.throughput * seen * mis_weight_of_path(static_cast<int>(i), from, {.direction = at.ray.direction});
    }
  }

  /// One light, picked by power: its irradiance over that probability, its pdf times it.
  DirectSample sample_light(const Receiver& receiver) {
    const PickedLight picked = pick_light(c_.scene, rng_.uniform_double());
    count(counters_.shadow_rays);
    DirectSample sample = sample_direct({c_.scene, *c_.transmittance, rng_, counters_.walk}, picked.number, receiver);
    sample.irradiance /= picked.probability;
    sample.pdf *= picked.probability;
    return sample;
  }

  /// The part that a shadow ray has in what it finds; all of it where scattering cannot find the light.
  static float mis_weight(float light_pdf, float scattering_pdf) {
    return light_pdf > 0.0f ? light_pdf / (light_pdf + scattering_pdf) : 1.0f;
  }

  /// The part that the path has in the light it ran into: all where no shadow ray could have found it.
  float mis_weight_of_path(int light, const Vec3& from, const SeenLight& seen) const {
    if (std::isinf(scatter_pdf_) || light < 0) return 1.0f;
    const auto probability = static_cast<float>(c_.scene.light_probability[light]);
    const float light_pdf = probability * incident_pdf(c_.scene.lights[light], from, seen);
    return scatter_pdf_ / (scatter_pdf_ + light_pdf);
  }

  const PathContext& c_;
  Rng& rng_;
  EyeCounters& counters_;
  const bool media_emit_;
  PathWeight weight_;
  float scatter_pdf_ = kInfinity;  // of the present direction, 1/sr; infinite for the camera's and specular ones
  Rgb radiance_{0.0f};
};

}  // namespace

PathContext make_path_context(const Scene& scene, const RenderSettings& settings, int pass) {
  const FlightUse use{.pass = static_cast<uint64_t>(pass), .density = false};
  return {scene, settings.max_events, make_distance_strategy(settings.distance, use),
          make_transmittance_estimator(settings.transmittance)};
}

Rgb path_radiance(const PathContext& context, const Ray& ray, MediumId medium, Rng& rng, EyeCounters& counters) {
  TracedPath path(context, rng, counters);
  follow({context.scene, *context.distance, counters.walk, context.max_events}, {ray, medium, Rgb(1.0f)}, rng, path);
  return path.radiance();
}

Pass render_path_pass(const Scene& scene, const RenderSettings& settings, int pass, const PassProgress& progress) {
  const PathContext context = make_path_context(scene, settings, pass);
  const auto radiance = [&](const Ray& ray, EyeWork& work) -> KernelEstimate {
    return {path_radiance(context, ray, medium_of_ray(scene, scene.camera_medium, ray), work.rng, work.counters)};
  };
  return render_image(scene, settings, pass, ray_by_ray(radiance), progress);
}

}  // namespace vpm
