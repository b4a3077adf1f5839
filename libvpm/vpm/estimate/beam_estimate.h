// The beam radiance estimate [Jarosz2008beam]: one query finds the photons near a whole segment of a ray. Each photon
// is spread over a disc perpendicular to the ray.
#pragma once

#include <numeric>

#include "vpm/base/exp_negative.h"
#include "vpm/estimate/volume_estimate.h"
#include "vpm/photon/map/segment_map.h"

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

/// transmittance() of a finite density integral, as quick as photons along a ray need it: off by 1e-7 of the optical
/// thickness.
inline Rgb beam_transmittance(const Rgb& sigma_t, float integral) {
  const Rgb optical = sigma_t * integral;
  return {exp_negative(-optical.r), exp_negative(-optical.g), exp_negative(-optical.b)};
}

/// Transmittances from places on a ray to the eye, channel by channel.
struct Passed {
  float r[PhotonBatch::kMost], g[PhotonBatch::kMost], b[PhotonBatch::kMost];
};

/// Makes the `along` that beam_sum() asks for from a function of one distance: at_distance(t), with t in m along the
/// ray, returns the transmittance as an Rgb.
template <class AtDistance>
auto each_distance(AtDistance&& at_distance) {
  return [at_distance](const PhotonsNearRay& near, Passed& passed) {
    for (size_t i = 0; i < near.batch.size(); ++i) {
      const Rgb transmittance = at_distance(near.distance[i]);
      passed.r[i] = transmittance.r;
      passed.g[i] = transmittance.g;
      passed.b[i] = transmittance.b;
    }
  };
}

/// What the photons beside a ray add up to.
struct BeamSum {
  KernelEstimate sum;
  float radius = 0.0f;  // m: of the discs, in the mean over the photons; 0 without any
};

/// The sum over the photons p beside the ray, whose distance along it is t_p:
///   sum_p p(travel_p . towards the eye) Phi_p K_r(perpendicular distance of p from the ray) along(t_p),
/// with K_r over discs of the photon's radius r. Times the albedo, this is radiance in W/(m^2 sr) where
/// `along`(const PhotonsNearRay&, Passed&) finds the transmittances from the eye to the distances t_p. For photons
/// stored for the density at the query, `along` has one more factor: the density there over the medium's largest.
///
/// Where discs lie in the medium as a whole, the bias is that of the kernel across the ray, of order r^2. Discs that
/// stick out of it miss light of order r; SegmentRegion says what makes up for that.
template <class Along>
BeamSum beam_sum(const Phase& phase, const BesideRay& there, Along&& along, const BeamMap& map,
                 GatherCounters& counters) {
  const KernelKind kernel = map.settings.kernel;
  const bool own_radii = map.settings.beam_count > 0;
  count(counters.searches);
  KernelPair<Rgbd> sum;
  double radii = 0.0;  // m
  uint32_t used = 0;
  const auto visit = [&](const PhotonsNearRay& near) {
    const PhotonBatch& batch = near.batch;
    Passed passed;
    along(near, passed);
    sum += with_phase_and_kernel<2>(phase, kernel, [&](const auto& p, auto profile) {
      const auto weight = [&](size_t i) {
        const float inverse = 1.0f / (near.radius[i] * near.radius[i]);
        const KernelPair<float> spread = profile(batch.distance2(i) * inverse) * inverse;
        const Rgb kept(passed.r[i], passed.g[i], passed.b[i]);
        return KernelPair<Rgb>(kept * spread.value, kept * spread.correction);
      };
      return sum_photons(batch, weight, [&](const Vec3& travel, const Rgb& power) {
        return power * p.value(travel, -there.ray.direction);
      });
    });
    used += batch.number();
    if (own_radii) radii += std::accumulate(near.radius, near.radius + batch.number(), 0.0f);
  };
  count(counters.visited, map.photons.visit_near_ray(there, visit));
  counters.used += used;
  const float mean = own_radii ? static_cast<float>(radii / std::max(1u, used)) : map.settings.radius;
  return {normed(sum, kernel_norm_2d(kernel, 1.0f)), used > 0 ? mean : 0.0f};
}

/// The brute-force twin: looks at every photon of a plain list.
template <class Along>
KernelEstimate beam_sum(const Phase& phase, const BesideRay& there, Along&& along, const PhotonList& list) {
  const auto& [ray, interval, within, distances] = there;
  const float radius = list.settings.radius;
  KernelPair<Rgbd> sum;
  for (const Photon& photon : list.photons) {
    const Vec3d offset = Vec3d(photon.position) - Vec3d(ray.origin);
    const double t = glm::dot(offset, Vec3d(ray.direction));
    const Vec3d across = offset - t * Vec3d(ray.direction);
    const double q = glm::dot(across, across) / (double{radius} * radius);
    if (!(q < 1.0 && t >= interval.t0 && t < interval.t1 && within.hold(Vec3(offset)))) continue;
    const KernelPair<float> weight =
        with_kernel<2>(list.settings.kernel, [&](auto profile) { return profile(static_cast<float>(q)); });
    const Rgbd seen(photon.power *
                    (phase_value(phase, photon.travel.unpack(), -ray.direction) * along(distances.of(Vec3(offset)))));
    sum += {seen * double{weight.value}, seen * double{weight.correction}};
  }
  return normed(sum, kernel_norm_2d(list.settings.kernel, radius) / static_cast<float>(list.emitted));
}

}  // namespace vpm
