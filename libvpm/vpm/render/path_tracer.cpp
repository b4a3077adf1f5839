// Paths from the eye, event by event.
#include "vpm/render/path_tracer.h"

#include <cmath>

#include "vpm/base/count.h"
#include "vpm/path/direct_light.h"
#include "vpm/path/path_weight.h"
#include "vpm/surface/shading.h"

namespace vpm {
namespace {

class TracedPath {
 public:
  TracedPath(const PathContext& context, const Ray& ray, MediumId medium, Rng& rng, EyeCounters& counters)
      : c_(context), rng_(rng), counters_(counters), state_{ray, medium, Rgb(1.0f)} {}

  Rgb follow() {
    const Rgb radiance = follow_events();
    weight_.add_to(counters_.weights);
    return radiance;
  }

 private:
  Rgb follow_events() {
    for (int events = 0; events < c_.max_events; ++events) {
      const Vec3 from = state_.ray.origin;
      const Event event = next_event(c_.scene, *c_.distance, state_, rng_, counters_.walk);
      if (!is_finite(state_.power)) return state_.power;  // no roulette: that would end it as if it were black
      weight_.meet(weight(), event);
      if (event.kind == EventKind::escape) {
        see_environment(from);
        return radiance_;
      }
      const bool goes_on = event.kind == EventKind::collision ? collide() : meet_surface(event.hit, from);
      if (!goes_on) return radiance_;
    }
    ++counters_.cut_paths;
    return radiance_;
  }

  /// The mean magnitude of the channels' throughput, with the sign of their sum.
  double weight() const {
    return std::copysign(sum_channels(glm::abs(state_.power)) / 3.0, sum_channels(state_.power));
  }

  bool collide() {
    if (!survive_roulette(max_channel(glm::abs(state_.power)), state_, rng_)) return false;
    const Medium& medium = c_.scene.media[state_.medium];
    const Vec3 travel = state_.ray.direction;
    const DirectSample light = sample_light({state_.ray.origin, state_.medium});
    if (!is_black(light.irradiance)) {
      const float phase = phase_value(medium.phase, travel, light.direction);
      radiance_ += state_.power * medium.albedo() * phase * light.irradiance * share(light.pdf, phase);
    }
    if (!scatter_in_medium(medium, state_, rng_)) return false;
    scatter_pdf_ = phase_value(medium.phase, travel, state_.ray.direction);
    return true;
  }

  bool meet_surface(const Hit& hit, const Vec3& from) {
    const Vec3 travel = state_.ray.direction;
    const int light = c_.scene.shapes[hit.shape].light;
    if (light >= 0) {
      const Rgb emitted = surface_radiance(c_.scene.lights[light], hit.normal, travel);
      radiance_ +=
          state_.power * emitted * share_of_path(light, from, {travel, glm::distance(from, hit.position), hit.normal});
    }
    if (!survive_roulette(max_channel(glm::abs(state_.power)), state_, rng_)) return false;
    const Material material = material_at(c_.scene, hit);
    if (is_rough(material)) {
      add_direct_light(hit, material, near_side(hit, state_.ray.direction, state_.medium));
      if (scatters_through(material))
        add_direct_light(hit, material, far_side(c_.scene, hit, state_.ray.direction, state_.medium));
    }
    Scatter scatter;
    if (!scatter_at_surface(c_.scene, hit, state_, rng_, scatter)) return false;
    state_.power *= scatter.radiance_scale;
    scatter_pdf_ = scatter.pdf;
    return true;
  }

  /// Adds what a rough surface scatters towards the eye of one light that arrives on that side.
  void add_direct_light(const Hit& hit, const Material& material, const Receiver& side) {
    const DirectSample light = sample_light(side);
    if (is_black(light.irradiance)) return;
    const ScatterValue scattered = scatter_value(material, hit, state_.ray.direction, light.direction);
    radiance_ +=
        state_.power * scattered.value * scattered.radiance_scale * light.irradiance * share(light.pdf, scattered.pdf);
  }

  /// Adds the environment seen by a ray that left `from`.
  void see_environment(const Vec3& from) {
    for (size_t i = 0; i < c_.scene.lights.size(); ++i) {
      const Rgb seen = environment_radiance(c_.scene.lights[i], state_.ray.direction);
      if (!is_black(seen))
        radiance_ +=
            state_.power * seen * share_of_path(static_cast<int>(i), from, {.direction = state_.ray.direction});
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
  static float share(float light_pdf, float scattering_pdf) {
    return light_pdf > 0.0f ? light_pdf / (light_pdf + scattering_pdf) : 1.0f;
  }

  /// The part that the path has in the light it ran into: all where no shadow ray could have found it.
  float share_of_path(int light, const Vec3& from, const SeenLight& seen) const {
    if (std::isinf(scatter_pdf_)) return 1.0f;
    const auto probability = static_cast<float>(c_.scene.light_probability[light]);
    const float light_pdf = probability * incident_pdf(c_.scene.lights[light], from, seen);
    return scatter_pdf_ / (scatter_pdf_ + light_pdf);
  }

  const PathContext& c_;
  Rng& rng_;
  EyeCounters& counters_;
  PathState state_;
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
  return TracedPath(context, ray, medium, rng, counters).follow();
}

Pass render_path_pass(const Scene& scene, const RenderSettings& settings, int pass, const std::atomic<bool>& stop,
                      const PassProgress& progress) {
  const PathContext context = make_path_context(scene, settings, pass);
  const RayRadiance radiance = [&](const Ray& ray, EyeWork& work) {
    return path_radiance(context, ray, medium_of_ray(scene, scene.camera_medium, ray), work.rng, work.counters);
  };
  return render_image(scene, settings, pass, radiance, stop, progress);
}

}  // namespace vpm
