// The loops that gathers spend their time in, one instance of each, with all that they call: tools/check_lanes looks at
// their instructions.
#include "vpm/base/below.h"
#include "vpm/integrators/combined/merge_light.h"
#include "vpm/integrators/combined/merge_photons.h"
#include "vpm/integrators/photon_map/volume/bundle_lanes.h"

namespace vpm {
extern "C" {

using Beside = PhotonBeside<HenyeyGreenstein, KernelProfile<KernelKind::epanechnikov, 2>>;
[[gnu::flatten]] void hot_photons_beside(const Beside& beside, const BundledPhotons& photons, LaneEstimates& sums) {
  for (size_t p = 0; p < photons.size; ++p) beside.add(photons, p, sums);
}

using Across = BeamAcross<HenyeyGreenstein, KernelProfile<KernelKind::epanechnikov, 1>>;
[[gnu::flatten]] void hot_beams_across(const Across& across, const BundledBeams& beams, LaneEstimates& sums) {
  for (size_t p = 0; p < beams.size; ++p) across.add(beams, p, Vec3(0.0f), 0.0f, sums);
}

using Points = PhotonLight<true, HenyeyGreenstein, KernelProfile<KernelKind::epanechnikov, 2>>;
[[gnu::flatten]] void hot_points(const Points& light, const MergingRays& rays, const PhotonsBeside& at,
                                 LaneMerges& sums) {
  light.add(rays, at, sums);
}

using Crossed = CrossingLight<true, HenyeyGreenstein, KernelProfile<KernelKind::epanechnikov, 1>>;
[[gnu::flatten]] void hot_beams(const Crossed& light, const MergingRays& rays, const Crossings& at, LaneMerges& sums) {
  light.add(rays, at, sums);
}

[[gnu::flatten]] void hot_surfaces(const PhotonLeaf& leaf, const Vec3& place, const Arrives& arrives, float radius,
                                   AroundPlace& found) {
  found = around(leaf, place, arrives, radius);
}

[[gnu::flatten]] uint32_t hot_find_near(const PhotonLeaf& leaf, const RayBundle& bundle, float radius,
                                        uint32_t* numbers) {
  return find_near(leaf, bundle, radius, numbers);
}

[[gnu::flatten]] void hot_boxes_of_ray(const BoxTree& boxes, const Ray& ray, uint32_t* found) {
  boxes.visit_leaves(ray, {0.0f, 1.0f}, [&](uint32_t leaf) { *found++ = leaf; });
}

[[gnu::flatten]] void hot_boxes_of_point(const BoxTree& boxes, const Vec3& point, uint32_t* found) {
  boxes.visit_leaves(point, [&](uint32_t leaf) { *found++ = leaf; });
}

[[gnu::flatten]] void hot_boxes_of_bundle(const BoxTree& boxes, const RayBundle& bundle, uint32_t* found) {
  boxes.visit_leaves(bundle, [&](uint32_t leaf) { *found++ = leaf; });
}

[[gnu::flatten]] uint32_t hot_beams_near_point(const PhotonBeamMap& beams, const Vec3& point, BeamPlaces& found) {
  return beams.visit_near(point, [&](const BeamPlaces& some) { found = some; });
}

[[gnu::flatten]] uint32_t hot_append_below(const float* values, float limit, float* found, uint32_t* numbers) {
  return append_below(values, kBlock, limit, 0, found, numbers);
}

[[gnu::flatten]] size_t hot_keep_up_to(float* values, uint32_t* numbers, size_t count, float limit) {
  return keep_up_to(values, numbers, count, limit);
}

[[gnu::flatten]] size_t hot_count_up_to(const float* values, size_t count, float limit) {
  return count_up_to(values, count, limit);
}

}  // extern "C"
}  // namespace vpm
