// The vertices of sub-paths, and how light or importance is scattered at them.
#pragma once

#include <optional>

#include "vpm/path/walk.h"

namespace vpm {

/// Which way a sub-path goes: with the light, or against it.
enum class SubPath { light, eye };

/// A part of a path between two vertices.
struct Leg {
  Rgb transmittance{1.0f};
  double distance = 0.0;  // m; 1 for parallel light, which has no falloff by 1/distance^2
  bool crossed = true;    // are flights of photons over it kept for rays to cross?

  double mean() const { return mean_channel(transmittance); }
  double per_square() const { return 1.0 / (distance * distance); }
};

/// A place of a path as densities see it.
struct Junction {
  enum class Kind { surface, medium, free };  // free: a specular vertex, a point, or infinity
  Kind kind = Kind::free;
  Vec3 normal{0.0f};    // of a surface, unit
  Rgb sigma_t{0.0f};    // in a medium, at the place, 1/m
  bool starts = false;  // is the light there that a path begins at?
  double kept = 1.0;    // in a medium: how many photons are stored there for merges, for each that collides
};

/// All techniques that find a path behind a vertex, towards where its sub-path began: the sum of their densities, as
/// the heuristic weighs them.
struct Behind {
  double adjacent = 0.0;  // of connections between the vertex and the one before
  double further = 0.0;   // of all others, over the density of the direction back

  /// The same over `factor`, as the heuristic weighs it.
  Behind over(double factor) const { return {adjacent / factor, further / factor}; }

  /// `back` is the density with which the other sub-path goes on along this one, 1/sr, as the heuristic weighs it.
  double sum(double back) const { return adjacent + back * further; }
};

/// A vertex where a sub-path met a surface, or collided in a medium.
struct PathVertex : Junction {
  Vec3 point{0.0f};           // m
  Vec3 travel{0.0f};          // the direction in which the sub-path arrived, unit
  MediumId medium = kVacuum;  // that it arrived through
  bool on_surface = false;
  bool specular = false;  // scatters into directions that are found by sampling alone
  Hit hit;                // on a surface ...
  Material material;      // ... as light meets it there
  float density = 0.0f;   // in a medium
  Leg leg;                // that led here
  Behind behind;          // over the density of the vertex
  bool straight = false;  // does the light come straight from a light that is sampled?
  bool seen = false;      // does the camera see the vertex, without mirrors or glass in between?
  Rgb power{0.0f};        // with which a sub-path from the light arrives, W, were it the only one

  void set_junction(const Junction& junction) { static_cast<Junction&>(*this) = junction; }
};

/// The densities of a direction in which a sub-path goes on, and with which one that came from there would go back
/// where this one came from, 1/sr: at a specular vertex, 1 and the factor of refraction.
struct Densities {
  double forward = 1.0, reverse = 1.0;
};

/// What a vertex scatters from the direction of arrival into another.
struct Scattered {
  Rgb value{0.0f};  // of power (of a sub-path from the light) or radiance (from the eye), 1/sr: the phase function
                    // times the albedo, or the BSDF times the cosine of the direction
  Densities densities{0.0, 0.0};
};
/// At a vertex that is not specular; black where it scatters nothing into the direction (unit).
Scattered scattered_into(const Scene& scene, const PathVertex& vertex, const Vec3& direction, SubPath way);

/// Draws the direction in which a sub-path goes on from a vertex, and takes its state there. Nothing if it is absorbed.
std::optional<Densities> scatter(const Scene& scene, const PathVertex& vertex, SubPath way, PathState& state, Rng& rng);

/// The density integral of a part of a flight, m: the distance strategy's own, where it knows that.
double integral_along(const Medium& medium, const Track& track, WalkCounters& counters);

/// A ray that leaves the vertex along `direction` (unit), and the medium that it goes through.
PathState leave(const Scene& scene, const PathVertex& vertex, const Vec3& direction);

}  // namespace vpm
