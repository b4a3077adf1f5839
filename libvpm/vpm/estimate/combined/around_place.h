// The photons of a leaf around a place on a surface, all at once.
#pragma once

#include "vpm/base/floats.h"
#include "vpm/estimate/combined/surface_photon.h"
#include "vpm/estimate/surface_estimate.h"

namespace vpm {

/// The photons of a leaf around a place on a surface.
struct AroundPlace {
  LaneMask arrived;  // do they arrive within the radius, on that side of the surface?
  Floats q;          // their squared distance over that of the radius
  Floats cosine;     // of their directions to the normal
};
inline AroundPlace around(const SurfacePhotonLeaf& leaf, const Vec3& place, const Arrives& arrives, float radius) {
  const Floats3 offset = Floats3::of(leaf.x, leaf.y, leaf.z) - place;
  const Floats distance2 = dot(offset, offset), height = abs(dot(arrives.normal, offset));
  const Floats3 travel = Floats3::of(leaf.travel_x, leaf.travel_y, leaf.travel_z);
  const Floats cosine = Floats{} - dot(arrives.normal, travel);
  const LaneMask near = distance2 < radius * radius;
  const Floats reached = select(near, distance2, 0.0f);
  return {near & (cosine > 0.0f) & (height <= arrives.thickness + kSlope * sqrt(reached)),
          reached * (1.0f / (radius * radius)), cosine};
}

}  // namespace vpm
