// One sub-path from the eye, event by event, and what it meets of those from the lights.
#include <cmath>
#include <optional>

#include "vpm/base/count.h"
#include "vpm/estimate/combined/combined.h"
#include "vpm/estimate/eye_segment.h"
#include "vpm/estimate/kernel_sum.h"
#include "vpm/estimate/surface_estimate.h"
#include "vpm/medium/distance/mixture.h"
#include "vpm/path/direct_light.h"
#include "vpm/path/stretches.h"

namespace vpm {
namespace {

Rgb times(const Rgb& value, double factor) { return value * static_cast<float>(factor); }

float sine_of(const Vec3& a, const Vec3& b) { return glm::length(glm::cross(a, b)); }

/// A normalised kernel and its correction, of a squared distance, m^2.
template <int Dimension>
auto kernel_of(KernelKind kind, float radius) {
  const float norm = kernel_norm<Dimension>(kind, radius), inverse = 1.0f / (radius * radius);
  return [kind, norm, inverse](float distance2) {
    return with_kernel<Dimension>(kind, [&](auto profile) { return profile(distance2 * inverse); }) * norm;
  };
}

/// A sub-path as it leaves the camera or a vertex.
struct EyeBranch {
  PathState state;
  Departure from;
  bool only_specular = true;  // are there no other vertices yet?
  int events = 0;             // so far
};

class EyeSubPath {
 public:
  EyeSubPath(const CombinedContext& context, const Ray& ray, EyeWork& work) : c_(context), work_(work) {
    at_.state = {ray, medium_of_ray(context.scene, context.scene.camera_medium, ray), Rgb(1.0f)};
    at_.from = depart_from_camera(context.counts, ray, density_of(ray));
  }

  KernelEstimate follow() {
    follow_branch();
    return radiance_;
  }

 private:
  void follow_branch() {
    for (; at_.events < c_.max_events; ++at_.events) {
      const std::optional<PathVertex> vertex = at_.only_specular ? pass_through() : fly();
      if (!vertex || !visit(*vertex)) return;
    }
    ++work_.counters.cut_paths;
  }

  /// Finds light at a vertex. Returns whether the sub-path goes on from there.
  bool visit(const PathVertex& vertex) {
    if (!is_finite(at_.state.throughput)) {  // the sample is counted, and dropped
      radiance_ += KernelEstimate(at_.state.throughput);
      return false;
    }
    if (is_black(at_.state.throughput)) return false;
    if (!vertex.specular) meet_light(vertex);
    if (!go_on(vertex)) return false;
    at_.only_specular &= vertex.specular;
    return true;
  }

  /// The density with which the pixel draws the direction, 1/sr.
  double density_of(const Ray& ray) const {
    const Camera& camera = c_.scene.camera;
    const std::optional<Vec2> film = camera.film_of(ray.direction);
    if (!film) return 0.0;
    const auto width = static_cast<size_t>(camera.width);
    const Vec2 pixel(static_cast<float>(work_.pixel % width) + 0.5f, static_cast<float>(work_.pixel / width) + 0.5f);
    // Rounding may put the place of the film a hair outside of the filter.
    const float r = camera.filter.radius;
    const Vec2 offset = glm::clamp(*film - pixel, Vec2(-r), Vec2(r));
    return filter_value(camera.filter, offset) * camera.film_per_angle(ray.direction);
  }

  // --- Merges along rays

  /// The visitor of a ray on its way to the surface that ends it.
  struct Along {
    EyeSubPath& path;
    Ray ray;
    MediumId medium;
    Rgb passed{1.0f};  // from the last vertex to the start of the stretch
    bool through_scattering = false;

