// What a pass stores: a render chooses how much, and how far a gather reaches for it.
#pragma once

#include <optional>
#include <vector>

#include "vpm/integrators/settings.h"
#include "vpm/scene/scene.h"
#include "vpm/tune/choice.h"
#include "vpm/tune/pilot.h"

namespace vpm {

/// Chooses numbers of photons and radii that are to be chosen, and that the settings' integrator has a use for; puts
/// them into the settings; photons, or light sub-paths, by timings of `limit` s at the most each. Where techniques are
/// combined, radii are those that photon maps of as many photons would have.
std::vector<Choice> choose_records(const Scene& scene, const AutomaticSettings& automatic, double limit,
                                   RenderSettings& settings);

/// Gives radii that nothing is said of their defaults, which go by where photons lie: a pure function of scene and
/// settings, also where a time is asked for. Largest radii of gathers by count keep theirs; where techniques are
/// combined, radii are no wider than those that nobody chooses.
std::vector<Choice> choose_default_radii(const Scene& scene, const AutomaticSettings& automatic,
                                         RenderSettings& settings);

/// What choose_records() goes by; nothing where it has nothing to choose. It is the same for all sets of techniques
/// that are combined.
std::optional<MapDensities> densities_for_records(const Scene& scene, const AutomaticSettings& automatic,
                                                  const RenderSettings& settings);
/// The same with densities that are known.
std::vector<Choice> choose_records(const Scene& scene, const AutomaticSettings& automatic,
                                   const std::optional<MapDensities>& densities, double limit,
                                   RenderSettings& settings);

/// Do rays from the eye cross flights, so that they meet more where a pass stores more, whatever radii are chosen?
bool crosses_flights(const RenderSettings& settings);

}  // namespace vpm
