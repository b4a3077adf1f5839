// One photon's start, as a function of uniform numbers.
#pragma once

#include "vpm/light/light.h"
#include "vpm/path/walk.h"

namespace vpm {

/// The uniform numbers of an emission and of the choice of its light: a point of a cube of seven dimensions.
struct EmissionPoint {
  static constexpr int kDimensions = 7;
  double light = 0.0;  // picks the light
  EmissionNumbers numbers;

  double operator[](int dimension) const;
  void set(int dimension, double value);
};

/// Uniform over the cube.
EmissionPoint draw_emission_point(Rng& rng);

/// The photon that the numbers yield: a light is chosen by power and emits. Its power is what it stands for if it is
/// the only one; the mean over uniform points is the power of all lights. A photon of a medium may have none, as places
/// are drawn by bounds of what is emitted there.
PathState emit_photon(const Scene& scene, const EmissionPoint& point);

}  // namespace vpm
