// What photons in media bring to rays that they lie beside, kBlock at a time, in lanes: of many photons beside one ray,
// or of one photon beside many rays.
#pragma once

#include "vpm/estimate/combined/merging_rays.h"
#include "vpm/estimate/combined/shares_of_points.h"

namespace vpm {

/// Photons and rays, a lane for each pair. Lanes of density 0 add nothing.
struct PhotonsBeside {
  FloatsRgb power{};         // MediumPhoton's
  Floats passing{}, sent{};  // likewise, and the next two
  Floats adjacent{}, further{};
  Floats sine{}, determinant{};         // PhotonsBesideRays
  Floats scattered{};                   // the phase function towards the eye, 1/sr
  Floats q{};                           // the squared distance from the ray over that of the radius
  Floats along_ray{}, seen_integral{};  // up to the photon: m from the ray's origin, and of density, m
  Floats density{};                     // of the medium there
};

/// What photons bring to rays in one medium.
template <bool kSquares, class PhaseFunction, class Profile>
class PhotonLight {
 public:
  PhotonLight(const CombinedContext& context, const Medium& medium, const PhaseFunction& phase, Profile profile)
      : shares_(context.counts, mean_channel(medium.sigma_t)),
        phase_(phase),
        profile_(profile),
        medium_(context, medium) {}

  const PhaseFunction& phase() const { return phase_; }

  void add(const MergingRays& rays, const PhotonsBeside& at, LaneMerges& sums) const {
    const Rgb& sigma_t = medium_.sigma_t();
    const FloatsRgb on_ray = attenuated(rays.passed, medium_.extinction(), at.seen_integral);
    FloatsRgb attenuation;
    for (int c = 0; c < 3; ++c) attenuation[c] = sigma_t[c] * on_ray[c];
    const Floats colliding = mean_channel(attenuation) * (1.0f / mean_channel(sigma_t));
    const LaneMask counts = (at.density > 0.0f) & (colliding > 0.0f);
    const Floats density = select(counts, at.density, 1.0f), relative = medium_.relative(density);
    const Floats to_eye = rays.before + at.along_ray;
    const Floats share = shares_.of({.sine = at.sine,
                                     .determinant = at.determinant,
                                     .passing = at.passing,
                                     .sent = at.sent,
                                     .adjacent = at.adjacent,
                                     .further = at.further,
                                     .phase = at.scattered,
                                     .density = density,
                                     .kept = medium_.kept(relative),
                                     .colliding = select(counts, colliding, 1.0f),
                                     .splats = rays.splats * to_eye * to_eye});
    const Floats found = select(counts, relative * at.scattered, 0.0f);
    FloatsRgb light;
    for (int c = 0; c < 3; ++c) light[c] = at.power[c] * on_ray[c] * found;
    sums.add(light, share, at.q, profile_);
  }

 private:
  SharesOfPoints<kSquares> shares_;
  const PhaseFunction& phase_;
  Profile profile_;
  MergingMedium medium_;
};

/// Calls use(PhotonLight) for the medium's phase function, and the kernel and heuristic of the pass.
template <class Use>
auto with_photon_light(const CombinedContext& context, const Medium& medium, Use&& use) {
  return with_types_of_merge<2>(context, medium, [&](const auto& phase, auto profile, auto squares) {
    return use(
        PhotonLight<squares(), std::decay_t<decltype(phase)>, decltype(profile)>(context, medium, phase, profile));
  });
}

/// What all sums along a segment are times.
inline Rgb factor_of_photons(const CombinedContext& context, const RaySegment& segment) {
  return segment.throughput * context.scene.media[segment.medium].albedo() *
         (kernel_norm<2>(context.kernels.volume_kernel, context.kernels.points_2d) /
          static_cast<float>(context.light_paths));
}

}  // namespace vpm
