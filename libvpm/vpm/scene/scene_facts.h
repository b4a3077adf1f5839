// What a scene has that integrators ask for: which of its media and surfaces take part.
#pragma once

#include "vpm/scene/scene.h"

namespace vpm {

struct SceneFacts {
  bool grids = false;             // media of grids
  bool scattering_media = false;  // media that scatter
  bool emitting_media = false;    // media that emit
  bool rough_surfaces = false;    // surfaces that store photons; mirrors and glass do not
  bool endless = false;           // the medium of the world, which scatters ...
  bool endless_flights = false;   // ... and does not attenuate one of the channels
  bool cyclic = false;            // it repeats itself; of a finished scene

  void add(const Medium& medium);
  /// The medium of the world, once it is added as one of all.
  void add_world(const Medium& medium);
};
SceneFacts facts_of(const Scene& scene);

}  // namespace vpm
