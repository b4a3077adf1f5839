// What every pass over the pixels is asked for, whatever estimates the light.
#pragma once

#include <cstdint>

#include "vpm/film/view_layer.h"

namespace vpm {

struct PassSettings {
  uint64_t seed = 1;
  int samples_per_pixel = 1;  // camera rays per pixel and pass, >= 1
  ViewLayerSet layers;        // what pictures hold besides the light
};

}  // namespace vpm