    bool pass(const Stretch& stretch) {
      if (medium == kVacuum) return true;
      const Medium& around = path.c_.scene.media[medium];
      const Interval interval{0.0f, stretch.length};
      DensityIntegralsAlong& integrals = path.work_.scratch.integrals;
      count(path.work_.counters.walk.lookups, integrals.walk(&around, ray, interval));
      if (around.scatters()) {
        through_scattering = true;
        path.merge_points_2d(*this, interval);
        path.merge_beams(*this, interval);
      }
      passed *= transmittance(around, integrals.integral());
      return !is_black(passed);
    }
    /// The transmittance from the last vertex to a place on the ray, m.
    Rgb to(double t) const {
      return passed * transmittance(path.c_.scene.media[medium], path.work_.scratch.integrals.at(t).integral);
    }
  };

  /// Takes a ray that comes from the camera to the surface that ends it, attenuated, as if it could not collide; and
  /// from where it does collide a branch of its own. So no chance decides whether the surface is seen.
  std::optional<PathVertex> pass_through() {
    Along along{*this, at_.state.ray, at_.state.medium};
    const std::optional<Hit> hit =
        each_stretch(c_.scene, along.ray, along.medium, kInfinity, work_.counters.walk, along);
    if (along.through_scattering) branch_off();
    at_.state.throughput *= along.passed;
    if (is_black(at_.state.throughput)) return std::nullopt;
    if (!survive_roulette(max_channel(glm::abs(at_.state.throughput)), at_.state, work_.rng)) return std::nullopt;
    at_.state.ray = along.ray;
    at_.state.medium = along.medium;
    if (!hit) {
      see_environment(along.passed);
      return std::nullopt;
    }
    at_.state.ray.origin = hit->position;
    return arrive_at({.kind = EventKind::surface, .hit = *hit}, along.passed);
  }

  /// Follows a branch from where the ray collides, if it does, to its end.
  void branch_off() {
    const EyeBranch start = at_;
    Rgb passed(1.0f);
    const Event event = fly_to_event(passed);
    if (event.kind == EventKind::collision && visit(arrive_at(event, passed))) {
      ++at_.events;
      follow_branch();
    }
    at_ = start;
  }

  void merge_points_2d(const Along& along, const Interval& interval) {
    const VertexMap& map = c_.light.beside_rays(along.medium);
    if (map.size() == 0) return;
    const Medium& medium = c_.scene.media[along.medium];
    const auto kernel = kernel_of<2>(c_.kernels.volume_kernel, map.radius());
    count(work_.counters.volume_queries);
    count(work_.counters.gather.searches);
    const uint32_t visited = map.visit_near_ray(along.ray, interval, [&](uint32_t number, float distance2) {
      const LightVertex& light = c_.light.of_medium(along.medium, number);
      const double t = glm::dot(light.vertex.point - along.ray.origin, along.ray.direction);
      const Leg leg = leg_to(at_.from, light.vertex.point, along.to(t));
      if (is_black(leg.transmittance)) return;
      const double phase = phase_density(medium, light.vertex.travel, -along.ray.direction);
      const MergeTerms merges = merges_in_medium(c_.counts, light.junction.sigma_t, light.arrived, leg,
                                                 sine_of(light.vertex.travel, along.ray.direction), true);
      const SubPathSums eye = arrive(c_.counts, at_.from, leg, light.junction, light.vertex.point);
      const double share = merges.points_2d / all_at_merge(c_.counts, merges, light.sums, phase, eye, phase);
      const Rgb value = at_.state.throughput * leg.transmittance * medium.albedo() * light.power;
      add_merged(times(value, phase * share / c_.light_paths), kernel(distance2));
    });
    count(work_.counters.gather.visited, visited);
  }

  void merge_beams(const Along& along, const Interval& interval) {
    const PhotonBeamMap& map = c_.light.beams(along.medium);
    if (map.size() == 0) return;
    const auto kernel = kernel_of<1>(c_.kernels.volume_kernel, c_.kernels.beams);
    count(work_.counters.volume_queries);
    count(work_.counters.gather.searches);
    const Interval near = clip(along.ray, interval, map.bounds(), c_.kernels.beams);
    if (near.empty()) return;
    const uint32_t visited = map.visit_crossings(along.ray, near, [&](const BeamCrossings& found) {
      for (size_t i = 0; i < found.size; ++i) merge_beam(along, found, i, kernel);
    });
    count(work_.counters.gather.visited, visited);
  }

