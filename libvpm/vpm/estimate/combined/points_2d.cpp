// Photons in media around whole rays from the camera.
#include "vpm/base/count.h"
#include "vpm/estimate/combined/eye_sub_path.h"

namespace vpm {

void EyeSubPath::merge_points_2d(const Along& along, const Interval& interval) {
  const VertexMap& map = c_.light.beside_rays(along.medium);
  if (map.size() == 0) return;
  const Medium& medium = c_.scene.media[along.medium];
  const auto kernel = kernel_of<2>(c_.kernels.volume_kernel, map.radius());
  const Rgb each = at_.state.throughput * medium.albedo() / static_cast<float>(c_.light_paths);
  count(work_.counters.volume_queries);
  count(work_.counters.gather.searches);
  const uint32_t visited = map.visit_near_ray(along.ray, interval, [&](uint32_t number, float distance2) {
    const LightVertex& light = c_.light.of_medium(along.medium, number);
    const PathVertex& photon = light.at.vertex;
    const double t = glm::dot(photon.point - along.ray.origin, along.ray.direction);
    const Leg leg = leg_to(at_.from, photon.point, along.to(t));
    if (is_black(leg.transmittance)) return;
    const float phase = phase_density(medium, photon.travel, -along.ray.direction);
    const MergeTerms merges = merges_in_medium(c_.counts, light.at.junction.sigma_t, light.at.leg, leg,
                                               angles_between(photon.travel, light.at.sums, along.ray.direction), true);
    const SubPathSums eye = arrive(c_.counts, at_.from, leg, light.at.junction, photon.point);
    const double all = all_at_merge(c_.counts, merges, light.at.sums, phase, eye, phase);
    const Rgb found = each * leg.transmittance * light.power * phase;
    add_merged(Technique::points_2d, found, kernel(distance2), merges.points_2d / all);
  });
  count(work_.counters.gather.visited, visited);
}

}  // namespace vpm
