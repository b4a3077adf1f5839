// Eye sub-paths run into lights, sample them, and are connected to vertices of light sub-paths; and these are connected
// to the camera.
#include <algorithm>
#include <cmath>
#include <optional>

#include "vpm/base/counters.h"
#include "vpm/integrators/combined/eye_sub_path.h"
#include "vpm/integrators/combined/light_sub_paths.h"
#include "vpm/path/direct_light.h"
#include "vpm/path/emission_along.h"

namespace vpm {

void EyeSubPath::see_environment(const Rgb& passed) {
  const Vec3 direction = at_.state.ray.direction;
  for (size_t i = 0; i < c_.scene.lights.size(); ++i) {
    const Rgb seen = environment_radiance(c_.scene.lights[i], direction);
    if (!is_black(seen)) run_into(static_cast<int>(i), {passed, 1.0}, at_.from.point, Vec3(0.0f), seen);
  }
}

void EyeSubPath::see_emitter(const PathVertex& at) {
  const int light = c_.scene.shapes[at.hit.shape].light;
  if (light < 0) return;
  const Rgb emitted = surface_radiance(c_.scene.lights[light], at.hit.normal, at.travel);
  if (!is_black(emitted)) run_into(light, at.leg, at.hit.position, at.hit.normal, emitted);
}

void EyeSubPath::see_media() {
  if (!c_.scene.has_emitting_media()) return;
  std::vector<Rgb>& seen = work_.scratch.emitted;
  seen.assign(c_.scene.media.size(), Rgb(0.0f));
  const Ray& ray = at_.state.ray;
  each_emission(c_.scene, ray, at_.state.medium, work_.counters.walk,
                [&](MediumId medium, const Rgb& radiance) { seen[medium] += radiance; });
  for (size_t medium = 0; medium < seen.size(); ++medium) {
    if (is_black(seen[medium])) continue;
    const int number = c_.scene.medium_light[medium];
    const Departure start = depart_from_medium(c_.counts, c_.scene.lights[number], c_.scene.light_probability[number],
                                               seen[medium], {ray.origin, -ray.direction});
    run_into(start, leg_to(start, ray.origin, Rgb(1.0f)), {.starts = true}, ray.origin, seen[medium]);
  }
}

void EyeSubPath::run_into(int number, const Leg& leg, const Vec3& point, const Vec3& normal, const Rgb& emitted) {
  const Light& light = c_.scene.lights[number];
  const EmissionDensity emission = emission_density(light, c_.scene.bounds, normal, -at_.state.ray.direction);
  const Departure start = depart_from_light(c_.counts, light, c_.scene.light_probability[number], emission,
                                            {point, -at_.state.ray.direction}, normal);
  const Junction at_light{
      .kind = is_infinite(light) ? Junction::Kind::free : Junction::Kind::surface, .normal = normal, .starts = true};
  run_into(start, leg, at_light, point, emitted);
}

void EyeSubPath::run_into(const Departure& start, const Leg& leg, const Junction& at_light, const Vec3& point,
                          const Rgb& emitted) {
  const Rgb seen = at_.state.throughput * emitted;
  if (at_.only_specular) return add(Technique::connections, seen, 1.0);  // no other technique can find it
  if (!c_.counts.light) return;
  const Behind at_eye = techniques_behind(c_.counts, start, leg, at_.from.from, at_.from.point);
  const Behind further = techniques_behind(c_.counts, at_.from, leg, at_light, point);
  add(Technique::connections, seen, share_of_running_into(c_.counts, start, at_eye, at_.from, further));
}

void EyeSubPath::sample_light(const PathVertex& at) {
  if (!c_.counts.light) return;
  if (!at.on_surface) return sample_light(at, {at.point, at.medium});
  sample_light(at, near_side(at.hit, at.travel, at.medium));
  if (scatters_through(at.material)) sample_light(at, far_side(c_.scene, at.hit, at.travel, at.medium));
}

void EyeSubPath::sample_light(const PathVertex& at, const Receiver& side) {
  if (!c_.counts.each_light) {
    const PickedLight picked = pick_light(c_.scene, work_.rng.uniform_double());
    return sample_light(at, side, picked.number, 1.0f / picked.probability);
  }
  for (size_t i = 0; i < c_.scene.lights.size(); ++i)
    if (c_.scene.light_probability[i] > 0.0) sample_light(at, side, static_cast<int>(i), 1.0f);
}

void EyeSubPath::sample_light(const PathVertex& at, const Receiver& side, int number, float weight) {
  const Light& light = c_.scene.lights[number];
  if (std::holds_alternative<VolumeLight>(light)) return sample_medium(at, side, number, weight);
  count(work_.counters.shadow_rays);
  const std::optional<Incident> incident = sample_towards(light, side.point, work_.rng);
  if (!incident || (at.on_surface && glm::dot(side.normal, incident->direction) <= 0.0f)) return;
  const Scattered scattered = scattered_into(c_.scene, at, incident->direction, SubPath::eye);
  if (is_black(scattered.value)) return;
  const ShadowRays rays{c_.scene, c_.transmittance, work_.rng, work_.counters.walk};
  const Rgb passed = visibility(rays, {side.point, incident->direction}, incident->distance, number, side.medium);
  if (is_black(passed)) return;
  const Vec3 point = is_infinite(light) ? side.point : side.point + incident->distance * incident->direction;
  const EmissionDensity emission = emission_density(light, c_.scene.bounds, incident->normal, -incident->direction);
  const Departure start = depart_from_light(c_.counts, light, c_.scene.light_probability[number], emission,
                                            {point, -incident->direction}, incident->normal);
  const Leg leg{passed, emission.parallel ? 1.0 : incident->distance};
  const Departure eye = depart_into(at, incident->direction, scattered.densities);
  const Junction at_light{.kind = start.from.kind, .normal = incident->normal, .starts = true};
  const Behind at_eye = techniques_behind(c_.counts, start, leg, at, at.point);
  const Behind further = techniques_behind(c_.counts, eye, leg, at_light, point);
  const Rgb found = at_.state.throughput * scattered.value * incident->irradiance * passed * weight;
  add(Technique::connections, found, share_of_connection(c_.counts, start, at_eye, eye, further));
}

void EyeSubPath::sample_medium(const PathVertex& at, const Receiver& side, int number, float weight) {
  count(work_.counters.shadow_rays);
  const ShadowRays rays{c_.scene, c_.transmittance, work_.rng, work_.counters.walk};
  const DirectSample sample = sample_direct(rays, number, side);
  if (is_black(sample.irradiance)) return;
  const Scattered scattered = scattered_into(c_.scene, at, sample.direction, SubPath::eye);
  if (is_black(scattered.value)) return;
  const Departure start = depart_from_medium(c_.counts, c_.scene.lights[number], c_.scene.light_probability[number],
                                             sample.irradiance * sample.pdf, {at.point, -sample.direction});
  const Leg leg = leg_to(start, at.point, Rgb(1.0f));
  const Departure eye = depart_into(at, sample.direction, scattered.densities);
  const Behind at_eye = techniques_behind(c_.counts, start, leg, at, at.point);
  const Behind further = techniques_behind(c_.counts, eye, leg, {.starts = true}, at.point);
  const Rgb found = at_.state.throughput * scattered.value * sample.irradiance * weight;
  add(Technique::connections, found, share_of_connection(c_.counts, start, at_eye, eye, further));
}

void EyeSubPath::connect(const PathVertex& at) {
  const std::vector<PathVertex>& all = c_.light.vertices();
  if (c_.counts.connections == 0.0 || all.empty()) return;
  const double of_path = static_cast<double>(all.size()) / static_cast<double>(c_.light.connectable_paths());
  const double number = c_.counts.connections * of_path;
  const auto whole = static_cast<size_t>(number + work_.rng.uniform_double());
  for (size_t i = 0; i < whole; ++i) {
    const auto pick = static_cast<size_t>(work_.rng.uniform_double() * static_cast<double>(all.size()));
    connect_to(at, all[pick]);
  }
}

void EyeSubPath::connect_to(const PathVertex& at, const PathVertex& light) {
  const Vec3d offset = Vec3d(light.point) - Vec3d(at.point);
  const double distance = glm::length(offset);
  if (!(distance > 0.0)) return;
  const Vec3 direction(offset / distance);
  const Scattered here = scattered_into(c_.scene, at, direction, SubPath::eye);
  if (is_black(here.value)) return;
  const Scattered there = scattered_into(c_.scene, light, -direction, SubPath::light);
  if (is_black(there.value)) return;
  count(work_.counters.shadow_rays);
  const PathState from = leave(c_.scene, at, direction), to = leave(c_.scene, light, -direction);
  const Vec3 way = to.ray.origin - from.ray.origin;
  const float length = glm::length(way);
  const ShadowRays rays{c_.scene, c_.transmittance, work_.rng, work_.counters.walk};
  const int shape = light.on_surface ? static_cast<int>(light.hit.shape) : -1;
  const Rgb passed = visibility_of_place(rays, {from.ray.origin, way / length}, length, from.medium, shape);
  if (is_black(passed)) return;
  const Leg leg{passed, distance};
  const Departure eye = depart_into(at, direction, here.densities);
  const Departure departure = depart(c_.counts, light, -direction, there.densities, SubPath::light, false);
  const Behind at_eye = techniques_behind(c_.counts, departure, leg, at, at.point);
  const Behind at_light = techniques_behind(c_.counts, eye, leg, light, light.point);
  const Rgb found = at_.state.throughput * here.value * there.value * light.power * passed *
                    static_cast<float>(leg.per_square() / c_.counts.connections);
  add(Technique::connections, found, share_of_connection(c_.counts, departure, at_eye, eye, at_light));
}

namespace {

bool is_on_film(const Camera& camera, const Vec2& film) {
  const float r = camera.filter.radius;
  const auto w = static_cast<float>(camera.width), h = static_cast<float>(camera.height);
  return film.x > 0.5f - r && film.y > 0.5f - r && film.x < w - 0.5f + r && film.y < h - 0.5f + r;
}

/// Calls visit(number, filter_value()) for the pixels whose filters reach a place of the film.
template <class Visit>
void for_each_pixel(const Camera& camera, const Vec2& film, Visit&& visit) {
  const float r = camera.filter.radius;
  const auto first = [&](float at) { return std::max(0, static_cast<int>(std::ceil(at - 0.5f - r))); };
  const auto last = [&](float at, int size) {
    return std::min(size - 1, static_cast<int>(std::ceil(at - 0.5f + r)) - 1);
  };
  for (int y = first(film.y); y <= last(film.y, camera.height); ++y)
    for (int x = first(film.x); x <= last(film.x, camera.width); ++x)
      visit(static_cast<uint32_t>(y * camera.width + x),
            filter_value(camera.filter, film - Vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f)));
}

}  // namespace

