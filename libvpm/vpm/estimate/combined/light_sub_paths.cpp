// One light sub-path after another, event by event.
#include "vpm/estimate/combined/light_sub_paths.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "vpm/base/count.h"
#include "vpm/path/direct_light.h"
#include "vpm/photon/recorder.h"
#include "vpm/surface/shading.h"

namespace vpm {
namespace {

class LightSubPath {
 public:
  LightSubPath(const LightTracing& tracing, LightSubPaths& paths, Rng& rng) : c_(tracing), out_(paths), rng_(rng) {}

  void trace() {
    emit();
    follow();
    out_.ledger.imbalance.add(balance_);
  }

 private:
  void follow() {
    for (int events = 0; events < c_.max_events; ++events) {
      const std::optional<PathVertex> vertex = fly();
      if (!vertex || !go_on(*vertex)) return;
    }
    ++out_.ledger.cut_count;
    lose(state_.throughput, out_.ledger.cut);
  }

  /// Enters where power has gone, W.
  void lose(const Rgb& power, Rgbd& where) {
    where += Rgbd(power);
    balance_ += sum_channels(power);
  }

  void emit() {
    const PickedLight picked = pick_light(c_.scene, rng_.uniform_double());
    const Light& light = c_.scene.lights[picked.number];
    const Emission emission = vpm::emit(light, c_.scene.bounds, rng_);
    state_ = {emission.ray, medium_of_ray(c_.scene, c_.scene.light_medium[picked.number], emission.ray),
              emission.power / picked.probability};
    const EmissionDensity density = emission_density(light, c_.scene.bounds, emission.normal, emission.ray.direction);
    from_ = depart_from_light(c_.counts, light, picked.probability, density, emission.ray, emission.normal);
    ++out_.ledger.emitted_count;
    out_.ledger.emitted += Rgbd(state_.throughput);
    balance_ -= sum_channels(state_.throughput);
  }

  /// Flies to the next vertex, whose sums are then known.
  std::optional<PathVertex> fly() {
    tracks_.clear();
    const Event event = next_event(c_.scene, c_.strategy, state_, rng_, out_.ledger.walk, kInfinity, &tracks_);
    Rgb passed(1.0f);
    for (const Track& track : tracks_) {
      const Medium& medium = c_.scene.media[track.medium];
      keep_beam(track, medium, passed);
      const DensityIntegral integral = density_integral(medium, track.ray, {0.0f, track.length});
      count(out_.ledger.walk.lookups, integral.lookups);
      passed *= transmittance(medium, integral.value);
    }
    if (!is_finite(state_.throughput)) {
      ++out_.ledger.non_finite;
      return std::nullopt;
    }
    if (event.kind == EventKind::escape) lose(state_.throughput, out_.ledger.escaped);
    if (event.kind != EventKind::collision && event.kind != EventKind::surface) return std::nullopt;
    ++(event.kind == EventKind::collision ? out_.ledger.collisions : out_.ledger.surface_hits);
    const PathVertex vertex = vertex_at(c_.scene, event, state_);
    leg_ = leg_to(from_, vertex.point, passed);
    junction_ = junction_of(c_.scene, vertex);
    sums_ = arrive(c_.counts, from_, leg_, junction_, vertex.point);
    return vertex;
  }

  void keep_beam(const Track& track, const Medium& medium, const Rgb& before) {
    if (c_.counts.beams == 0.0 || !medium.scatters() || !(track.length > 0.0f)) return;
    out_.beams[track.medium].push_back({track.ray.origin, track.length, track.ray.direction, track.throughput});
    out_.starts[track.medium].push_back({from_, before});
  }

  /// Keeps the vertex, and draws how the sub-path goes on.
  bool go_on(const PathVertex& vertex) {
    if (!vertex.specular && (vertex.on_surface || c_.scene.media[vertex.medium].scatters())) {
      out_.vertices.push_back({vertex, junction_, state_.throughput, leg_, sums_});
      if (c_.counts.splats > 0.0) splat(vertex);
    }
    const Rgb before = state_.throughput;
    Rgbd& absorbed = vertex.on_surface ? out_.ledger.absorbed_on_surfaces : out_.ledger.absorbed_in_media;
    const bool goes_on = scatter(vertex);
    lose(goes_on ? before - state_.throughput : before, absorbed);
    return goes_on;
  }

