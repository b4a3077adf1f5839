// The shares of photons that are merged around one ray from the camera.
#pragma once

#include <algorithm>
#include <cassert>

#include "vpm/estimate/combined/medium_photon.h"

namespace vpm {

/// The share of points-2d in what a photon brings to a ray that comes straight from the camera, or over mirrors and
/// glass alone. It is what merges_in_medium() has over all_at_merge(), where all terms are divided by that of the merge
/// itself: the density of the medium then goes out of most of them, and what the ray alone decides is computed once.
/// `kSquares` says whether the heuristic weighs by squares: a vector loop has no room for a question.
template <bool kSquares>
class SharesAlongRay {
 public:
  /// In a medium of that extinction at density 1, 1/m, a mean over channels, > 0.
  SharesAlongRay(const TechniqueCounts& counts, const Departure& eye, float sigma_t)
      : travel_(eye.direction),
        in_balls_(of_points(counts, counts.merges_points_3d(true) ? counts.points_3d * sigma_t : 0.0)),
        short_beams_(of_points(counts, counts.short_beams)),
        long_beams_(of_points(counts, counts.long_beams)),
        planes_(of_points(counts, counts.planes)),
        adjacent_(of_points(counts, eye.adjacent > 0.0 ? eye.adjacent / eye.forward : 0.0)) {
    assert(eye.behind == 0.0);  // nothing but the camera can be connected to, and not over mirrors or glass
  }

  /// What beams and planes add to all densities, for each photon of a leaf, if the density at it were 1.
  Lanes of_flights(const MediumPhotonLeaf& leaf) const {
    Lanes flights{};
    if (short_beams_ + long_beams_ + planes_ == 0.0f) return flights;
    for (size_t i = 0; i < kBlock; ++i) {
      const float sine = glm::length(glm::cross(leaf.travel(i), travel_));
      const float determinant = std::abs(glm::dot(leaf.turn(i), travel_));
      flights[i] = weigh(short_beams_ * sine * leaf.passing[i]) + weigh(long_beams_ * sine * leaf.sent[i]) +
                   weigh(planes_ * determinant * leaf.sent[i]);
    }
    return flights;
  }

  /// A place on the ray.
  struct Place {
    float distance = 0.0f;  // from the departure, m
    float density = 0.0f;   // of the medium, > 0
    float kept = 1.0f;      // Junction::kept
    float colliding =
        0.0f;  // extinction times transmittance from the departure over extinction, of means over channels
  };
  /// Of a photon with these BehindMerge and of_flights(); `phase` is that of scattering towards the eye, 1/sr.
  float of(float adjacent, float further, float flights, float phase, const Place& at) const {
    const float per_kept = 1.0f / at.kept;
    float all = 1.0f + weigh(in_balls_ * at.density * at.colliding);
    all += weigh(per_kept / at.density) * flights;
    all += (adjacent + weigh(phase) * further) * weigh(at.colliding * per_kept);
    all += weigh(adjacent_ * at.distance * at.distance * per_kept);
    return 1.0f / all;
  }

 private:
  /// Over TechniqueCounts::points_2d. Where it is more than a float holds, no share is left.
  static float of_points(const TechniqueCounts& counts, double x) {
    return static_cast<float>(std::min(x / counts.points_2d, 1e30));
  }
  static float weigh(float x) { return kSquares ? x * x : x; }

  Vec3 travel_;  // of the eye's ray, unit
  float in_balls_, short_beams_, long_beams_, planes_;
  float adjacent_;  // Departure::adjacent over Departure::forward
};

}  // namespace vpm
