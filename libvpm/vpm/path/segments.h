// How a ray passes through boundaries: segment by segment, each of which lies in one medium and is shown to a visitor.
//
// This is the only loop over meet() and cross_boundaries(). Flights to events, shadow rays and paths from the eye all
// use it. A path from the eye gathers light along a segment and adds what the end of the segment emits. It then goes on
// behind a boundary, or scatters at the surface that is returned.
#pragma once

#include <optional>

#include "vpm/path/walk.h"

namespace vpm {

/// Takes a ray from its origin in `medium` through any number of boundaries, for at most `limit` metres, > 0. Returns
/// the surface that ends the ray; nothing if the visitor ended it or no surface was met.
///
/// The visitor has these members. They are looked up at compile time:
///
/// - `bool pass(float length, const Encounter& met)` is called for every segment before its end is dealt with, so that
///   `ray` and `medium` are those of the segment. It is `length` metres long, and ends at what is met: boundaries or a
///   surface; if that is empty, at the limit or nowhere. False ends the ray.
/// - `float left(const Ray& ray)` is optional. It returns how far the ray, which has just passed a boundary, may still
///   go, m. The ray ends if that is not > 0. Without left(), it is the limit less the lengths of the segments. That
///   neglects the small distances by which the ray is moved off boundaries.
template <class Visitor>
std::optional<Hit> each_segment(const Scene& scene, Ray& ray, MediumId& medium, float limit, WalkCounters& counters,
                                Visitor&& visitor) {
  for (;;) {
    const Encounter met = meet(scene, ray, limit, medium, counters);
    const float length = met ? met.hits[0].t : limit;
    if (!visitor.pass(length, met) || !met) return std::nullopt;
    if (!is_boundary(scene.material_of(met.hits[0]))) return met.hits[0];
    cross_boundaries(scene, met, ray, medium, counters);
    if constexpr (requires { visitor.left(ray); }) {
      limit = visitor.left(ray);
      if (!(limit > 0.0f)) return std::nullopt;
    } else {
      limit -= length;
    }
  }
}

}  // namespace vpm
