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

/// SubPathSums::turn behind a vertex in a medium, at another one.
Vec3d turn_of(const TechniqueCounts& counts, const Departure& departure, const Leg& leg) {
  const Vec3d turn = glm::cross(Vec3d(departure.travel), Vec3d(departure.direction));
  const Rgb& sigma_t = departure.from.sigma_t;
  if (departure.way == SubPath::light) return turn * over_colliding(sigma_t, departure.arrived).passing;
  // Planes need collide neither at the departure nor here: of the densities there the distance remains.
  return departure.first ? turn * (counts.planes * leg.per_square() / colliding(sigma_t, departure.arrived))
                         : Vec3d(0.0);
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
  departure.travel = at.vertex.travel;
  departure.arrived = at.leg;
  departure.angles = angles_between(at.vertex.travel, way == SubPath::light ? sums.turn : Vec3d(0.0), onward.direction);
  if (way == SubPath::eye)
    departure.planes = onward.reverse * std::abs(glm::dot(sums.turn, Vec3d(onward.direction))) / sums.density;
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
    const OverColliding from_light = over_colliding(sigma_t, light ? departure.arrived : leg);
    behind += merges_in_medium(counts, departure.from, from_light, light ? leg : departure.arrived, departure.angles,
                               departure.first)
                  .sum();
    behind += counts.weigh(departure.planes * from_light.passing);
  }
  SubPathSums sums;
  sums.density = std::max(kLeastDensity, departure.forward * arrival(at, departure.direction, leg) * leg.per_square());
  sums.further = counts.weigh(arrival(departure.from, departure.direction, leg) * leg.per_square()) * behind;
  if (at.kind == Junction::Kind::free) return sums;
  sums.adjacent = departure.adjacent;
  sums.straight = departure.light != nullptr;
  sums.seen = departure.camera;
  if (at.kind == Junction::Kind::medium && departure.merges && counts.planes > 0.0)
    sums.turn = turn_of(counts, departure, leg);
  if (departure.light)
    sums.adjacent = sampled_density(*departure.light, point,
                                    {-departure.direction, static_cast<float>(leg.distance), departure.from.normal}) /
                    departure.place;
  return sums;
}

OverColliding over_colliding(const Rgb& sigma_t, const Leg& leg) {
  const double sent = 1.0 / colliding(sigma_t, leg);
  return {leg.mean() * sent, sent};
}

MergeTerms merges_in_medium(const TechniqueCounts& counts, const Junction& there, const OverColliding& from_light,
                            const Leg& from_eye, const Angles& angles, bool first) {
  MergeTerms terms;
  terms.points_3d = counts.merges_points_3d(first) ? counts.weigh(counts.points_3d * there.kept) : 0.0;
  if (!first) return terms;
  const double eye = 1.0 / colliding(there.sigma_t, from_eye);  // as its sub-path need not collide here, m
  terms.points_2d = counts.weigh(counts.points_2d * there.kept * eye);
  terms.short_beams = counts.weigh(counts.short_beams * angles.sine * from_light.passing * eye);
  terms.long_beams = counts.weigh(counts.long_beams * angles.sine * from_light.sent * eye);
  terms.planes = counts.weigh(counts.planes * angles.determinant * from_light.sent * eye);
  return terms;
}

MergeTerms merges_on_surface(const TechniqueCounts& counts, bool first) {
  return {.surface = counts.merges_surfaces(first) ? counts.weigh(counts.surfaces) : 0.0};
}

Angles angles_between(const Vec3& light, const Vec3d& turn, const Vec3& eye) {
  return {glm::length(glm::cross(Vec3d(light), Vec3d(eye))), std::abs(glm::dot(turn, Vec3d(eye)))};
}

SubPathSums with_turn(const TechniqueCounts& counts, const SubPathSums& eye, const Vec3& travel, double passing) {
  SubPathSums sums = eye;
  sums.further += counts.weigh(std::abs(glm::dot(eye.turn, Vec3d(travel))) * passing);
  return sums;
}

BehindMerge behind_merge(const TechniqueCounts& counts, const SubPathSums& sums) {
  const double density = counts.weigh(sums.density);
  return {counts.weigh(sums.adjacent) / density, sums.further / density};
}

ConnectionShares shares_of_connection(const TechniqueCounts& counts, const Departure& light, const SubPathSums& at_eye,
                                      const Departure& eye, const SubPathSums& at_light) {
  const double connected = counts.weigh(at_eye.adjacent);
  const double behind = counts.weigh(eye.forward) * at_eye.further;
  const SubPathSums beyond =
      with_turn(counts, at_light, light.travel, over_colliding(light.from.sigma_t, light.arrived).passing);
  const double before = counts.weigh(light.forward) * beyond.further;
  const double all = connected + behind + before;
  return {connected / all, behind / all};
}

double share_of_splat(const TechniqueCounts& counts, const SubPathSums& at_camera, double camera_density) {
  const double splats = counts.weigh(counts.splats);
  return splats / (splats + counts.weigh(camera_density) * at_camera.further);
}

}  // namespace vpm
