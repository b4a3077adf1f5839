// Photons in media around where an eye sub-path collides.
#include "vpm/base/count.h"
#include "vpm/estimate/combined/eye_sub_path.h"

namespace vpm {

void EyeSubPath::merge_points_3d(const Arrival& at) {
  const PathVertex& vertex = at.vertex;
  const VertexMap& map = c_.light.around_points(vertex.medium);
  if (map.size() == 0) return;
  const Medium& medium = c_.scene.media[vertex.medium];
  const auto kernel = kernel_of<3>(c_.kernels.volume_kernel, map.radius());
  Rgb each = at_.state.throughput / static_cast<float>(c_.light_paths);  // times the albedo over the extinction, m
  for (int c = 0; c < 3; ++c)
    each[c] *= at.junction.sigma_t[c] > 0.0f ? medium.albedo()[c] / at.junction.sigma_t[c] : 0.0f;
  count(work_.counters.volume_queries);
  count(work_.counters.gather.searches);
  const uint32_t visited = map.visit_near(vertex.point, [&](uint32_t number, float distance2) {
    const LightVertex& light = c_.light.of_medium(vertex.medium, number);
    const Vec3& travel = light.at.vertex.travel;
    const float phase = phase_density(medium, travel, -vertex.travel);
    const MergeTerms merges = merges_in_medium(c_.counts, light.at.junction.sigma_t, light.at.leg, at.leg,
                                               angles_between(travel, light.at.sums, vertex.travel), at_.only_specular);
    const SubPathSums eye = with_turn(c_.counts, at.sums, light.at.junction, travel, light.at.leg);
    const double all = all_at_merge(c_.counts, merges, light.at.sums, phase, eye, phase);
    add_merged(Technique::points_3d, each * light.power * phase, kernel(distance2), merges.points_3d / all);
  });
  count(work_.counters.gather.visited, visited);
}

}  // namespace vpm
