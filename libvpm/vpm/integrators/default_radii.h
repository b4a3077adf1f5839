// Gather radii by where photons lie: what a render has whose settings give none.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vpm/integrators/choice.h"
#include "vpm/integrators/photon_density.h"
#include "vpm/integrators/settings.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// No wider than so much of the scene's diagonal, as wider kernels blur it; in media no more than so much of their
/// thickness.
inline constexpr double kLargestRadius = 0.05, kShareOfMedium = 0.1;

struct ChosenRadius {
  float radius = 0.0f;  // m, of three digits
  std::string reason;
};
/// The radius within which kPhotonsWithin of `emitted` photons or of their flights lie, but no less than half a pixel,
/// as finer kernels show as noise. These bounds go before that: in media no more than kShareOfMedium of their thickness
/// and than the mean free path, as wider ones take in photons that have little to do with the place, unless less than
/// kLeastWithin were within; and no more than kLargestRadius of `diagonal` (m).
ChosenRadius choose_radius(const MapDensity& density, double emitted, double diagonal);
inline constexpr double kPhotonsWithin = 50.0, kLeastWithin = 10.0;

/// A positive value of so many decimal digits: enough for a choice, and short to write down.
double rounded(double value, int digits);

/// What open radii go by, from a pilot of so many photons; nothing where neither a radius nor a number of photons is to
/// be chosen.
std::optional<MapDensities> densities_for_radii(uint64_t photons, const Scene& scene,
                                                const AutomaticSettings& automatic, const RenderSettings& settings);
/// Gives the radii that are to be chosen, of maps that the render has, what these densities say for its number of
/// photons. Where techniques are combined, they are those that photon maps would have, but no wider than those that
/// nobody chooses.
std::vector<Choice> choose_radii(const Scene& scene, const AutomaticSettings& automatic, const MapDensities& densities,
                                 RenderSettings& settings);

/// The same by a small pilot of its own: a pure function of scene and settings, also where a time is asked for.
std::vector<Choice> choose_default_radii(const Scene& scene, const AutomaticSettings& automatic,
                                         RenderSettings& settings);

/// Puts chosen radii times a factor into the settings.
void scale_radii(const std::vector<Choice>& radii, double factor, RenderSettings& settings);
/// How many times as wide all of these may be, >= 1: up to kLargestRadius of the scene.
double widest_factor(const std::vector<Choice>& radii, const Scene& scene, RenderSettings settings);

}  // namespace vpm
