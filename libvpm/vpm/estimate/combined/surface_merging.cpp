// Photons on surfaces around where an eye sub-path meets these.
#include <cmath>

#include "vpm/base/count.h"
#include "vpm/estimate/combined/eye_sub_path.h"
#include "vpm/estimate/surface_estimate.h"

namespace vpm {

void EyeSubPath::merge_surface(const Arrival& at) {
  const VertexMap<RecordLeaf<SurfacePhoton>>& map = c_.light.on_surfaces();
  if (!c_.counts.merges_surfaces(at_.only_specular) || map.size() == 0) return;
  const float radius = c_.kernels.surface;
  const auto kernel = kernel_of<2>(c_.kernels.surface_kernel, radius);
  const PathVertex& vertex = at.vertex;
  const Vec3 side = glm::dot(vertex.hit.normal, vertex.travel) < 0.0f ? vertex.hit.normal : -vertex.hit.normal;
  const Arrives arrives{side, kFlatness * radius, scatters_through(vertex.material)};
  const MergeTerms merges = merges_on_surface(c_.counts, at_.only_specular);
  const BehindMerge eye = behind_merge(c_.counts, at.sums);
  const Rgb each = at_.state.throughput / static_cast<float>(c_.light_paths);
  count(work_.counters.surface_queries);
  count(work_.counters.gather.searches);
  const auto merge = [&](const SurfacePhoton& photon, float distance2) {
    const bool faces = arrives.from_both_sides || glm::dot(photon.travel, side) < 0.0f;
    if (!faces || !arrives.near_plane(photon.point - vertex.point)) return;
    const Scattered scattered = scattered_into(c_.scene, vertex, -photon.travel, SubPath::eye);
    const float cosine = std::abs(glm::dot(vertex.hit.normal, photon.travel));
    if (is_black(scattered.value) || cosine == 0.0f) return;
    const double all = all_at_merge(c_.counts, merges, photon.behind, scattered.forward, eye, scattered.reverse);
    const Rgb found = each * scattered.value * photon.power / cosine;
    add_merged(Technique::surface_merging, found, kernel(distance2), merges.surface / all);
  };
  count(work_.counters.gather.visited, map.visit_near(vertex.point, radius, merge));
}

}  // namespace vpm
