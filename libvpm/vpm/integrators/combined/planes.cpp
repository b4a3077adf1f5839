// Photon planes that cross whole rays from the camera, see photon_plane.h. The crossing tells where the photon has
// collided for the last but one time, so that neither this place nor the next one is drawn, and there is no kernel.
#include "vpm/base/counters.h"
#include "vpm/integrators/combined/eye_sub_path.h"
#include "vpm/medium/distance/mixture.h"

namespace vpm {

void EyeSubPath::merge_planes(const Along& along, const Interval& interval) {
  if (c_.light.planes().size() == 0) return;
  count(work_.counters.volume_queries);
  c_.light.planes().visit_crossings(along.ray, interval,
                                    [&](const PlaneCrossing& crossing) { merge_plane(along, crossing); });
}

void EyeSubPath::merge_plane(const Along& along, const PlaneCrossing& crossing) {
  const Medium& medium = c_.scene.media[along.medium];
  const Vec3 place = along.ray.at(crossing.t);
  const float density = medium.density(place);
  const Leg to_eye = leg_to(at_.from, place, along.to(crossing.t));
  count(work_.counters.walk.lookups);
  if (density == 0.0f || is_black(to_eye.transmittance)) return;
  Rgb scattered;
  const std::optional<Arrival> turn = turn_of_plane(crossing, scattered);
  if (!turn) return;
  const PhotonPlane& plane = crossing.plane;
  count(work_.counters.shadow_rays);
  const ShadowRays rays{c_.scene, c_.transmittance, work_.rng, work_.counters.walk};
  const Leg from_turn{visibility_of_place(rays, {turn->vertex.point, plane.scattered}, crossing.beyond, plane.medium),
                      crossing.beyond};
  if (is_black(from_turn.transmittance)) return;
  const double onward = phase_density(c_.scene.media[plane.medium], plane.direction, plane.scattered);
  const Departure departure = depart(c_.counts, *turn, {plane.scattered, onward, onward}, SubPath::light, false);
  const Junction there = junction_in(c_.counts, medium, density);
  const float phase = phase_density(medium, plane.scattered, -along.ray.direction);
  const SubPathSums at_end = arrive(c_.counts, departure, from_turn, there, place);
  const MergeTerms merges = merges_in_medium(c_.counts, there, over_colliding(there.sigma_t, from_turn), to_eye,
                                             angles_between(plane.scattered, at_end.turn, along.ray.direction), true);
  const BehindMerge light = behind_merge(c_.counts, at_end);
  const BehindMerge eye = behind_merge(c_.counts, arrive(c_.counts, at_.from, to_eye, there, place));
  const double all = all_at_merge(c_.counts, merges, light, phase, eye, phase);
  const Rgb value = asked() * to_eye.transmittance * medium.sigma_s * scattered * from_turn.transmittance *
                    (density * phase / crossing.determinant / static_cast<float>(c_.light_paths));
  add(Technique::planes, KernelEstimate(value), merges.planes / all);
  count(work_.counters.gather.used);
}

std::optional<Arrival> EyeSubPath::turn_of_plane(const PlaneCrossing& crossing, Rgb& scattered) {
  const PhotonPlane& plane = crossing.plane;
  const Medium& medium = c_.scene.media[plane.medium];
  const Ray flight{plane.origin, plane.direction};
  Arrival turn;
  turn.vertex.point = flight.at(crossing.along_flight);
  turn.vertex.travel = plane.direction;
  turn.vertex.medium = plane.medium;
  turn.vertex.density = medium.density(turn.vertex.point);
  if (turn.vertex.density == 0.0f) return std::nullopt;
  const DensityIntegral integral = density_integral(medium, flight, {0.0f, crossing.along_flight});
  count(work_.counters.walk.lookups, integral.lookups + 1);
  const FlightStart& start = c_.light.plane_start(crossing.number);
  turn.leg = leg_to(start.from, turn.vertex.point, start.before * transmittance(medium, integral.value));
  if (is_black(turn.leg.transmittance)) return std::nullopt;
  turn.junction = junction_of(c_.counts, c_.scene, turn.vertex);
  turn.sums = arrive(c_.counts, start.from, turn.leg, turn.junction, turn.vertex.point);
  scattered = plane.power * analog_weight(medium, channel_shares(plane.power), integral.value, false) * medium.sigma_s *
              turn.vertex.density;
  return turn;
}

}  // namespace vpm