void splat(const LightTracing& tracing, const PathVertex& at, Rng& rng, LightSubPaths& paths) {
  if (at.on_surface && at.straight) return;
  const Scene& scene = tracing.scene;
  const Camera& camera = scene.camera;
  const Vec3 offset = camera.position - at.point;
  const float distance = glm::length(offset);
  const Vec3 direction = offset / distance;
  const std::optional<Vec2> film = camera.film_of(-direction);
  if (!film || !is_on_film(camera, *film)) return;
  const Scattered scattered = scattered_into(scene, at, direction, SubPath::light);
  if (is_black(scattered.value)) return;
  const PathState leaving = leave(scene, at, direction);
  const ShadowRays rays{scene, tracing.transmittance, rng, paths.ledger.walk};
  const float length = glm::distance(camera.position, leaving.ray.origin);
  const Rgb passed = visibility_of_place(rays, leaving.ray, length, leaving.medium);
  if (is_black(passed)) return;
  const Leg leg{passed, distance};
  const Departure departure = depart(tracing.counts, at, direction, scattered.densities, SubPath::light, true);
  const Behind at_camera = techniques_behind(tracing.counts, departure, leg, {}, camera.position);
  const double film_density = camera.film_per_angle(-direction);
  const Rgb irradiance = at.power * scattered.value * passed * static_cast<float>(leg.per_square());
  for_each_pixel(camera, *film, [&](uint32_t pixel, double filter) {
    const double density = filter * film_density;
    const Splat splat{pixel, irradiance * static_cast<float>(density),
                      static_cast<float>(share_of_splat(tracing.counts, at_camera, density))};
    if (is_finite(splat.radiance * splat.share))
      paths.splats.push_back(splat);
    else
      ++paths.ledger.non_finite;
  });
}

}  // namespace vpm