  template <class Kernel>
  void merge_beam(const Along& along, const BeamCrossings& found, size_t i, const Kernel& kernel) {
    const Medium& medium = c_.scene.media[along.medium];
    const Vec3 direction(found.dx[i], found.dy[i], found.dz[i]);
    const Vec3 place = along.ray.origin + Vec3(found.x[i], found.y[i], found.z[i]);
    const float density = medium.density(place);
    if (density == 0.0f) return;
    const Ray flight{place - found.s[i] * direction, direction};
    const DensityIntegral integral = density_integral(medium, flight, {0.0f, std::max(0.0f, found.s[i])});
    count(work_.counters.walk.lookups, integral.lookups + 1);
    const LightBeam& beam = c_.light.starts(along.medium)[found.beam[i]];
    const Rgb power(found.r[i], found.g[i], found.b[i]);
    const Rgb left = analog_weight(medium, channel_shares(power), integral.value, false);
    const Leg to_light = leg_to(beam.start, place, beam.before * transmittance(medium, integral.value));
    const Leg to_eye = leg_to(at_.from, place, along.to(found.t[i]));
    if (is_black(to_light.transmittance) || is_black(to_eye.transmittance)) return;
    const Junction there{Junction::Kind::medium, Vec3(0.0f), medium.sigma_t * density};
    const double phase = phase_density(medium, direction, -along.ray.direction);
    const MergeTerms merges = merges_in_medium(c_.counts, there.sigma_t, to_light, to_eye, found.sine[i], true);
    const SubPathSums light = arrive(c_.counts, beam.start, to_light, there, place);
    const SubPathSums eye = arrive(c_.counts, at_.from, to_eye, there, place);
    const double share = merges.beams / all_at_merge(c_.counts, merges, light, phase, eye, phase);
    const Rgb value = at_.state.throughput * to_eye.transmittance * medium.sigma_s * density * power * left;
    add_merged(times(value, phase * share / found.sine[i]), kernel(found.distance2[i]));
  }

  // --- Vertices

  /// Flies to the next vertex, and sees the lights that the flight runs into.
  std::optional<PathVertex> fly() {
    Rgb passed(1.0f);
    const Event event = fly_to_event(passed);
    if (event.kind == EventKind::escape) see_environment(passed);
    if (event.kind != EventKind::collision && event.kind != EventKind::surface) return std::nullopt;
    return arrive_at(event, passed);
  }

  /// Flies to the next event; `passed` becomes the transmittance up to it.
  Event fly_to_event(Rgb& passed) {
    tracks_.clear();
    const Event event =
        next_event(c_.scene, c_.strategy, at_.state, work_.rng, work_.counters.walk, kInfinity, &tracks_);
    for (const Track& track : tracks_) {
      const Medium& medium = c_.scene.media[track.medium];
      const DensityIntegral integral = density_integral(medium, track.ray, {0.0f, track.length});
      count(work_.counters.walk.lookups, integral.lookups);
      passed *= transmittance(medium, integral.value);
    }
    return event;
  }

  /// Makes the event a vertex.
  PathVertex arrive_at(const Event& event, const Rgb& passed) {
    const PathVertex vertex = vertex_at(c_.scene, event, at_.state);
    leg_ = leg_to(at_.from, vertex.point, passed);
    if (vertex.on_surface) see_emitter(vertex);
    junction_ = junction_of(c_.scene, vertex);
    sums_ = arrive(c_.counts, at_.from, leg_, junction_, vertex.point);
    return vertex;
  }

  void see_environment(const Rgb& passed) {
    const Vec3 direction = at_.state.ray.direction;
    for (size_t i = 0; i < c_.scene.lights.size(); ++i) {
      const Rgb seen = environment_radiance(c_.scene.lights[i], direction);
      if (!is_black(seen)) run_into(static_cast<int>(i), {passed, 1.0}, at_.from.point, Vec3(0.0f), seen);
    }
  }

