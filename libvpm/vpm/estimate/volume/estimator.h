// The open set of estimators of the light that media scatter towards the eye: one file each, one virtual call for each
// segment of an eye ray.
#pragma once

#include "vpm/estimate/estimator.h"
#include "vpm/estimate/eye_segment.h"

namespace vpm {

/// A part of the light that media scatter.
struct ScatteredLight {
  bool once = false;  // light that comes straight from a light source
  bool more = false;  // all other light

  bool overlaps(const ScatteredLight& other) const { return (once && other.once) || (more && other.more); }
};

class VolumeEstimator : public Estimator {
 public:
  /// The light that it estimates; all other it leaves to others.
  virtual ScatteredLight finds() const = 0;
  /// Estimates that light, scattered into the segment, as it is seen at the segment's start and times its throughput,
  /// W/(m^2 sr).
  virtual KernelEstimate along(const EyeSegment& segment, EyeWork& work) const = 0;
};

}  // namespace vpm
