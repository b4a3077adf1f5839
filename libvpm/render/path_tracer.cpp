// Paths from the eye, event by event.
#include "render/path_tracer.h"

#include "path/direct_light.h"
#include "surface/shading.h"

namespace vpm {
namespace {

class TracedPath {
 public:
  TracedPath(const PathContext& context, const Ray& ray, MediumId medium, Rng& rng, EyeCounters& counters)
      : c_(context), rng_(rng), counters_(counters), state_{ray, medium, Rgb(1.0f)} {}

  Rgb follow() {
    for (int events = 0; events < c_.max_events; ++events) {
      const Vec3 from = state_.ray.origin;
      const Event event = next_event(c_.scene, *c_.distance, state_, rng_, counters_.walk);
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

 private:
  bool collide() {
    if (!survive_roulette(max_channel(state_.power), state_, rng_)) return false;
    const Medium& medium = c_.scene.media[state_.medium];
    const Vec3 travel = state_.ray.direction;
    const DirectSample light = sample_light(state_.ray.origin, Vec3(0.0f));
    if (!is_black(light.irradiance)) {
      const float phase = phase_value(medium.phase, travel, light.direction);
      radiance_ += state_.power * medium.albedo() * phase * light.irradiance * share(light.pdf, phase);
    }
    if (!scatter_in_medium(medium, state_, rng_)) return false;
    scatter_pdf_ = phase_value(medium.phase, travel, state_.ray.direction);
    return true;
  }

  bool meet_surface(const Hit& hit, const Vec3& from) {
    const int light = c_.scene.shapes[hit.shape].light;
    if (light >= 0) {
      const Rgb emitted = surface_radiance(c_.scene.lights[light], hit.normal, state_.ray.direction);
      radiance_ += state_.power * emitted * share_of_path(light, from, glm::distance(from, hit.position));
    }
    if (!survive_roulette(max_channel(state_.power), state_, rng_)) return false;
    const Material material = material_at(c_.scene, hit);
    const Vec3 travel = state_.ray.direction;
    if (is_diffuse(material)) {
      const Vec3 normal = glm::dot(hit.normal, travel) < 0.0f ? hit.normal : -hit.normal;
      const DirectSample sample = sample_light(leave_surface(hit, normal), normal);
      if (!is_black(sample.irradiance)) {
        const ScatterValue scattered = scatter_value(material, hit, travel, sample.direction);
        radiance_ += state_.power * scattered.value * sample.irradiance * share(sample.pdf, scattered.pdf);
      }
    }
    Scatter scatter;
    if (!scatter_at_surface(c_.scene, hit, state_, rng_, scatter)) return false;
    state_.power *= scatter.radiance_scale;
    scatter_pdf_ = is_diffuse(material) ? scatter_value(material, hit, travel, scatter.direction).pdf : kInfinity;
    return true;
  }

  /// Adds the environment seen by a ray that left `from`.
  void see_environment(const Vec3& from) {
    for (size_t i = 0; i < c_.scene.lights.size(); ++i) {
      const Rgb seen = environment_radiance(c_.scene.lights[i], state_.ray.direction);
      if (!is_black(seen)) radiance_ += state_.power * seen * share_of_path(static_cast<int>(i), from, kInfinity);
    }
  }

  /// One light, picked by power: its irradiance over that probability, its pdf times it.
  DirectSample sample_light(const Vec3& point, const Vec3& facing) {
    const int picked = pick_light(c_.scene, rng_.uniform());
    if (picked < 0) return {};
    ++counters_.shadow_rays;
    DirectSample sample =
        sample_direct(c_.scene, picked, *c_.transmittance, point, facing, state_.medium, rng_, counters_.walk);
    sample.irradiance /= c_.scene.light_probability[picked];
    sample.pdf *= c_.scene.light_probability[picked];
    return sample;
  }

  /// The part that a shadow ray has in what it finds; all of it where scattering cannot find the light.
  static float share(float light_pdf, float scattering_pdf) {
    return light_pdf > 0.0f ? light_pdf / (light_pdf + scattering_pdf) : 1.0f;
  }

  /// The part that the path has in the light it ran into: all where no shadow ray could have found it.
  float share_of_path(int light, const Vec3& from, float distance) const {
    if (std::isinf(scatter_pdf_)) return 1.0f;
    const float light_pdf =
        c_.scene.light_probability[light] * incident_pdf(c_.scene.lights[light], from, state_.ray.direction, distance);
    return scatter_pdf_ / (scatter_pdf_ + light_pdf);
  }

  const PathContext& c_;
  Rng& rng_;
  EyeCounters& counters_;
  PathState state_;
  float scatter_pdf_ = kInfinity;  // of the present direction, 1/sr; infinite for the camera's and specular ones
  Rgb radiance_{0.0f};
};

}  // namespace

PathContext make_path_context(const Scene& scene, const RenderSettings& settings) {
  return {scene, settings.max_events, make_distance_strategy(settings.distance),
          make_transmittance_estimator(settings.transmittance)};
}

Rgb path_radiance(const PathContext& context, const Ray& ray, MediumId medium, Rng& rng, EyeCounters& counters) {
  return TracedPath(context, ray, medium, rng, counters).follow();
}

Pass render_path_pass(const Scene& scene, const RenderSettings& settings, int pass, const std::atomic<bool>& stop,
                      const PassProgress& progress) {
  const PathContext context = make_path_context(scene, settings);
  const RayRadiance radiance = [&](const Ray& ray, Rng& rng, EyeCounters& counters) {
    return path_radiance(context, ray, medium_of_ray(scene, scene.camera_medium, ray), rng, counters);
  };
  return render_image(scene, settings, pass, radiance, stop, progress);
}

}  // namespace vpm