  void see_emitter(const PathVertex& vertex) {
    const int light = c_.scene.shapes[vertex.hit.shape].light;
    if (light < 0) return;
    const Rgb emitted = surface_radiance(c_.scene.lights[light], vertex.hit.normal, vertex.travel);
    if (!is_black(emitted)) run_into(light, leg_, vertex.hit.position, vertex.hit.normal, emitted);
  }

  /// Adds the light that the sub-path has run into, at a point with that normal.
  void run_into(int number, const Leg& leg, const Vec3& point, const Vec3& normal, const Rgb& emitted) {
    const Rgb seen = at_.state.throughput * emitted;
    if (at_.only_specular) {  // no other technique can find it
      radiance_ += KernelEstimate(seen);
      return;
    }
    if (!c_.counts.light) return;
    const Light& light = c_.scene.lights[number];
    const EmissionDensity emission = emission_density(light, c_.scene.bounds, normal, -at_.state.ray.direction);
    const Departure start = depart_from_light(c_.counts, light, c_.scene.light_probability[number], emission,
                                              {point, -at_.state.ray.direction}, normal);
    const Junction at_light{is_infinite(light) ? Junction::Kind::free : Junction::Kind::surface, normal, Rgb(0.0f),
                            true};
    const SubPathSums at_eye = arrive(c_.counts, start, leg, at_.from.from, at_.from.point);
    const SubPathSums further = arrive(c_.counts, at_.from, leg, at_light, point);
    radiance_ +=
        KernelEstimate(times(seen, shares_of_connection(c_.counts, start, at_eye, at_.from, further).run_into));
  }

  /// What light is found at a vertex.
  void meet_light(const PathVertex& vertex) {
    if (c_.counts.light) sample_light(vertex);
    if (c_.counts.connections > 0.0) connect(vertex);
    if (vertex.on_surface)
      merge_surface(vertex);
    else
      merge_points_3d(vertex);
  }

  /// Samples a light; on surfaces that light passes, one for either side.
  void sample_light(const PathVertex& vertex) {
    if (!vertex.on_surface) return sample_light(vertex, {vertex.point, vertex.medium});
    sample_light(vertex, near_side(vertex.hit, vertex.travel, vertex.medium));
    if (scatters_through(vertex.material))
      sample_light(vertex, far_side(c_.scene, vertex.hit, vertex.travel, vertex.medium));
  }

  /// Seen from a place just off a surface: rays that are aimed from there meet what they are aimed at.
  void sample_light(const PathVertex& vertex, const Receiver& side) {
    const PickedLight picked = pick_light(c_.scene, work_.rng.uniform_double());
    const Light& light = c_.scene.lights[picked.number];
    count(work_.counters.shadow_rays);
    const std::optional<Incident> incident = sample_towards(light, side.point, work_.rng);
    if (!incident || (vertex.on_surface && glm::dot(side.normal, incident->direction) <= 0.0f)) return;
    const Scattered scattered = scattered_into(c_.scene, vertex, incident->direction, SubPath::eye);
    if (is_black(scattered.value)) return;
    const ShadowRays rays{c_.scene, c_.transmittance, work_.rng, work_.counters.walk};
    const Rgb passed =
        visibility(rays, {side.point, incident->direction}, incident->distance, picked.number, side.medium);
    if (is_black(passed)) return;
    const Vec3 point = is_infinite(light) ? side.point : side.point + incident->distance * incident->direction;
    const EmissionDensity emission = emission_density(light, c_.scene.bounds, incident->normal, -incident->direction);
    const Departure start = depart_from_light(c_.counts, light, picked.probability, emission,
                                              {point, -incident->direction}, incident->normal);
    const Leg leg{passed, emission.parallel ? 1.0 : incident->distance};
    const Departure eye = depart(c_.counts, junction_, vertex, sums_, leg_, incident->direction, scattered.forward,
                                 scattered.reverse, SubPath::eye, at_.only_specular);
    const Junction at_light{start.from.kind, incident->normal, Rgb(0.0f), true};
    const double share = shares_of_connection(c_.counts, start, arrive(c_.counts, start, leg, junction_, vertex.point),
                                              eye, arrive(c_.counts, eye, leg, at_light, point))
                             .connected;
    const Rgb value = at_.state.throughput * scattered.value * incident->irradiance * passed;
    radiance_ += KernelEstimate(times(value, share / picked.probability));
  }

