// Fresnel's equations: the share of unpolarised light that a smooth surface reflects.
#pragma once

#include "vpm/base/vec.h"

namespace vpm {

/// The indices of refraction, and of k, for which the formulas below stay finite and sound in floats.
inline constexpr double kLeastIndex = 1e-3, kLargestIndex = 1e3;
inline constexpr double kLeastK = 1e-6, kLargestK = 1e6;

/// The cosine on the far side by Snell's law; negative at total internal reflection. In this form eta = 1 is exact, and
/// nothing cancels at grazing incidence.
float cos_transmitted(float cos_incident, float eta);

/// Reflectance of a dielectric for the cosine of incidence in [0, 1] and eta = ior on the far side over ior on the near
/// side; 1 at total internal reflection [Pharr2023, sec. 9.3.5].
float fresnel_dielectric(float cos_incident, float eta);

/// Reflectance of a conductor of index eta + i k (over that on the near side) for the cosine of incidence in [0, 1]
/// [Pharr2023, sec. 9.3.6].
Rgb fresnel_conductor(float cos_incident, const Rgb& eta, const Rgb& k);

}  // namespace vpm
