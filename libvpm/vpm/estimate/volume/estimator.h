// The open set of estimators of the light that media scatter towards the eye: one file each, one virtual call for each
// segment of an eye ray.
#pragma once

#include <span>

#include "vpm/estimate/estimator.h"
#include "vpm/estimate/eye_segment.h"

namespace vpm {

/// A part of the light that media scatter.
struct ScatteredLight {
  bool once = false;  // light that comes straight from a light source
  bool more = false;  // all other light

  bool overlaps(const ScatteredLight& other) const { return (once && other.once) || (more && other.more); }
};

/// A segment of one of several rays that lie side by side, and what is found along it.
struct BundledSegment {
  const EyeSegment* segment;
  EyeWork* work;
  KernelEstimate light{};  // W/(m^2 sr)
};
using SegmentBundle = std::span<BundledSegment>;

class VolumeEstimator : public Estimator {
 public:
  /// The light that it estimates; all other it leaves to others.
  virtual ScatteredLight finds() const = 0;
  /// Estimates that light, scattered into the segment, as it is seen at the segment's start and times its throughput,
  /// W/(m^2 sr).
  virtual KernelEstimate along(const EyeSegment& segment, EyeWork& work) const = 0;
  /// Adds the same to the light of up to kEyeRays segments, in one homogeneous medium, of rays that come straight from
  /// `apex`. They may be gathered together: the result is that of along() up to rounding.
  virtual void along_bundle([[maybe_unused]] const Vec3& apex, SegmentBundle bundle) const {
    for (BundledSegment& of : bundle) of.light += along(*of.segment, *of.work);
  }
};

}  // namespace vpm