  /// Connects the vertex to some vertices of light sub-paths, drawn from all.
  void connect(const PathVertex& vertex) {
    const std::vector<LightVertex>& all = c_.light.vertices();
    const double number = c_.counts.connections * static_cast<double>(all.size()) / c_.light_paths;
    const auto whole = static_cast<size_t>(number + work_.rng.uniform_double());
    for (size_t i = 0; i < whole && !all.empty(); ++i) {
      const auto pick = static_cast<size_t>(work_.rng.uniform_double() * static_cast<double>(all.size()));
      connect_to(vertex, all[pick]);
    }
  }

  void connect_to(const PathVertex& vertex, const LightVertex& light) {
    const Vec3d offset = Vec3d(light.vertex.point) - Vec3d(vertex.point);
    const double distance = glm::length(offset);
    if (!(distance > 0.0)) return;
    const Vec3 direction(offset / distance);
    const Scattered here = scattered_into(c_.scene, vertex, direction, SubPath::eye);
    if (is_black(here.value)) return;
    const Scattered there = scattered_into(c_.scene, light.vertex, -direction, SubPath::light);
    if (is_black(there.value)) return;
    count(work_.counters.shadow_rays);
    const Leaving from = leave(c_.scene, vertex, direction), to = leave(c_.scene, light.vertex, -direction);
    const Vec3 way = to.origin - from.origin;
    const float length = glm::length(way);
    const ShadowRays rays{c_.scene, c_.transmittance, work_.rng, work_.counters.walk};
    const Rgb passed = visibility(rays, {from.origin, way / length}, length, from.medium);
    if (is_black(passed)) return;
    const Leg leg{passed, distance};
    const Departure eye = depart(c_.counts, junction_, vertex, sums_, leg_, direction, here.forward, here.reverse,
                                 SubPath::eye, at_.only_specular);
    const Departure departure = depart(c_.counts, light.junction, light.vertex, light.sums, light.arrived, -direction,
                                       there.forward, there.reverse, SubPath::light, false);
    const double share =
        shares_of_connection(c_.counts, departure, arrive(c_.counts, departure, leg, junction_, vertex.point), eye,
                             arrive(c_.counts, eye, leg, light.junction, light.vertex.point))
            .connected;
    const Rgb value = at_.state.throughput * here.value * there.value * light.power * passed;
    radiance_ += KernelEstimate(times(value, share * leg.per_square() / c_.counts.connections));
  }

  void merge_surface(const PathVertex& vertex) {
    const VertexMap& map = c_.light.on_surfaces();
    if (map.size() == 0) return;
    const auto kernel = kernel_of<2>(c_.kernels.surface_kernel, map.radius());
    const Vec3 side = glm::dot(vertex.hit.normal, vertex.travel) < 0.0f ? vertex.hit.normal : -vertex.hit.normal;
    const Arrives arrives{side, kFlatness * map.radius(), scatters_through(vertex.material)};
    count(work_.counters.surface_queries);
    count(work_.counters.gather.searches);
    const uint32_t visited = map.visit_near(vertex.point, [&](uint32_t number, float distance2) {
      const LightVertex& light = c_.light.of_surfaces(number);
      const Vec3& travel = light.vertex.travel;
      if (light.sums.straight) return;
      const bool faces = arrives.from_both_sides || glm::dot(travel, side) < 0.0f;
      if (!faces || !arrives.near_plane(light.vertex.point - vertex.point)) return;
      const Scattered scattered = scattered_into(c_.scene, vertex, -travel, SubPath::eye);
      const float cosine = std::abs(glm::dot(vertex.hit.normal, travel));
      if (is_black(scattered.value) || cosine == 0.0f) return;
      const MergeTerms merges = merges_on_surface(c_.counts, at_.only_specular);
      const double share =
          merges.surface / all_at_merge(c_.counts, merges, light.sums, scattered.forward, sums_, scattered.reverse);
      const Rgb value = at_.state.throughput * scattered.value * light.power;
      add_merged(times(value, share / cosine / c_.light_paths), kernel(distance2));
    });
    count(work_.counters.gather.visited, visited);
  }

