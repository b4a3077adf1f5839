// A part of a ray.
#pragma once

#include "vpm/scene/scene.h"

namespace vpm {

/// A part of a ray that lies in one medium.
struct Segment {
  Ray ray;
  Interval interval;  // m from the ray's origin
  MediumId medium = kVacuum;
  Rgb throughput{1.0f};  // of the path at the start of the interval
};

}  // namespace vpm
