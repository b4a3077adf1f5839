// Airlight: what an infinite homogeneous medium lit by a point source sends towards the eye after one scattering.
#pragma once

#include <cstdint>

#include "vpm/base/statistics/moments.h"
#include "vpm/integrators/settings.h"
#include "vpm/study/estimates/photon_rays.h"

namespace vpm {

/// The eye looks along a ray from t = 0. The projection of the light onto the ray is t_light, its perpendicular
/// distance is `distance`; it sends out 1 W/sr. Scattering counts between t0 and t1, attenuation from the eye on.
struct Airlight {
  double sigma_t = 1.0;  // 1/m
  double albedo = 1.0;
  double g = 0.0;                        // of Henyey and Greenstein's phase function
  double distance = 1.0, t_light = 0.0;  // m
  double t0 = 0.0, t1 = 0.0;             // m; t1 may be infinite
};

/// Radiance times 10^-log10_scale, W/(m^2 sr): a radiance far below what floats can hold is estimated by the logarithms
/// of transmittances. The ray is marched in segments that grow away from the light; a sample is a march over all of
/// them.
Moments estimate_airlight(const Airlight& airlight, double log10_scale, uint64_t samples, uint64_t seed);

/// Radiance over all of an endless ray (t0 = 0, t1 infinite) as a render's eye path finds it, by shadow rays from its
/// steps or equiangularly, W/(m^2 sr).
Moments estimate_airlight_by_eye_path(const Airlight& airlight, DirectLight direct, uint64_t samples, uint64_t seed);

/// The same by photons that fly once. Light is seen alike along all rays that pass it alike: a pass is seen along many,
/// turned at random about the light.
RadianceByPhotons estimate_airlight_by_photons(const Airlight& airlight, const PhotonRays& by);

/// A collimated beam of light, of an irradiance of 1 W/m^2, in an infinite homogeneous medium. A ray of sight meets its
/// axis.
struct BeamAirlight {
  double sigma_t = 1.0;  // 1/m
  double albedo = 1.0;
  double g = 0.0;            // of Henyey and Greenstein's phase function
  double beam_radius = 1.0;  // m
  double cosine = 0.0;       // between the directions in which light and the ray of sight travel
  double flown = 1.0;        // m, from the light along the axis to where the ray meets it
  double seen = 1.0;         // m, from the eye to there: both so long that light and eye are outside of what is seen
};

/// The radiance over all of the ray by photons that fly once, along rays that are turned at random about the beam's
/// axis, W/(m^2 sr).
RadianceByPhotons estimate_beam_airlight_by_photons(const BeamAirlight& airlight, const PhotonRays& by);

}  // namespace vpm
