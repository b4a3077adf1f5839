// Guided scattering of photons: nine tenths of them scatter as the medium or surface says, one tenth into the
// directions that importance comes from.
#pragma once

#include "vpm/path/walk.h"
#include "vpm/photon/direction_guide.h"

namespace vpm {

/// scatter_in_medium() with guided directions. Directions are drawn from a mixture of the medium's density and the
/// guide's. The power is multiplied by the medium's density over that of the mixture, at most 10 / 9
/// [Veach1997, sec. 9.2.4]. This factor has the mean 1, like Russian roulette. The guide does not change absorption.
bool scatter_in_medium(const DirectionGuide& guide, const Medium& medium, PathState& state, Rng& rng);

/// scatter_at_surface() with guided directions, in the same way; Scatter::weight contains the factor. Specular surfaces
/// are not guided. Russian roulette ignores the guide: otherwise it would end those photons that the guide wants most,
/// whose powers are low because there are many of them.
bool scatter_at_surface(const DirectionGuide& guide, const Scene& scene, const Hit& hit, PathState& state, Rng& rng,
                        Scatter& scatter);

}  // namespace vpm
