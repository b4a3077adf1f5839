// Photons in media around whole rays from the camera.
#include "vpm/base/count.h"
#include "vpm/base/exp_negative.h"
#include "vpm/estimate/combined/eye_sub_path.h"
#include "vpm/estimate/combined/shares_along_ray.h"
#include "vpm/photon/stored_power.h"

namespace vpm {
namespace {

/// What photons along a ray add up to: of the kernel and of its correction, with shares, and without them.
struct MergedAlong {
  KernelPair<Rgbd> weighted;
  Rgbd unweighted{0.0};
  uint32_t number = 0;
};

/// exp(-optical), the exponential once for a grey one.
Rgb transmittance_of(const Rgb& optical) {
  const float r = exp_negative(-optical.r);
  if (optical.r == optical.g && optical.g == optical.b) return Rgb(r);
  return {r, exp_negative(-optical.g), exp_negative(-optical.b)};
}

}  // namespace

void EyeSubPath::merge_points_2d(const Along& along, const Interval& interval) {
  const VertexMap<MediumPhoton>& map = c_.light.in_medium(along.medium);
  if (c_.counts.points_2d == 0.0 || map.size() == 0) return;
  const Medium& medium = c_.scene.media[along.medium];
  const float radius = c_.kernels.points_2d, inverse2 = 1.0f / (radius * radius);
  const float per_largest = relative_density(medium, 1.0f);
  const float floor = medium.grid ? floor_in(medium, c_.counts.density_floor) : 0.0f;
  const double before = glm::distance(at_.from.point, along.ray.origin);
  const SharesAlongRay shares(c_.counts, at_.from);
  MergedAlong merged;
  const auto merge_all = [&](const auto& phase, auto profile) {
    return map.visit_near_ray(along.ray, interval, radius, [&](const MediumPhoton& photon, float distance2, float t) {
      const DensityIntegralsAlong::Place place = work_.scratch.integrals.at(t);
      const auto relative = static_cast<float>(place.density) * per_largest;
      const Rgb passed = along.passed * transmittance_of(medium.sigma_t * static_cast<float>(place.integral));
      const double sigma_t = mean_channel(medium.sigma_t * passed);
      if (relative <= 0.0f || sigma_t <= 0.0) return;
      const float scattered = phase.value(photon.travel, -along.ray.direction);
      const SharesAlongRay::Place at{before + double{t}, place.density, double{std::max(1.0f, floor / relative)},
                                     mean_channel(passed), sigma_t};
      const KernelPair<float> spread = profile(distance2 * inverse2);
      const Rgb found = passed * photon.power * (relative * scattered);
      const auto share = static_cast<float>(shares.of(photon, scattered, at));
      merged.weighted += {Rgbd(found * (share * spread.value)), Rgbd(found * (share * spread.correction))};
      if (parts_) merged.unweighted += Rgbd(found * spread.value);
      ++merged.number;
    });
  };
  count(work_.counters.volume_queries);
  count(work_.counters.gather.searches);
  const uint32_t visited = std::visit(
      [&](const auto& phase) {
        return with_kernel<2>(c_.kernels.volume_kernel, [&](auto profile) { return merge_all(phase, profile); });
      },
      medium.phase);
  count(work_.counters.gather.visited, visited);
  count(work_.counters.gather.used, merged.number);
  const Rgb each = at_.state.throughput * medium.albedo() *
                   (kernel_norm<2>(c_.kernels.volume_kernel, radius) / static_cast<float>(c_.light_paths));
  const KernelEstimate all{Rgb(merged.weighted.value) * each, Rgb(merged.weighted.correction) * each};
  radiance_ += all;
  if (parts_) parts_->add_both(Technique::points_2d, all.value, Rgb(merged.unweighted) * each);
}

}  // namespace vpm
