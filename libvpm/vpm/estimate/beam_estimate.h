// The beam radiance estimate [Jarosz2008beam]: one query finds the photons near a whole segment of a ray. Each photon
// is spread over a disc perpendicular to the ray.
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

/// Transmittances from places on a ray to the eye, channel by channel.
struct Passed {
  float r[PhotonBatch::kMost], g[PhotonBatch::kMost], b[PhotonBatch::kMost];
};

/// Makes the `along` that beam_sum() asks for from a function of one distance: at_distance(t), with t in m along the
/// ray, returns the transmittance as an Rgb.
template <class AtDistance>
auto each_distance(AtDistance&& at_distance) {
  return [at_distance](std::span<const float> distances, Passed& passed) {
    for (size_t i = 0; i < distances.size(); ++i) {
      const Rgb transmittance = at_distance(distances[i]);
      passed.r[i] = transmittance.r;
      passed.g[i] = transmittance.g;
      passed.b[i] = transmittance.b;
    }
  };
}

/// The sum over the photons p whose projection t_p onto the ray lies in the interval:
///   sum_p p(travel_p . towards the eye) Phi_p K_r(perpendicular distance of p from the ray) along(t_p),
/// with K_r over discs of the photon's radius r. Times the albedo, this is radiance in W/(m^2 sr) where
/// `along`(distances, Passed&) finds the transmittances from the eye to the distances t_p. For photons stored for the
/// density at the query, `along` has one more factor: the density there over the medium's largest.
///
/// The bias that is left is that of the kernel across the ray, of order r^2, and that of discs that stick out of the
/// medium.
template <class Along>
Rgb beam_sum(const Phase& phase, const Ray& ray, const Interval& interval, Along&& along, const BeamMap& map,
             GatherCounters& counters) {
  const KernelKind kernel = map.settings.kernel;
  count(counters.searches);
  const auto sum = [&](const auto& p, auto profile) {
    Rgbd sum_of_photons(0.0);
    uint32_t used = 0;
    const auto visit = [&](const PhotonsNearRay& near) {
      const PhotonBatch& batch = near.batch;
      Passed passed;
      along(std::span(near.distance, batch.size()), passed);
      const auto weight = [&](size_t i) {
        const float inverse = 1.0f / (near.radius[i] * near.radius[i]);
        return Rgb(passed.r[i], passed.g[i], passed.b[i]) * (profile(batch.distance2(i) * inverse) * inverse);
      };
      const auto scattered = [&](const Vec3& travel, const Rgb& power) {
        return power * p.value(travel, -ray.direction);
      };
      sum_of_photons += sum_photons(batch, weight, scattered);
      used += batch.number();
    };
    count(counters.visited, map.photons.visit_near_ray(ray, interval, visit));
    counters.used += used;
    return Rgb(sum_of_photons);
  };
  return kernel_norm_2d(kernel, 1.0f) *
         std::visit(
             [&](const auto& p) { return with_kernel<2>(kernel, [&](auto profile) { return sum(p, profile); }); },
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
        with_kernel<2>(list.settings.kernel, [&](auto profile) { return profile(static_cast<float>(q)); });
    sum += Rgbd(photon.power * (weight * along(static_cast<float>(t))));
  }
  return Rgb(sum * double{kernel_norm_2d(list.settings.kernel, radius)} / static_cast<double>(list.emitted));
}

}  // namespace vpm
