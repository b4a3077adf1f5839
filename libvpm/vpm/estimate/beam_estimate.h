// The beam radiance estimate [Jarosz2008beam]: the photons beside a whole stretch of a ray, in one query, each spread
// over a disc across the ray.
#pragma once

#include <span>

#include "vpm/estimate/kernel_sum.h"
#include "vpm/phase/phase.h"
#include "vpm/photon/segment_map.h"

namespace vpm {

/// Photons sorted for the rays of one pass, powers divided by the photons emitted.
struct BeamMap {
  GatherSettings settings;  // radius > 0, as it is in this pass: the largest
  SegmentMap photons;
};

/// A plain list of photons, for the brute-force twin. Powers are divided by `emitted` here.
struct PhotonList {
  const std::vector<Photon>& photons;
  const GatherSettings& settings;
  uint64_t emitted;
};

/// The share of light that passes from feet on a ray to the eye, channel by channel.
struct Passed {
  float r[PhotonBatch::kMost], g[PhotonBatch::kMost], b[PhotonBatch::kMost];
};

/// What of_foot(distance along the ray, m), an Rgb, says, as beam_sum() asks for it.
template <class OfFoot>
auto each_foot(OfFoot&& of_foot) {
  return [of_foot](std::span<const float> feet, Passed& passed) {
    for (size_t i = 0; i < feet.size(); ++i) {
      const Rgb of_this = of_foot(feet[i]);
      passed.r[i] = of_this.r;
      passed.g[i] = of_this.g;
      passed.b[i] = of_this.b;
    }
  };
}

/// sum_p p(travel_p . towards the eye) Phi_p K_r(distance of p from the ray) along(t_p) over the photons whose foot t_p
/// on the ray lies in the interval, K_r over discs of the photon's radius r; times the albedo, radiance in W/(m^2 sr)
/// where `along`(feet, Passed&) finds the transmittance from the eye to the feet t. With photons stored for the
/// density at the query it has that density as a factor, too, over the medium's largest.
///
/// What is left of bias is that of the kernel across the ray, of order r^2, and that of discs that stick out of the
/// medium.
template <class Along>
Rgb beam_sum(const Phase& phase, const Ray& ray, const Interval& interval, Along&& along, const BeamMap& map,
             GatherCounters& counters) {
  const KernelKind kernel = map.settings.kernel;
  count(counters.searches);
  const auto sum = [&](const auto& p, auto profile) {
    Rgbd sum_of_photons(0.0);
    uint32_t used = 0;
    const auto visit = [&](const PhotonsBeside& beside) {
      const PhotonBatch& batch = beside.batch;
      Passed passed;
      along(std::span(beside.foot, batch.size()), passed);
      const auto weight = [&](size_t i) {
        const float inverse = 1.0f / (beside.radius[i] * beside.radius[i]);
        return Rgb(passed.r[i], passed.g[i], passed.b[i]) * (profile(batch.distance2(i) * inverse) * inverse);
      };
      const auto scattered = [&](const Vec3& travel, const Rgb& power) {
        return power * p.value(travel, -ray.direction);
      };
      sum_of_photons += sum_photons(batch, weight, scattered);
      used += batch.number();
    };
    count(counters.visited, map.photons.visit_beside(ray, interval, visit));
    counters.used += used;
    return Rgb(sum_of_photons);
  };
  return kernel_norm_2d(kernel, 1.0f) *
         std::visit([&](const auto& p) { return with_kernel(kernel, [&](auto profile) { return sum(p, profile); }); },
                    phase);
}

/// The brute-force twin: looks at every photon of a plain list.
template <class Along>
Rgb beam_sum(const Phase& phase, const Ray& ray, const Interval& interval, Along&& along, const PhotonList& list) {
  const float radius = list.settings.radius;
  Rgbd sum(0.0);
  for (const Photon& photon : list.photons) {
    const Vec3d offset = Vec3d(photon.position) - Vec3d(ray.origin);
    const double t = glm::dot(offset, Vec3d(ray.direction));
    const Vec3d across = offset - t * Vec3d(ray.direction);
    const double q = glm::dot(across, across) / (double{radius} * radius);
    if (!(q < 1.0 && t >= interval.t0 && t < interval.t1)) continue;
    const float weight =
        phase_value(phase, photon.travel.unpack(), -ray.direction) *
        with_kernel(list.settings.kernel, [&](auto profile) { return profile(static_cast<float>(q)); });
    sum += Rgbd(photon.power * (weight * along(static_cast<float>(t))));
  }
  return Rgb(sum * double{kernel_norm_2d(list.settings.kernel, radius)} / static_cast<double>(list.emitted));
}

}  // namespace vpm
