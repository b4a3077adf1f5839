// Direct light: what reaches a point from a light without being scattered, through media and boundaries.
#pragma once

#include "vpm/medium/transmittance/estimator.h"
#include "vpm/path/walk.h"

namespace vpm {

/// The light that one light sends to a point: attenuated by media, black where a surface stands between.
struct DirectSample {
  Vec3 direction{0.0f};  // towards the light, unit
  Rgb irradiance{0.0f};  // on a surface that faces the light, W/m^2. Its mean over samples is the light's
                         // irradiance; a sample is negative where the estimate of transmittance is
  float pdf = 0.0f;      // of the direction, 1/sr; 0 where the light has one direction only
};

/// What shadow rays need, and the counters that they add to.
struct ShadowRays {
  const Scene& scene;
  const TransmittanceEstimator& transmittance;
  Rng& rng;
  WalkCounters& counters;
};

/// Where light is received: at a point within a medium, or on one side of a surface.
struct Receiver {
  Vec3 point{0.0f};           // for a surface: a point just off it (leave_surface())
  MediumId medium = kVacuum;  // at `point`
  Vec3 normal{0.0f};          // unit, to the side whose light counts; zero: light from all directions counts
};

/// Estimates the light that light number `light` sends to the receiver: from the point `from` of that light if it is
/// given (draw_light_point()), else from a point or direction drawn here.
DirectSample sample_direct(const ShadowRays& rays, int light, const Receiver& receiver,
                           const std::optional<LightPoint>& from = std::nullopt);

/// near_side() is the side of the surface on which a path in `medium` that travels along `travel` arrives; far_side()
/// is the other one. Light on the far side reaches the path where the material transmits it.
Receiver near_side(const Hit& hit, const Vec3& travel, MediumId medium);
Receiver far_side(const Scene& scene, const Hit& hit, const Vec3& travel, MediumId medium);

/// The transmittance from the ray's origin, in `medium`, to light number `light` at `distance` (m). It is black where a
/// surface stands between, even if that surface is another part of the same light. Boundaries do not block.
Rgb visibility(const ShadowRays& rays, Ray ray, float distance, int light, MediumId medium);

/// The transmittance from the ray's origin, in `medium`, to a place at `distance` (m, finite), which is on shape number
/// `shape`, or on none (-1). It is black where anything but boundaries stands between.
Rgb visibility_of_place(const ShadowRays& rays, Ray ray, float distance, MediumId medium, int shape = -1);

/// The light that the uniform number `u` picks, with probability Scene::light_probability. The scene must have a light.
struct PickedLight {
  int number = 0;            // in Scene::lights
  float probability = 1.0f;  // of picking it
};
PickedLight pick_light(const Scene& scene, double u);

}  // namespace vpm
