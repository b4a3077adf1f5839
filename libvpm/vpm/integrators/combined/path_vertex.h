// The vertices of sub-paths, and how light or importance is scattered at them.
#pragma once

#include "vpm/path/walk.h"

namespace vpm {

/// A vertex where a sub-path met a surface, or collided in a medium.
struct PathVertex {
  Vec3 point{0.0f};           // m
  Vec3 travel{0.0f};          // the direction in which the sub-path arrived, unit
  MediumId medium = kVacuum;  // that it arrived through
  bool on_surface = false;
  bool specular = false;  // scatters into directions that are found by sampling alone
  Hit hit;                // on a surface ...
  Material material;      // ... as light meets it there
  float density = 0.0f;   // in a medium
};

/// The vertex that a flight has ended at: a surface or a collision.
PathVertex vertex_at(const Scene& scene, const Event& event, const PathState& at);

/// Which way a sub-path goes: with the light, or against it.
enum class SubPath { light, eye };

/// What a vertex scatters from the direction of arrival into another.
struct Scattered {
  Rgb value{0.0f};       // of power (of a sub-path from the light) or radiance (from the eye), 1/sr: the phase function
                         // times the albedo, or the BSDF times the cosine of the direction
  double forward = 0.0;  // the density with which the sub-path goes on there, 1/sr
  double reverse = 0.0;  // with which one that came from there would go back where this one came from, 1/sr
};
/// At a vertex that is not specular; black where it scatters nothing into the direction (unit).
Scattered scattered_into(const Scene& scene, const PathVertex& vertex, const Vec3& direction, SubPath sub_path);

/// The density integral of a part of a flight, m: the distance strategy's own, where it knows that.
double integral_along(const Medium& medium, const Track& track, WalkCounters& counters);

/// Where a ray leaves the vertex along `direction`, and in which medium.
struct Leaving {
  Vec3 origin{0.0f};  // m
  MediumId medium = kVacuum;
};
Leaving leave(const Scene& scene, const PathVertex& vertex, const Vec3& direction);

}  // namespace vpm
