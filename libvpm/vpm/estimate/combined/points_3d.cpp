// Photons in media around where an eye sub-path collides.
#include "vpm/base/counters.h"
#include "vpm/estimate/combined/eye_sub_path.h"
#include "vpm/photon/stored_power.h"

namespace vpm {

void EyeSubPath::merge_points_3d(const Arrival& at) {
  const PathVertex& vertex = at.vertex;
  const VertexMap<MediumPhotonLeaf>& map = c_.light.in_medium(vertex.medium);
  if (!c_.counts.merges_points_3d(at_.only_specular) || map.size() == 0) return;
  const Medium& medium = c_.scene.media[vertex.medium];
  const float radius = c_.kernels.points_3d;
  const auto kernel = kernel_of<3>(c_.kernels.volume_kernel, radius);
  // Times the albedo and the relative density over the extinction, m
  Rgb each = at_.state.throughput * (relative_density(medium, vertex.density) / static_cast<float>(c_.light_paths));
  for (int c = 0; c < 3; ++c)
    each[c] *= at.junction.sigma_t[c] > 0.0f ? medium.albedo()[c] / at.junction.sigma_t[c] : 0.0f;
  const double scale = c_.light.scale_in(vertex.medium);
  count(work_.counters.volume_queries);
  count(work_.counters.gather.searches);
  const auto merge = [&](const MediumPhoton& photon, float distance2) {
    const float phase = phase_density(medium, photon.travel, -vertex.travel);
    const OverColliding arrived = photon.arrived.over(vertex.density);
    const MergeTerms merges =
        merges_in_medium(c_.counts, at.junction, arrived, at.leg,
                         angles_between(photon.travel, photon.turn, vertex.travel), at_.only_specular);
    const BehindMerge eye = behind_merge(c_.counts, with_turn(c_.counts, at.sums, photon.travel, arrived.passing));
    const double all =
        all_at_merge(c_.counts, merges, photon.behind.over(scale * c_.counts.weigh(vertex.density)), phase, eye, phase);
    add_merged(Technique::points_3d, each * photon.power * phase, kernel(distance2), merges.points_3d / all);
  };
  count(work_.counters.gather.visited, map.visit_near(vertex.point, radius, merge));
}

}  // namespace vpm
