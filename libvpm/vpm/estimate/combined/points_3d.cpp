// Photons in media around where an eye sub-path collides.
#include "vpm/base/count.h"
#include "vpm/estimate/combined/eye_sub_path.h"

namespace vpm {

void EyeSubPath::merge_points_3d(const Arrival& at) {
  const PathVertex& vertex = at.vertex;
  const VertexMap<MediumPhoton>& map = c_.light.in_medium(vertex.medium);
  if (c_.counts.points_3d * c_.counts.part_of_points_3d(at_.only_specular) == 0.0 || map.size() == 0) return;
  const Medium& medium = c_.scene.media[vertex.medium];
  const float radius = c_.kernels.points_3d;
  const auto kernel = kernel_of<3>(c_.kernels.volume_kernel, radius);
  Rgb each = at_.state.throughput / static_cast<float>(c_.light_paths);  // times the albedo over the extinction, m
  for (int c = 0; c < 3; ++c)
    each[c] *= at.junction.sigma_t[c] > 0.0f ? medium.albedo()[c] / at.junction.sigma_t[c] : 0.0f;
  count(work_.counters.volume_queries);
  count(work_.counters.gather.searches);
  const auto merge = [&](const MediumPhoton& photon, float distance2) {
    const float phase = phase_density(medium, photon.travel, -vertex.travel);
    const MergeTerms merges =
        merges_in_medium(c_.counts, medium.sigma_t * photon.density, photon.arrived, at.leg,
                         angles_between(photon.travel, photon.turn, vertex.travel), at_.only_specular);
    const BehindMerge eye =
        behind_merge(c_.counts, with_turn(c_.counts, at.sums, photon.travel, photon.arrived.passing));
    const double all = all_at_merge(c_.counts, merges, photon.behind, phase, eye, phase);
    add_merged(Technique::points_3d, each * photon.power * phase, kernel(distance2), merges.points_3d / all);
  };
  count(work_.counters.gather.visited, map.visit_near(vertex.point, radius, merge));
}

}  // namespace vpm
