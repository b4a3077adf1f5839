// How a ray goes on through boundaries: stretch by stretch, each of them in one medium and shown to a visitor.
//
// The one loop over meet() and cross_boundaries(), for flights to events, shadow rays, and paths from the eye: these
// gather along a stretch, then see what shines at its end, and go on behind it or scatter at the surface that is
// returned.
#pragma once

#include <optional>

#include "vpm/path/walk.h"

namespace vpm {

/// What lies between the ray's origin and what it meets first.
struct Stretch {
  float length = kInfinity;  // m, to what ends it
  const Encounter& met;      // what ends it, at a boundary or a surface; nothing: the limit, or the end of the scene
};

/// Takes a ray from its origin in `medium` through any number of boundaries, at most `limit` metres, > 0. Returns the
/// surface that ends it; nothing where the visitor did, or nothing was met.
///
/// The visitor has, found when the program is compiled,
///
/// - `bool pass(const Stretch& stretch)`, at every stretch, before anything is done about its end: `ray` and `medium`
///   are those of the stretch. False ends the ray.
/// - `float left(const Ray& ray)`, if it has it: how far the ray, which has just passed a boundary, may still go, m; it
///   ends where that is not > 0. Without it, the limit less the stretches' lengths, which leaves out by how little the
///   ray is moved off boundaries.
template <class Visitor>
std::optional<Hit> each_stretch(const Scene& scene, Ray& ray, MediumId& medium, float limit, WalkCounters& counters,
                                Visitor&& visitor) {
  for (;;) {
    const Encounter met = meet(scene, ray, limit, medium, counters);
    const Stretch stretch{met ? met.hits[0].t : limit, met};
    if (!visitor.pass(stretch) || !met) return std::nullopt;
    if (!is_boundary(scene.material_of(met.hits[0]))) return met.hits[0];
    cross_boundaries(scene, met, ray, medium, counters);
    if constexpr (requires { visitor.left(ray); }) {
      limit = visitor.left(ray);
      if (!(limit > 0.0f)) return std::nullopt;
    } else {
      limit -= stretch.length;
    }
  }
}

}  // namespace vpm
