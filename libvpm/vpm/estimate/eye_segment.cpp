// Density integrals of segments.
#include "vpm/estimate/eye_segment.h"

namespace vpm {

Interval clip(const Ray& ray, const Interval& interval, const Box& box, float margin) {
  double t0 = interval.t0, t1 = interval.t1;
  clip_to_box(Vec3d(ray.origin), Vec3d(ray.direction), Vec3d(box.lo - margin), Vec3d(box.hi + margin), t0, t1);
  return {static_cast<float>(t0), static_cast<float>(t1)};
}

const DensityIntegralsAlong& EyeSegment::integrals(EyeWork& work) const {
  DensityIntegralsAlong& integrals = work.scratch.integrals;
  const EyeSegment*& walked_last = work.scratch.integrals_of;  // others may have walked since
  if (walked_ && walked_last == this) return integrals;
  count(work.counters.walk.lookups, integrals.walk(around(), ray, interval));
  walked_ = true;
  walked_last = this;
  integral_ = integrals.integral();
  return integrals;
}

Rgb EyeSegment::transmittance(EyeWork& work) const {
  if (!around()) return Rgb(1.0f);
  if (!integral_) integral_ = counted_density_integral(*around(), ray, interval, work.counters.walk);
  return vpm::transmittance(*around(), *integral_);
}

}  // namespace vpm
