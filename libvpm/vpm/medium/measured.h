// Scattering coefficients measured in real materials, by name.
#pragma once

#include <span>
#include <string_view>

#include "vpm/base/vec.h"

namespace vpm {

/// Coefficients of a material as printed: 1/mm, red, green, blue. Scattering is the REDUCED coefficient sigma_s' = (1 -
/// g) sigma_s: it describes the material together with an isotropic phase function only.
struct MeasuredMedium {
  std::string_view name;
  Vec3d reduced_sigma_s{0.0};  // 1/mm
  Vec3d sigma_a{0.0};          // 1/mm
};

/// The table of [Jensen2001practical, fig. 5], in its order.
std::span<const MeasuredMedium> measured_media();
/// The material of that name; null where there is none.
const MeasuredMedium* find_measured_medium(std::string_view name);

}  // namespace vpm
