// Photons on surfaces around where an eye sub-path meets these.
#include <cmath>

#include "vpm/base/count.h"
#include "vpm/estimate/combined/eye_sub_path.h"
#include "vpm/estimate/surface_estimate.h"

namespace vpm {

void EyeSubPath::merge_surface(const Arrival& at) {
  const VertexMap& map = c_.light.on_surfaces();
  if (map.size() == 0) return;
  const auto kernel = kernel_of<2>(c_.kernels.surface_kernel, map.radius());
  const PathVertex& vertex = at.vertex;
  const Vec3 side = glm::dot(vertex.hit.normal, vertex.travel) < 0.0f ? vertex.hit.normal : -vertex.hit.normal;
  const Arrives arrives{side, kFlatness * map.radius(), scatters_through(vertex.material)};
  const MergeTerms merges = merges_on_surface(c_.counts, at_.only_specular);
  const Rgb each = at_.state.throughput / static_cast<float>(c_.light_paths);
  count(work_.counters.surface_queries);
  count(work_.counters.gather.searches);
  const uint32_t visited = map.visit_near(vertex.point, [&](uint32_t number, float distance2) {
    const LightVertex& light = c_.light.of_surfaces(number);
    const Vec3& travel = light.at.vertex.travel;
    if (light.at.sums.straight) return;
    const bool faces = arrives.from_both_sides || glm::dot(travel, side) < 0.0f;
    if (!faces || !arrives.near_plane(light.at.vertex.point - vertex.point)) return;
    const Scattered scattered = scattered_into(c_.scene, vertex, -travel, SubPath::eye);
    const float cosine = std::abs(glm::dot(vertex.hit.normal, travel));
    if (is_black(scattered.value) || cosine == 0.0f) return;
    const double all = all_at_merge(c_.counts, merges, light.at.sums, scattered.forward, at.sums, scattered.reverse);
    const Rgb found = each * scattered.value * light.power / cosine;
    add_merged(Technique::surface_merging, found, kernel(distance2), merges.surface / all);
  });
  count(work_.counters.gather.visited, visited);
}

}  // namespace vpm
