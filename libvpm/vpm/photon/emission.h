// One photon's start, as a function of uniform numbers.
#pragma once

#include "vpm/path/direct_light.h"

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

/// Of a VolumeLight. Only as many start at a place as its mean emission is of the bound there, so that each stands for
/// as much, but for its colour; and none outside the medium. Others have no power.
PathState emit_from_medium(const Scene& scene, const PickedLight& light, const EmissionNumbers& numbers);

/// The photon that the numbers yield: a light is chosen by power and emits. Its power is what it stands for if it is
/// the only one; the mean over uniform points is the power of all lights. One of a medium may have none.
PathState emit_photon(const Scene& scene, const EmissionPoint& point);

}  // namespace vpm
