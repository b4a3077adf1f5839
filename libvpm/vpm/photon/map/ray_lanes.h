// Rays of a bundle, a lane for each: what is searched for is taken to all of them at once.
#pragma once

#include <limits>

#include "vpm/base/floats.h"
#include "vpm/photon/map/photon_beam_map.h"

namespace vpm {

/// Up to kBlock rays. Lanes that no ray is in meet nothing.
struct RayLanes {
  /// `interval` is the part of the ray that perpendiculars may stand on, m from its origin.
  void set(size_t lane, const Ray& ray, const Interval& interval, const Vec3& apex) {
    Vec3 to_right, upwards;
    make_frame(ray.direction, to_right, upwards);
    from.set(lane, ray.origin - apex);
    along.set(lane, ray.direction);
    towards_eye.set(lane, -ray.direction);
    right.set(lane, to_right);
    up.set(lane, upwards);
    t0.set(lane, interval.t0);
    t1.set(lane, interval.t1);
  }

  Floats3 from;                // origins, m from the bundle's apex
  Floats3 along, towards_eye;  // directions, unit
  Floats3 right, up;           // two across each
  Floats t0{}, t1 = -1.0f;     // the parts of them, m
};

/// Where rays cross a piece of a beam.
struct CrossingLanes {
  Floats3 places;    // of the beam, from the rays' origins, m
  Floats s;          // of these places along the beam, m from its origin
  Floats distance2;  // of the two lines, m^2
  Floats sine2;      // the square of the sine of the angle between them
  LaneMask met;      // -1 where they cross within the radius, else 0
};
/// Piece number `p`, as PhotonBeamMap::visit_crossings() would cross it with each ray.
inline CrossingLanes cross(const BundledBeams& beams, size_t p, const RayLanes& rays, float radius) {
  const Vec3 direction(beams.dx[p], beams.dy[p], beams.dz[p]);
  const float half = beams.half[p];
  // Both lines as seen along the ray.
  const Floats3 middle = Vec3(beams.x[p], beams.y[p], beams.z[p]) - rays.from;
  const Floats a = dot(middle, rays.right), b = dot(middle, rays.up);
  const Floats da = dot(direction, rays.right), db = dot(direction, rays.up);
  const Floats sine2 = da * da + db * db, across = a * db - b * da;
  const Floats per_sine2 = 1.0f / max(sine2, std::numeric_limits<float>::min());
  const Floats s = Floats{} - (a * da + b * db) * per_sine2;  // along the beam from the middle, m
  CrossingLanes crossing{middle + s * direction, s + beams.s[p], across * across * per_sine2, sine2, {}};
  const Floats t = dot(crossing.places, rays.along);
  crossing.met = (crossing.distance2 < radius * radius) & (s >= -half) & (s < half) & (t >= rays.t0) & (t < rays.t1) &
                 (sine2 > 0.0f);
  return crossing;
}

}  // namespace vpm
