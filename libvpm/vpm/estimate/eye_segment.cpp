// Columns of segments.
#include "vpm/estimate/eye_segment.h"

namespace vpm {

Interval clip(const Ray& ray, const Interval& interval, const Box& box, float margin) {
  double t0 = interval.t0, t1 = interval.t1;
  clip_to_box(Vec3d(ray.origin), Vec3d(ray.direction), Vec3d(box.lo - margin), Vec3d(box.hi + margin), t0, t1);
  return {static_cast<float>(t0), static_cast<float>(t1)};
}

const ColumnsAlong& EyeSegment::columns(EyeWork& work) const {
  ColumnsAlong& columns = work.scratch.columns;
  if (walked_) return columns;
  count(work.counters.walk.lookups, columns.walk(medium(), ray, interval));
  walked_ = true;
  column_ = columns.column();
  return columns;
}

Rgb EyeSegment::transmittance(EyeWork& work) const {
  if (!medium()) return Rgb(1.0f);
  if (!column_) column_ = counted_column(*medium(), ray, interval, work.counters.walk);
  return vpm::transmittance(*medium(), *column_);
}

}  // namespace vpm
