// Radii and the number of photons, scaled to what is estimated to leave less error.
#pragma once

#include <vector>

#include "vpm/integrators/settings.h"
#include "vpm/scene/scene.h"
#include "vpm/tune/choice.h"
#include "vpm/tune/pilot_error.h"

namespace vpm {

/// Factors of what a render chose: of all radii, and of the number of photons or light sub-paths.
struct RecordFactors {
  double radius = 1.0, photons = 1.0;

  bool operator==(const RecordFactors&) const = default;
};

/// What a pilot measures of passes by these factors. It takes about four times `limit` s, or twice where no radius was
/// chosen.
class ScaledPasses {
 public:
  ScaledPasses(const Scene& scene, double limit, const RenderSettings& settings, const std::vector<Choice>& choices);

  /// What the passes show whose factors are 1.
  const PilotError& shown() const { return shown_; }
  double seconds_of_pass(const RecordFactors& factors) const;
  /// The relative MSE after so many passes. `unseen` is what rays do not show of the error of one ray.
  double error_after_passes(double passes, const RecordFactors& factors, double unseen = 0.0) const;
  /// Radii of 0.5 to 2 times those chosen, and, unless passes are counted, a number of photons of 0.5 to 2 times what
  /// was chosen: the factors which are estimated to leave the least error in the render's time. Wider kernels have less
  /// noise and more bias, and take longer; more photons leave less noise of theirs, and less time for rays. They are 1
  /// unless others are estimated to leave clearly less.
  RecordFactors best_factors() const;

 private:
  double passes_of(const RecordFactors& factors) const;
  double error_left(const RecordFactors& factors) const;

  RenderSettings settings_;
  bool scales_radii_, scales_photons_;
  double power_of_noise_;  // as one over the area of discs, or over the width of flights
  double photon_seconds_, gather_seconds_ = 0.0, other_seconds_;  // of a pass; gathering goes with photons within radii
  double stored_;                                                 // photons, of a pass
  PilotError shown_;
  double kernel_noise_ = 0.0, other_noise_;  // of photons: what wider radii lessen, and the rest
  double bias2_;                             // at the factor 1
};

/// Puts scaled radii and numbers into the settings and the choices. No radius becomes wider than those that are chosen.
void scale(const Scene& scene, const RecordFactors& factors, RenderSettings& settings, std::vector<Choice>& choices);

/// Scales what was chosen by the best factors, where a radius was.
void scale_records(const Scene& scene, double limit, RenderSettings& settings, std::vector<Choice>& choices);

}  // namespace vpm
