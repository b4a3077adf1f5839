// How photons scatter that are guided: most of them as media and surfaces would, a tenth of them to where importance
// comes from.
#pragma once

#include "vpm/path/walk.h"
#include "vpm/photon/direction_guide.h"

namespace vpm {

/// scatter_in_medium() with guided directions. They are drawn from a mixture of both densities, and the power is
/// multiplied by the medium's own over the mixture's, at most 10 / 9 [Veach1997, sec. 9.2.4]. That has the mean 1, as
/// roulette has. A photon is absorbed as if it were not guided.
bool scatter_in_medium(const DirectionGuide& guide, const Medium& medium, PathState& state, Rng& rng);

/// scatter_at_surface() with guided directions, in the same way; Scatter::weight tells of it. Mirrors and smooth glass
/// are left alone. The roulette knows nothing of the guide: else it would end the photons that the guide wants most,
/// whose powers are low because they are many.
bool scatter_at_surface(const DirectionGuide& guide, const Scene& scene, const Hit& hit, PathState& state, Rng& rng,
                        Scatter& scatter);

}  // namespace vpm
