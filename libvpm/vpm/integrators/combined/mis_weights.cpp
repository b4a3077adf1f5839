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

Junction junction_of(const TechniqueCounts& counts, const Scene& scene, const PathVertex& vertex) {
  if (vertex.specular) return {};
  if (vertex.on_surface) return {Junction::Kind::surface, vertex.hit.normal};
  return junction_in(counts, scene.media[vertex.medium], vertex.density);
}

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
  if (!is_infinite(light) && can_be_hit(light)) start.from = {Junction::Kind::surface, normal};
  start.point = ray.origin;
  start.direction = ray.direction;
  start.forward = emission.flight;
  if (counts.light && can_be_hit(light)) start.behind = 1.0 / counts.weigh(chosen * emission.place);
  start.light = counts.light ? &light : nullptr;
  start.place = counts.each_light ? chosen * emission.place : emission.place;
  start.parallel = emission.parallel;
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

Departure depart(const TechniqueCounts& counts, const Arrival& at, const Onward& onward, SubPath way, bool first) {
  const SubPathSums& sums = at.sums;
  const Junction& from = at.junction;
  Departure departure;
  departure.from = from;
  departure.point = at.vertex.point;
  departure.direction = onward.direction;
  departure.forward = onward.forward;
  if (counts.deep || first || from.kind == Junction::Kind::free) {
    const BehindMerge behind = behind_merge(counts, sums);
    departure.behind = behind.sum(counts.weigh(onward.reverse));
    if (from.kind == Junction::Kind::surface) {
      if (!sums.straight) departure.unless_straight = merges_on_surface(counts, first).sum();
      if (sums.seen) {
        departure.behind = counts.weigh(onward.reverse) * behind.further;
        departure.unless_straight += behind.adjacent;
      }
    }
  }
  departure.adjacent = from.kind == Junction::Kind::free ? 0.0 : counts.connections;
  departure.way = way;
  if (from.kind != Junction::Kind::medium) return departure;
  departure.merges = true;
  departure.first = first;
  departure.arrived = at.leg;
  departure.sine = sine_between(at.vertex.travel, onward.direction);
  return departure;
}

Leg leg_to(const Departure& departure, const Vec3& point, const Rgb& transmittance) {
  constexpr double kLeast = 1e-9;  // m: rounding may put two vertices into one point
  if (departure.parallel) return {transmittance, 1.0};
  return {transmittance, std::max(kLeast, glm::distance(Vec3d(departure.point), Vec3d(point)))};
}

SubPathSums arrive(const TechniqueCounts& counts, const Departure& departure, const Leg& leg, const Junction& at,
                   const Vec3& point) {
  double behind = departure.behind + (at.light && counts.light ? 0.0 : departure.unless_straight);
  if (departure.merges) {
    const Rgb& sigma_t = departure.from.sigma_t;
    const bool light = departure.way == SubPath::light;
    const Leg &from_light = light ? departure.arrived : leg, &from_eye = light ? leg : departure.arrived;
    behind += merges_in_medium(counts, departure.from, passing(sigma_t, from_light), from_eye, departure.sine,
                               departure.first)
                  .sum();
  }
  SubPathSums sums;
  sums.density = std::max(kLeastDensity, departure.forward * arrival(at, departure.direction, leg) * leg.per_square());
  sums.further = counts.weigh(arrival(departure.from, departure.direction, leg) * leg.per_square()) * behind;
  if (at.kind == Junction::Kind::free) return sums;
  sums.adjacent = departure.adjacent;
  sums.straight = departure.light != nullptr;
  sums.seen = departure.camera;
  if (departure.light)
    sums.adjacent = sampled_density(*departure.light, point,
                                    {-departure.direction, static_cast<float>(leg.distance), departure.from.normal}) /
                    departure.place;
  return sums;
}

double passing(const Rgb& sigma_t, const Leg& leg) { return leg.mean() * (1.0 / colliding(sigma_t, leg)); }

MergeTerms merges_in_medium(const TechniqueCounts& counts, const Junction& there, double passing, const Leg& from_eye,
                            double sine, bool first) {
  MergeTerms terms;
  terms.points_3d = counts.merges_points_3d(first) ? counts.weigh(counts.points_3d * there.kept) : 0.0;
  if (!first) return terms;
  const double eye = 1.0 / colliding(there.sigma_t, from_eye);  // as its sub-path need not collide here, m
  terms.points_2d = counts.weigh(counts.points_2d * there.kept * eye);
  terms.short_beams = counts.weigh(counts.short_beams * sine * passing * eye);
  return terms;
}

MergeTerms merges_on_surface(const TechniqueCounts& counts, bool first) {
  return {.surface = counts.merges_surfaces(first) ? counts.weigh(counts.surfaces) : 0.0};
}

double sine_between(const Vec3& a, const Vec3& b) { return glm::length(glm::cross(Vec3d(a), Vec3d(b))); }

BehindMerge behind_merge(const TechniqueCounts& counts, const SubPathSums& sums) {
  const double density = counts.weigh(sums.density);
  return {counts.weigh(sums.adjacent) / density, sums.further / density};
}

ConnectionShares shares_of_connection(const TechniqueCounts& counts, const Departure& light, const SubPathSums& at_eye,
                                      const Departure& eye, const SubPathSums& at_light) {
  const double connected = counts.weigh(at_eye.adjacent);
  const double behind = counts.weigh(eye.forward) * at_eye.further;
  const double before = counts.weigh(light.forward) * at_light.further;
  const double all = connected + behind + before;
  return {connected / all, behind / all};
}

double share_of_splat(const TechniqueCounts& counts, const SubPathSums& at_camera, double camera_density) {
  const double splats = counts.weigh(counts.splats);
  return splats / (splats + counts.weigh(camera_density) * at_camera.further);
}

}  // namespace vpm
