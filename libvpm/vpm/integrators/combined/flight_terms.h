// What the shares of techniques know of a flight of a light sub-path, wherever on it a ray from the camera crosses it.
#pragma once

#include "vpm/integrators/combined/mis_weights.h"

namespace vpm {

/// How a flight began of which a part, through one medium, is kept. Densities are over that of the flight's direction
/// and over TechniqueCounts::short_beams, so that floats hold them, however large a scene is.
struct FlightTerms {
  Rgb before{1.0f};       // the transmittance of the flight up to the part
  Rgb back{0.0f};         // times the transmittance back to the last vertex, summed over channels, and times the
                          // density of the direction back: all techniques behind that vertex; where the heuristic
                          // squares, the root of their sum
  float adjacent = 0.0f;  // times the squared distance, m^2: how many connections there are over the flight
  float offset = 0.0f;    // from the last vertex to the part, m
  bool parallel = false;  // does light not spread? Then the distance counts as 1
  const Light* round = nullptr;  // a light on a sphere that the flight began on: how densely that is sampled depends on
                                 // the place, and `adjacent` is to be multiplied by that
  Vec3 normal{0.0f};             // there, unit
};

/// Of the part of a flight that begins at `origin`, m, through the transmittance `before`.
FlightTerms flight_terms(const TechniqueCounts& counts, const Departure& from, const Rgb& before, const Vec3& origin);

/// FlightTerms::adjacent of a flight with the direction `travel` (unit) at `place`, `distance` m from its start.
float adjacent_at(const FlightTerms& terms, const Vec3& place, const Vec3& travel, float distance);

}  // namespace vpm
