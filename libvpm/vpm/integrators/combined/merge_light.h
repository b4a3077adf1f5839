// What beams bring to rays that cross them, and photons in media to rays that they lie beside, kBlock at a time, in
// lanes: of many beams or photons to one ray, or of one to many rays.
#pragma once

#include <algorithm>

#include "vpm/integrators/combined/merge_shares.h"
#include "vpm/integrators/combined/merging_rays.h"

namespace vpm {

/// Crossings of rays and beams, a lane for each. Lanes without one have no power.
struct Crossings {
  FloatsRgb power{}, before{}, back{};       // of the beam, and FlightTerms'
  Floats adjacent{};                         // FlightTerms::adjacent times the squared distance from the last vertex
  Floats scattered{};                        // the phase function towards the eye, 1/sr
  Floats sine = 1.0f;                        // of the angle between the two
  Floats q{};                                // their squared distance over that of the radius
  Floats along_ray{};                        // m from the ray's origin
  Floats seen_integral{}, flown_integral{};  // of density up to the crossing, along the ray and along the beam, m
  Floats density = 1.0f;                     // of the medium, > 0
};

/// What is left of short beams' powers, as analog_weight() has it.
inline FloatsRgb left_of_short(const FloatsRgb& power, const Rgb& sigma_t, const Floats& integral) {
  const float least = std::min(sigma_t.r, std::min(sigma_t.g, sigma_t.b));
  FloatsRgb left;
  Floats sum{}, weighted{};
  for (int c = 0; c < 3; ++c) {
    left[c] = exp_negative((least - sigma_t[c]) * integral);
    sum += abs(power[c]);
    weighted += abs(power[c]) * left[c];
  }
  const Floats factor = select(weighted > 0.0f, sum / weighted, 0.0f);
  for (Floats& channel : left) channel *= factor;
  return left;
}

/// What beams bring to rays in one medium.
template <bool kSquares, class PhaseFunction, class Profile>
class CrossingLight {
 public:
  CrossingLight(const CombinedContext& context, const Medium& medium, const PhaseFunction& phase, Profile profile)
      : shares_(context.counts),
        phase_(phase),
        profile_(profile),
        medium_(context, medium),
        grey_(medium_.extinction().grey()) {}

  const PhaseFunction& phase() const { return phase_; }

  void add(const MergingRays& rays, const Crossings& at, LaneMerges& sums) const {
    const Rgb& sigma_t = medium_.sigma_t();
    const FloatsRgb whole = all_lanes(Rgb(1.0f));
    const FloatsRgb on_beam = attenuated(whole, medium_.extinction(), at.flown_integral);
    const FloatsRgb on_ray = attenuated(rays.passed, medium_.extinction(), at.seen_integral);
    const Floats share = shares_.of(crossed(rays, at, on_beam, on_ray));
    const FloatsRgb left = grey_ ? whole : left_of_short(at.power, sigma_t, at.flown_integral);
    const Floats found = at.density * at.scattered / at.sine;
    FloatsRgb light;
    for (int c = 0; c < 3; ++c) light[c] = at.power[c] * left[c] * on_ray[c] * found;
    sums.add(light, share, at.q, profile_);
  }

 private:
  CrossedBeams crossed(const MergingRays& rays, const Crossings& at, const FloatsRgb& on_beam,
                       const FloatsRgb& on_ray) const {
    const Rgb& sigma_t = medium_.sigma_t();
    FloatsRgb flown, back, colliding, seen;
    for (int c = 0; c < 3; ++c) {
      flown[c] = at.before[c] * on_beam[c];
      back[c] = at.back[c] * flown[c] * at.scattered;
      colliding[c] = sigma_t[c] * at.density * flown[c];
      seen[c] = sigma_t[c] * at.density * on_ray[c];
    }
    const Floats to_eye = rays.before + at.along_ray;
    return {.sine = at.sine,
            .passed = mean_channel(flown),
            .colliding = mean_channel(colliding),
            .seen = mean_channel(seen),
            .kept = medium_.kept(medium_.relative(at.density)),
            .back = back[0] + back[1] + back[2],
            .adjacent = at.adjacent,
            .splats = rays.splats * to_eye * to_eye};
  }

  SharesOfBeams<kSquares> shares_;
  const PhaseFunction& phase_;
  Profile profile_;
  MergingMedium medium_;
  bool grey_;
};

/// Calls use(CrossingLight) for the medium's phase function, and the kernel and heuristic of the pass.
template <class Use>
auto with_crossing_light(const CombinedContext& context, const Medium& medium, Use&& use) {
  return with_types_of_merge<1>(context, medium, [&](const auto& phase, auto profile, auto squares) {
    return use(
        CrossingLight<squares(), std::decay_t<decltype(phase)>, decltype(profile)>(context, medium, phase, profile));
  });
}

/// What all sums along a segment are times.
inline Rgb factor_of(const CombinedContext& context, const MergeSegment& segment) {
  return segment.throughput * context.scene.media[segment.medium].sigma_s *
         kernel_norm<1>(context.kernels.volume_kernel, context.kernels.beams);
}

/// Photons and rays, a lane for each pair. Lanes of density 0 add nothing.
struct PhotonsBeside {
  FloatsRgb power{};  // MergePhoton's
  Floats passing{};   // likewise, and the next two
  Floats adjacent{}, further{};
  Floats sine{};                        // PhotonsBesideRays
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
                                     .passing = at.passing,
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
inline Rgb factor_of_photons(const CombinedContext& context, const MergeSegment& segment) {
  return segment.throughput * context.scene.media[segment.medium].albedo() *
         (kernel_norm<2>(context.kernels.volume_kernel, context.kernels.points_2d) /
          static_cast<float>(context.light_paths));
}

}  // namespace vpm
