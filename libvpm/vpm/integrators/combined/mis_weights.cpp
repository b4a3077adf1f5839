// Sums over techniques, from vertex to vertex.
#include "vpm/integrators/combined/mis_weights.h"

#include <algorithm>
#include <cmath>

#include "vpm/photon/stored_power.h"

namespace vpm {
namespace {

/// Densities are no less: what rounding makes 0 is then negligible in shares, and not 0 over 0.
constexpr double kLeastDensity = 1e-60;

double colliding(const Rgb& sigma_t, const Leg& leg) {
  return std::max(kLeastDensity, double{mean_channel(sigma_t * leg.transmittance)});
}

}  // namespace

Junction junction_in(const TechniqueCounts& counts, const Medium& medium, float density) {
  Junction there{Junction::Kind::medium, Vec3(0.0f), medium.sigma_t * density};
  if (medium.grid && density > 0.0f)
    there.kept = std::max(1.0, double{floor_in(medium, counts.density_floor)} / relative_density(medium, density));
  return there;
}

double arrival(const Junction& at, const Vec3& direction, const Leg& leg) {
  switch (at.kind) {
    case Junction::Kind::surface:
      return std::abs(glm::dot(at.normal, direction)) * leg.mean();
    case Junction::Kind::medium:
      return colliding(at.sigma_t, leg);
    case Junction::Kind::free:
      return leg.mean();
  }
  __builtin_unreachable();
}

Departure depart_from_light(const TechniqueCounts& counts, const Light& light, double chosen,
                            const EmissionDensity& emission, const Ray& ray, const Vec3& normal) {
  Departure start;
  if (!emission.parallel && can_be_hit(light)) start.from = {Junction::Kind::surface, normal};
  start.point = ray.origin;
  start.direction = ray.direction;
  start.forward = emission.flight;
  if (counts.light && can_be_hit(light)) start.behind = 1.0 / counts.weigh(chosen * emission.place);
  start.light = counts.light ? &light : nullptr;
  start.place = counts.each_light ? chosen * emission.place : emission.place;
  start.parallel = emission.parallel;
  return start;
}

Departure depart_from_medium(const TechniqueCounts& counts, const Light& light, double chosen, const Rgb& arriving,
                             const Ray& ray) {
  Departure start = depart_from_light(counts, light, chosen, emission_density(light, arriving), ray, Vec3(0.0f));
  start.from_medium = true;
  return start;
}

Departure depart_from_camera(const TechniqueCounts& counts, const Ray& ray, double forward) {
  Departure start;
  start.point = ray.origin;
  start.direction = ray.direction;
  start.forward = forward;
  start.adjacent = counts.splats;
  start.camera = true;
  start.way = SubPath::eye;
  return start;
}

Departure depart(const TechniqueCounts& counts, const PathVertex& at, const Vec3& direction, const Densities& densities,
                 SubPath way, bool first) {
  Departure departure;
  departure.from = at;
  departure.point = at.point;
  departure.direction = direction;
  departure.forward = densities.forward;
  if (counts.deep || first || at.kind == Junction::Kind::free) {
    departure.behind = at.behind.sum(counts.weigh(densities.reverse));
    if (at.kind == Junction::Kind::surface) {
      if (!at.straight) departure.unless_straight = merges_on_surface(counts, first);
      if (at.seen) {
        departure.behind = counts.weigh(densities.reverse) * at.behind.further;
        departure.unless_straight += at.behind.adjacent;
      }
    }
  }
  departure.adjacent = at.kind == Junction::Kind::free ? 0.0 : counts.connections;
  departure.way = way;
  if (at.kind != Junction::Kind::medium) return departure;
  departure.merges = true;
  departure.first = first;
  departure.arrived = at.leg;
  departure.sine = sine_between(at.travel, direction);
  return departure;
}

Leg leg_to(const Departure& departure, const Vec3& point, const Rgb& transmittance) {
  constexpr double kLeast = 1e-9;  // m: rounding may put two vertices into one point
  if (departure.from_medium) return {Rgb(1.0f), 1.0, false};
  if (departure.parallel) return {transmittance, 1.0};
  return {transmittance, std::max(kLeast, glm::distance(Vec3d(departure.point), Vec3d(point)))};
}

double connections_over(const Departure& departure, const Leg& leg, const Junction& at, const Vec3& point) {
  if (at.kind == Junction::Kind::free) return 0.0;
  if (!departure.light) return departure.adjacent;
  return sampled_density(*departure.light, point,
                         {-departure.direction, static_cast<float>(leg.distance), departure.from.normal}) /
         departure.place;
}

double further_behind(const TechniqueCounts& counts, const Departure& departure, const Leg& leg, bool starts) {
  double sum = departure.behind + (starts && counts.light ? 0.0 : departure.unless_straight);
  if (departure.merges) {
    const Rgb& sigma_t = departure.from.sigma_t;
    const bool light = departure.way == SubPath::light;
    const Leg &from_light = light ? departure.arrived : leg, &from_eye = light ? leg : departure.arrived;
    sum += merges_in_medium(counts, departure.from, passing(sigma_t, from_light), from_eye, departure.sine,
                            departure.first);
  }
  return counts.weigh(arrival(departure.from, departure.direction, leg) * leg.per_square()) * sum;
}

Behind techniques_behind(const TechniqueCounts& counts, const Departure& departure, const Leg& leg, const Junction& at,
                         const Vec3& point) {
  return {counts.weigh(connections_over(departure, leg, at, point)), further_behind(counts, departure, leg, at.starts)};
}

Behind arrive(const TechniqueCounts& counts, const Departure& departure, const Leg& leg, const Junction& at,
              const Vec3& point) {
  const double density =  // f_i, or r_i, of the last vertex
      std::max(kLeastDensity, departure.forward * arrival(at, departure.direction, leg) * leg.per_square());
  return techniques_behind(counts, departure, leg, at, point).over(counts.weigh(density));
}

void arrive(const TechniqueCounts& counts, const Departure& departure, PathVertex& vertex) {
  const bool free = vertex.kind == Junction::Kind::free;
  vertex.behind = arrive(counts, departure, vertex.leg, vertex, vertex.point);
  vertex.straight = !free && departure.light;
  vertex.seen = !free && departure.camera;
}

PathVertex arrive(const TechniqueCounts& counts, const Scene& scene, const Departure& departure, const Event& event,
                  const PathState& state, const Rgb& passed) {
  PathVertex vertex;
  vertex.point = state.ray.origin;
  vertex.travel = state.ray.direction;
  vertex.medium = state.medium;
  vertex.leg = leg_to(departure, vertex.point, passed);
  vertex.power = state.throughput;
  vertex.on_surface = event.kind == EventKind::surface;
  if (vertex.on_surface) {
    vertex.hit = event.hit;
    vertex.material = material_at(scene, event.hit);
    vertex.specular = !is_rough(vertex.material);
    if (!vertex.specular) vertex.set_junction({Junction::Kind::surface, vertex.hit.normal});
  } else {
    vertex.density = event.density;
    vertex.set_junction(junction_in(counts, scene.media[vertex.medium], vertex.density));
  }
  arrive(counts, departure, vertex);
  return vertex;
}

double passing(const Rgb& sigma_t, const Leg& leg) {
  return leg.crossed ? leg.mean() * (1.0 / colliding(sigma_t, leg)) : 0.0;
}

double points_3d_merged(const TechniqueCounts& counts, const Junction& there, bool first) {
  return counts.merges_points_3d(first) ? counts.weigh(counts.points_3d * there.kept) : 0.0;
}

double merges_in_medium(const TechniqueCounts& counts, const Junction& there, double passing, const Leg& from_eye,
                        double sine, bool first) {
  const double points_3d = points_3d_merged(counts, there, first);
  if (!first) return points_3d;
  const double eye = 1.0 / colliding(there.sigma_t, from_eye);  // as its sub-path need not collide here, m
  const double points_2d = counts.weigh(counts.points_2d * there.kept * eye);
  const double short_beams = counts.weigh(counts.short_beams * sine * passing * eye);
  return points_3d + points_2d + short_beams;
}

double merges_on_surface(const TechniqueCounts& counts, bool first) {
  return counts.merges_surfaces(first) ? counts.weigh(counts.surfaces) : 0.0;
}

double sine_between(const Vec3& a, const Vec3& b) { return glm::length(glm::cross(Vec3d(a), Vec3d(b))); }

namespace {

double all_at_connection(const TechniqueCounts& counts, const Departure& light, const Behind& at_eye,
                         const Departure& eye, const Behind& at_light) {
  return at_eye.sum(counts.weigh(eye.forward)) + counts.weigh(light.forward) * at_light.further;
}

}  // namespace

double share_of_connection(const TechniqueCounts& counts, const Departure& light, const Behind& at_eye,
                           const Departure& eye, const Behind& at_light) {
  return at_eye.adjacent / all_at_connection(counts, light, at_eye, eye, at_light);
}

double share_of_running_into(const TechniqueCounts& counts, const Departure& light, const Behind& at_eye,
                             const Departure& eye, const Behind& at_light) {
  return counts.weigh(eye.forward) * at_eye.further / all_at_connection(counts, light, at_eye, eye, at_light);
}

double share_of_splat(const TechniqueCounts& counts, const Behind& at_camera, double camera_density) {
  const double splats = counts.weigh(counts.splats);
  return splats / (splats + counts.weigh(camera_density) * at_camera.further);
}

}  // namespace vpm
