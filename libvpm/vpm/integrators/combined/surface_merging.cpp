// Photons on surfaces around where an eye sub-path meets these.
#include <cmath>

#include "vpm/base/counters.h"
#include "vpm/estimate/surface_estimate.h"
#include "vpm/integrators/combined/eye_sub_path.h"
#include "vpm/integrators/combined/merge_photons.h"
#include "vpm/integrators/combined/merging_rays.h"

namespace vpm {

void EyeSubPath::merge_surface(const PathVertex& at) {
  const MergeMap& map = c_.light.on_surfaces();
  if (!c_.counts.merges_surfaces(at_.only_specular) || map.size() == 0) return;
  count(work_.counters.surface_queries);
  count(work_.counters.gather.searches);
  const Vec3 side = glm::dot(at.hit.normal, at.travel) < 0.0f ? at.hit.normal : -at.hit.normal;
  if (const Rgb* diffuse = diffuse_reflectance(at.material); diffuse && single_normal(at.hit))
    return merge_diffuse(at, side, *diffuse);
  const float radius = c_.kernels.surface;
  const auto kernel = kernel_of<2>(c_.kernels.surface_kernel, radius);
  const Arrives arrives{side, kFlatness * radius, scatters_through(at.material)};
  const Behind eye = at.behind.over(merges_on_surface(c_.counts, at_.only_specular));
  const Rgb each = at_.state.throughput / static_cast<float>(c_.light_paths);
  const auto merge = [&](const MergePhoton& photon, float distance2) {
    const bool faces = arrives.from_both_sides || glm::dot(photon.travel, side) < 0.0f;
    if (!faces || !arrives.near_plane(photon.point - at.point)) return;
    const Scattered scattered = scattered_into(c_.scene, at, -photon.travel, SubPath::eye);
    const float cosine = std::abs(glm::dot(at.hit.normal, photon.travel));
    if (is_black(scattered.value) || cosine == 0.0f) return;
    const auto& [forward, reverse] = scattered.densities;
    const double all = all_at_merge(c_.counts, 1.0, photon.behind, forward, eye, reverse);
    add_merged(Technique::surface_merging, each * scattered.value * photon.power / cosine, kernel(distance2),
               1.0 / all);
  };
  count(work_.counters.gather.visited, map.visit_near(at.point, radius, merge));
}

void EyeSubPath::merge_diffuse(const PathVertex& at, const Vec3& side, const Rgb& reflectance) {
  constexpr float kPerPi = 1.0f / kPi;
  const float radius = c_.kernels.surface, to_eye = -glm::dot(side, at.travel) * kPerPi;
  const Arrives arrives{side, kFlatness * radius};
  const Behind eye = at.behind.over(merges_on_surface(c_.counts, at_.only_specular));
  const float others = finite_density(1.0 + eye.sum(c_.counts.weigh(to_eye)));
  const bool squares = c_.counts.heuristic == Heuristic::power;
  MergedTotals totals;
  const auto merge = [&](auto profile) {
    return c_.light.on_surfaces().visit_leaves_near(at.point, [&](const PhotonLeaf& leaf) {
      const AroundPlace near = around(leaf, at.point, arrives, radius);
      if (!any(near.arrived)) return;
      count(work_.counters.gather.used, lanes_in(near.arrived));
      const Floats to_light = max(near.cosine, 0.0f) * kPerPi;
      const Floats back = squares ? to_light * to_light : to_light;
      const Floats share = 1.0f / (others + lanes_of(leaf.adjacent) + back * lanes_of(leaf.further));
      FloatsRgb power{lanes_of(leaf.power_r), lanes_of(leaf.power_g), lanes_of(leaf.power_b)};
      for (Floats& channel : power) channel = select(near.arrived, channel, 0.0f);
      totals.next().add(power, share, near.q, profile);
    });
  };
  count(work_.counters.gather.visited, with_kernel<2>(c_.kernels.surface_kernel, merge));
  const Rgb each = at_.state.throughput * reflectance *
                   (kPerPi * kernel_norm<2>(c_.kernels.surface_kernel, radius) / static_cast<float>(c_.light_paths));
  const Merged merged = totals.of_all().times(each);
  radiance_ += merged.light;
  if (parts_) parts_->add_both(Technique::surface_merging, merged.light.value, merged.unweighted);
}

}  // namespace vpm
