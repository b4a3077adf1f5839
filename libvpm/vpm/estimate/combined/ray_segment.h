// A part of a ray in a medium, along which light sub-paths are merged.
#pragma once

#include "vpm/scene/scene.h"

namespace vpm {

/// Of a ray that comes straight from the camera, or over mirrors and glass alone, in a medium that scatters.
struct RaySegment {
  Ray ray;
  Interval interval;  // the part, m from the ray's origin
  MediumId medium = kVacuum;
  Rgb passed{1.0f};       // the transmittance from the last vertex to the ray's origin
  float before = 0.0f;    // from that vertex to there, m
  double adjacent = 0.0;  // Departure::adjacent over Departure::forward of the vertex
  Rgb throughput{1.0f};   // of what is found
  size_t number = 0;      // of the ray among those that are followed together
};

}  // namespace vpm
