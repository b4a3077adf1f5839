// Photons in media around whole rays from the camera.
#include "vpm/base/count.h"
#include "vpm/estimate/combined/eye_sub_path.h"
#include "vpm/photon/stored_power.h"

namespace vpm {

void EyeSubPath::merge_points_2d(const Along& along, const Interval& interval) {
  const VertexMap<MediumPhoton>& map = c_.light.in_medium(along.medium);
  if (c_.counts.points_2d == 0.0 || map.size() == 0) return;
  const Medium& medium = c_.scene.media[along.medium];
  const float radius = c_.kernels.points_2d;
  const auto kernel = kernel_of<2>(c_.kernels.volume_kernel, radius);
  const Rgb each = at_.state.throughput * medium.albedo() / static_cast<float>(c_.light_paths);
  count(work_.counters.volume_queries);
  count(work_.counters.gather.searches);
  const auto merge = [&](const MediumPhoton& photon, float distance2, float t) {
    const Vec3 point = along.ray.origin + t * along.ray.direction;
    const float density = medium.density(point);
    count(work_.counters.walk.lookups);
    const Leg leg = leg_to(at_.from, point, along.to(t));
    if (density == 0.0f || is_black(leg.transmittance)) return;
    const Junction there = junction_in(c_.counts, medium, density);
    const float phase = phase_density(medium, photon.travel, -along.ray.direction);
    const MergeTerms merges = merges_in_medium(c_.counts, there, photon.arrived.over(density), leg,
                                               angles_between(photon.travel, photon.turn, along.ray.direction), true);
    const BehindMerge eye = behind_merge(c_.counts, arrive(c_.counts, at_.from, leg, there, point));
    const double all = all_at_merge(c_.counts, merges, photon.behind.over(c_.counts.weigh(density)), phase, eye, phase);
    add_merged(Technique::points_2d,
               each * leg.transmittance * photon.power * (relative_density(medium, density) * phase), kernel(distance2),
               merges.points_2d / all);
  };
  count(work_.counters.gather.visited, map.visit_near_ray(along.ray, interval, radius, merge));
}

}  // namespace vpm
