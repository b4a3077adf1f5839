// The volumetric radiance estimate [Jarosz2008, eq. 7.10, corrected], for any photon map.
#pragma once

#include "vpm/estimate/kernel_sum.h"
#include "vpm/medium/phase/phase.h"

namespace vpm {

/// Calls use(phase function, profile of the kernel), each of a type that loops can inline.
template <int Dimension, class Use>
auto with_phase_and_kernel(const Phase& phase, KernelKind kernel, Use&& use) {
  return std::visit(
      [&](const auto& p) { return with_kernel<Dimension>(kernel, [&](auto profile) { return use(p, profile); }); },
      phase);
}

/// volume_sum() of the photons that accept(travel, offset from the point) takes.
template <class Accept, class... Photons>
KernelEstimate volume_sum_of(Accept&& accept, const Phase& phase, const Vec3& point, const Vec3& towards,
                             const Photons&... photons) {
  return std::visit(
      [&](const auto& p) {
        const auto value = [&](const Vec3& travel, const Rgb& power) { return power * p.value(travel, towards); };
        return kernel_sum<3>(photons..., point, accept, value);
      },
      phase);
}

/// sum_p p(travel_p . towards) Phi_p K_r(x - x_p), K_r over 3D balls, W/(m^3 sr). `towards` is the unit direction in
/// which the scattered light leaves (towards the eye). `Photons` are a PhotonMap, or a plain list for the brute-force
/// twin.
///
/// The photons' VolumeForm decides what Phi_p is, and how the source of radiance j at x follows from the sum:
///   density at the photon:  j = albedo sum                   (Phi_p is the power that collided)
///   density at the query:   j = albedo density(x) sum        (Phi_p is that power over the density at x_p)
/// Both densities are relative to the medium's largest.
template <class... Photons>
KernelEstimate volume_sum(const Phase& phase, const Vec3& point, const Vec3& towards, const Photons&... photons) {
  return volume_sum_of(AnyPhoton{}, phase, point, towards, photons...);
}

/// The fluence, W/m^2, from photons stored for the density at the query: sum_p Phi_p K_r / majorant. `majorant` is the
/// medium's, because the densities of these photons are relative to its largest density.
template <class... Photons>
Rgb fluence(const Rgb& majorant, const Vec3& point, const Photons&... photons) {
  const auto power_of = [](const Vec3&, const Rgb& power) { return power; };
  return kernel_sum<3>(photons..., point, AnyPhoton{}, power_of).value / majorant;
}

// Each takes seconds to compile: there is one copy, in points_of_segment.cpp.
extern template KernelEstimate volume_sum(const Phase&, const Vec3&, const Vec3&, const PhotonMap&);
extern template KernelEstimate volume_sum(const Phase&, const Vec3&, const Vec3&, const CountedMap&);
extern template Rgb fluence(const Rgb&, const Vec3&, const PhotonMap&);

}  // namespace vpm