  /// Draws the direction in which the sub-path goes on. False if it is absorbed.
  bool scatter(const PathVertex& vertex) {
    double forward = 1.0, reverse = 1.0;
    if (!vertex.on_surface) {
      const Medium& medium = c_.scene.media[vertex.medium];
      if (!scatter_in_medium(medium, state_, rng_)) return false;
      forward = reverse = phase_density(medium, vertex.travel, state_.ray.direction);
    } else {
      Scatter scatter;
      if (!scatter_at_surface(c_.scene, vertex.hit, state_, rng_, scatter)) return false;
      state_.throughput *= scatter.flux_scale;
      reverse = scatter.radiance_scale;
      if (!vertex.specular) {
        forward = scatter.pdf;
        reverse = scatter_value(vertex.material, vertex.hit, -state_.ray.direction, -vertex.travel).pdf;
      }
    }
    from_ = depart(c_.counts, junction_, vertex, sums_, leg_, state_.ray.direction, forward, reverse, SubPath::light,
                   false);
    return true;
  }

  /// Connects the vertex to the camera.
  void splat(const PathVertex& vertex) {
    const Camera& camera = c_.scene.camera;
    const Vec3 offset = camera.position - vertex.point;
    const float distance = glm::length(offset);
    const Vec3 direction = offset / distance;
    const std::optional<Vec2> film = camera.film_of(-direction);
    if (!film || !on_film(*film)) return;
    const Scattered scattered = scattered_into(c_.scene, vertex, direction, SubPath::light);
    if (is_black(scattered.value)) return;
    const Leaving leaving = leave(c_.scene, vertex, direction);
    const ShadowRays rays{c_.scene, c_.transmittance, rng_, out_.ledger.walk};
    const float length = glm::distance(camera.position, leaving.origin);
    const Rgb passed = visibility(rays, {leaving.origin, direction}, length, leaving.medium);
    if (is_black(passed)) return;
    const Leg leg{passed, distance};
    const Departure departure = depart(c_.counts, junction_, vertex, sums_, leg_, direction, scattered.forward,
                                       scattered.reverse, SubPath::light, true);
    const SubPathSums at_camera = arrive(c_.counts, departure, leg, {}, camera.position);
    const double film_density = camera.film_per_angle(-direction);
    const Rgb irradiance = state_.throughput * scattered.value * passed * static_cast<float>(leg.per_square());
    for_each_pixel(*film, [&](uint32_t pixel, double filter) {
      const double density = filter * film_density, share = share_of_splat(c_.counts, at_camera, density);
      const Rgb radiance = irradiance * static_cast<float>(density * share);
      if (is_finite(radiance))
        out_.splats.push_back({pixel, radiance});
      else
        ++out_.ledger.non_finite;
    });
  }

  bool on_film(const Vec2& film) const {
    const float r = c_.scene.camera.filter.radius;
    const auto w = static_cast<float>(c_.scene.camera.width), h = static_cast<float>(c_.scene.camera.height);
    return film.x > 0.5f - r && film.y > 0.5f - r && film.x < w - 0.5f + r && film.y < h - 0.5f + r;
  }

  /// Calls visit(number, filter_value()) for the pixels whose filters reach a place of the film.
  template <class Visit>
  void for_each_pixel(const Vec2& film, Visit&& visit) const {
    const Camera& camera = c_.scene.camera;
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

  const LightTracing& c_;
  LightSubPaths& out_;
  Rng& rng_;
  PathState state_;
  Departure from_;
  Leg leg_;
  Junction junction_;
  SubPathSums sums_;
  std::vector<Track> tracks_;
  double balance_ = 0.0;  // gone minus emitted, W
};

}  // namespace

void LightSubPaths::join(LightSubPaths& part) {
  join_lists(vertices, part.vertices);
  for (size_t m = 0; m < beams.size(); ++m) {
    join_lists(beams[m], part.beams[m]);
    join_lists(starts[m], part.starts[m]);
  }
  join_lists(splats, part.splats);
  ledger.merge(part.ledger);
}

void trace_light_sub_paths(const LightTracing& tracing, uint64_t begin, uint64_t end, LightSubPaths& paths) {
  for (uint64_t i = begin; i < end; ++i) {
    Rng rng(tracing.seed, rng_stream(RngUse::photon, tracing.pass), i);
    LightSubPath(tracing, paths, rng).trace();
  }
}

}  // namespace vpm