  void merge_points_3d(const PathVertex& vertex) {
    const VertexMap& map = c_.light.around_points(vertex.medium);
    if (map.size() == 0) return;
    const Medium& medium = c_.scene.media[vertex.medium];
    const auto kernel = kernel_of<3>(c_.kernels.volume_kernel, map.radius());
    Rgb per_extinction(0.0f);  // the albedo over the extinction coefficient, m
    for (int c = 0; c < 3; ++c)
      if (junction_.sigma_t[c] > 0.0f) per_extinction[c] = medium.albedo()[c] / junction_.sigma_t[c];
    count(work_.counters.volume_queries);
    count(work_.counters.gather.searches);
    const uint32_t visited = map.visit_near(vertex.point, [&](uint32_t number, float distance2) {
      const LightVertex& light = c_.light.of_medium(vertex.medium, number);
      const double phase = phase_density(medium, light.vertex.travel, -vertex.travel);
      const MergeTerms merges = merges_in_medium(c_.counts, light.junction.sigma_t, light.arrived, leg_,
                                                 sine_of(light.vertex.travel, vertex.travel), at_.only_specular);
      const double share = merges.points_3d / all_at_merge(c_.counts, merges, light.sums, phase, sums_, phase);
      const Rgb value = at_.state.throughput * per_extinction * light.power;
      add_merged(times(value, phase * share / c_.light_paths), kernel(distance2));
    });
    count(work_.counters.gather.visited, visited);
  }

  /// Draws how the sub-path goes on.
  bool go_on(const PathVertex& vertex) {
    double forward = 1.0, reverse = 1.0;
    if (!vertex.on_surface) {
      const Medium& medium = c_.scene.media[vertex.medium];
      if (!scatter_in_medium(medium, at_.state, work_.rng)) return false;
      forward = reverse = phase_density(medium, vertex.travel, at_.state.ray.direction);
    } else {
      Scatter scatter;
      if (!scatter_at_surface(c_.scene, vertex.hit, at_.state, work_.rng, scatter)) return false;
      at_.state.throughput *= scatter.radiance_scale;
      reverse = scatter.radiance_scale;
      if (!vertex.specular) {
        forward = scatter.pdf;
        reverse = scatter_value(vertex.material, vertex.hit, -at_.state.ray.direction, -vertex.travel).pdf;
      }
    }
    at_.from = depart(c_.counts, junction_, vertex, sums_, leg_, at_.state.ray.direction, forward, reverse,
                      SubPath::eye, at_.only_specular);
    return true;
  }

  void add_merged(const Rgb& value, const KernelPair<float>& kernel) {
    radiance_ += KernelEstimate(value * kernel.value, value * kernel.correction);
    count(work_.counters.gather.used);
  }

  const CombinedContext& c_;
  EyeWork& work_;
  EyeBranch at_;
  // Of the last vertex:
  Leg leg_;
  Junction junction_;
  SubPathSums sums_;
  std::vector<Track> tracks_;
  KernelEstimate radiance_;
};

}  // namespace

KernelEstimate combined_radiance(const CombinedContext& context, const Ray& camera_ray, EyeWork& work) {
  return EyeSubPath(context, camera_ray, work).follow();
}

}  // namespace vpm
