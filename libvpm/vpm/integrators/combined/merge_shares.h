// The shares of beams that one ray from the camera crosses, or that many do, and of photons that are merged around such
// rays.
#pragma once

#include <algorithm>

#include "vpm/base/floats.h"
#include "vpm/integrators/combined/flight_terms.h"
#include "vpm/integrators/combined/merge_photons.h"

namespace vpm {

/// Crossings of rays and beams, a lane for each.
struct CrossedBeams {
  Floats sine;       // of the angle between them
  Floats passed;     // the transmittance from the flight's last vertex, a mean over channels
  Floats colliding;  // likewise of extinction there times that transmittance, 1/m
  Floats seen;       // of extinction there times the transmittance to the eye, 1/m
  Floats kept;       // Junction::kept
  Floats back;       // FlightTerms::back times the transmittance, summed over channels, and the phase function, 1/sr
  Floats adjacent;   // FlightTerms::adjacent times the squared distance from the last vertex
  Floats splats;     // of the ray's start, MergeSegment::adjacent, times the squared distance from there, over
                     // TechniqueCounts::short_beams
};

/// The share of beams in what they bring to a ray that comes straight from the camera, or over mirrors
/// and glass alone. It is what merges_in_medium() has over all_at_merge(), where all terms are times the densities of
/// coming to the crossing from either side, over those of the flight's and the ray's directions. `kSquares` says
/// whether the heuristic weighs by squares.
template <bool kSquares>
class SharesOfBeams {
 public:
  explicit SharesOfBeams(const TechniqueCounts& counts)
      : points_2d_(over_beams(counts, counts.points_2d)),
        in_balls_(over_beams(counts, counts.merges_points_3d(true) ? counts.points_3d : 0.0)) {}

  Floats of(const CrossedBeams& at) const {
    const Floats beams = weigh(at.sine * at.passed);
    Floats all = beams;
    all += weigh(points_2d_ * at.kept * at.colliding);
    all += weigh(in_balls_ * at.kept * at.colliding * at.seen);
    all += weigh(at.adjacent * at.seen) + weigh(at.back * at.seen);
    all += weigh(at.splats * at.colliding);
    return select(all > 0.0f, beams / all, 0.0f);
  }

 private:
  static float over_beams(const TechniqueCounts& counts, double x) {
    return static_cast<float>(std::min(x / counts.short_beams, 1e30));  // of so much no share is left
  }
  static Floats weigh(const Floats& x) { return kSquares ? x * x : x; }

  float points_2d_, in_balls_;
};

/// Photons and rays, a lane for each pair. What photons have is as it would be where the density is 1.
struct PhotonsBesideRays {
  Floats sine;               // of the angle between the photon's flight and the ray
  Floats passing;            // of the photon's flight, m
  Floats adjacent, further;  // Behind, times behind_scale()
  Floats phase;              // of scattering towards the eye, 1/sr
  Floats density;            // of the medium at the place on the ray, > 0
  Floats kept;               // Junction::kept
  Floats colliding;          // extinction times transmittance to the eye over extinction, of means over channels
  Floats splats;             // MergeSegment::adjacent times the squared distance, over TechniqueCounts::points_2d
};

/// The share of points-2d in what a photon brings to a ray that comes straight from the camera, or over mirrors and
/// glass alone. It is what merges_in_medium() has over all_at_merge(), where all terms are divided by that of the merge
/// itself: the density of the medium then goes out of most of them. `kSquares` says whether the heuristic weighs by
/// squares.
template <bool kSquares>
class SharesOfPoints {
 public:
  /// In a medium of that extinction at density 1, 1/m, a mean over channels, > 0.
  SharesOfPoints(const TechniqueCounts& counts, float sigma_t)
      : in_balls_(of_points(counts, counts.merges_points_3d(true) ? counts.points_3d * sigma_t : 0.0)),
        short_beams_(of_points(counts, counts.short_beams)) {}

  Floats of(const PhotonsBesideRays& at) const {
    const Floats per_kept = 1.0f / at.kept;
    Floats all = 1.0f + weigh(in_balls_ * at.density * at.colliding);
    all += weigh(per_kept / at.density) * weigh(short_beams_ * at.sine * at.passing);
    all += (at.adjacent + weigh(at.phase) * at.further) * weigh(at.colliding * per_kept);
    all += weigh(at.splats * per_kept);
    return 1.0f / all;
  }

 private:
  /// Over TechniqueCounts::points_2d. Where it is more than a float holds, no share is left.
  static float of_points(const TechniqueCounts& counts, double x) {
    return static_cast<float>(std::min(x / counts.points_2d, 1e30));
  }
  static Floats weigh(const Floats& x) { return kSquares ? x * x : x; }

  float in_balls_, short_beams_;
};

}  // namespace vpm
