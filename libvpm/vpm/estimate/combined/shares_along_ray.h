// The shares of photons that are merged around one ray from the camera.
#pragma once

#include "vpm/estimate/combined/light_sub_paths.h"

namespace vpm {

/// The share of points-2d in what a photon brings to a ray that comes straight from the camera, or over mirrors and
/// glass alone. It is what merges_in_medium() has over all_at_merge(), where all terms are divided by that of the merge
/// itself: the density of the medium then goes out of most of them, and what the ray alone decides is computed once.
class SharesAlongRay {
 public:
  SharesAlongRay(const TechniqueCounts& counts, const Departure& eye)
      : counts_(counts),
        travel_(eye.direction),
        adjacent_(eye.adjacent),
        behind_(eye.behind),
        per_forward_(1.0 / eye.forward),
        crossed_(counts.short_beams > 0.0 || counts.long_beams > 0.0) {}

  /// A place on the ray.
  struct Place {
    double distance = 0.0;  // from the departure, m
    double density = 0.0;   // of the medium, > 0
    double kept = 1.0;      // Junction::kept
    double passed = 1.0;    // the transmittance from the departure, a mean over channels
    double sigma_t = 0.0;   // the same of extinction at density 1 times transmittance, 1/m, > 0
  };
  /// `phase` is that of scattering towards the eye, 1/sr.
  double of(const MediumPhoton& photon, double phase, const Place& at) const {
    const double inverse = 1.0 / (counts_.points_2d * at.kept);
    const double scattered = counts_.weigh(phase);
    double all = 1.0;
    if (counts_.merges_points_3d(true))
      all += counts_.weigh(counts_.points_3d * at.kept * inverse * at.density * at.sigma_t);
    if (crossed_ || counts_.planes > 0.0) all += of_flights(photon, inverse / at.density);
    all += (photon.behind.adjacent + scattered * photon.behind.further) * counts_.weigh(at.sigma_t * inverse);
    const double of_eye = inverse * per_forward_;
    all += counts_.weigh(adjacent_ * at.distance * at.distance * of_eye);
    all += scattered * behind_ * counts_.weigh(at.passed * of_eye);
    return 1.0 / all;
  }

 private:
  double of_flights(const MediumPhoton& photon, double inverse) const {
    const Angles angles = angles_between(photon.travel, photon.turn, travel_);
    return counts_.weigh(counts_.short_beams * angles.sine * photon.arrived.passing * inverse) +
           counts_.weigh(counts_.long_beams * angles.sine * photon.arrived.sent * inverse) +
           counts_.weigh(counts_.planes * angles.determinant * photon.arrived.sent * inverse);
  }

  const TechniqueCounts& counts_;
  Vec3 travel_;         // of the eye's ray, unit
  double adjacent_;     // Departure::adjacent
  double behind_;       // Departure::behind
  double per_forward_;  // sr: 1 over Departure::forward
  bool crossed_;        // are there beams?
};

}  // namespace vpm
