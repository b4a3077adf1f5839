// A segment of an eye ray between two events or boundaries.
#pragma once

#include <optional>

#include "vpm/base/counters.h"
#include "vpm/estimate/eye_work.h"
#include "vpm/path/segment.h"

namespace vpm {

/// The part of the interval in which the ray is inside the box grown by `margin`, m.
Interval clip(const Ray& ray, const Interval& interval, const Box& box, float margin);

/// The density integral of the medium over an interval of a ray, m.
inline double counted_density_integral(const Medium& medium, const Ray& ray, const Interval& interval,
                                       WalkCounters& counters) {
  const DensityIntegral crossed = density_integral(medium, ray, interval);
  count(counters.lookups, crossed.lookups);
  return crossed.value;
}

/// What a segment begins and ends at: the normals of the surfaces or boundaries there, unit, to the side of the
/// segment. 0 where there is none: at the camera, and at the end of a ray that meets nothing.
struct Borders {
  Vec3 start{0.0f}, end{0.0f};
};

/// Its density integrals, counted from its start, are computed once, however many estimators ask for them.
class EyeSegment : public Segment {
 public:
  EyeSegment(const Scene& scene_of_ray, const Segment& segment, const Borders& at)
      : Segment(segment), scene(scene_of_ray), borders(at) {}

  /// The medium around it; null in vacuum.
  const Medium* around() const { return medium == kVacuum ? nullptr : &scene.media[medium]; }
  /// The density integrals at all places of the segment.
  const DensityIntegralsAlong& integrals(EyeWork& work) const;
  /// Takes the density integral of the whole segment, m, from an estimator that has walked along it by itself.
  void set_integral(double integral) const { integral_ = integral; }
  /// The transmittance of the whole segment.
  Rgb transmittance(EyeWork& work) const;

  const Scene& scene;
  const Borders borders;

 private:
  mutable bool walked_ = false;             // by integrals(), if EyeScratch has them still
  mutable std::optional<double> integral_;  // m
};

}  // namespace vpm
