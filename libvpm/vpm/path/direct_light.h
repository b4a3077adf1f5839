// Light that reaches a point straight from a source, through media and boundaries.
#pragma once

#include "vpm/medium/transmittance/estimator.h"
#include "vpm/path/walk.h"

namespace vpm {

/// The light of a source at a point: attenuated by media, black where something stands between.
struct DirectSample {
  Vec3 direction{0.0f};  // towards the light, unit
  Rgb irradiance{0.0f};  // on a surface that faces it, W/m^2; its mean over samples is that of the source. Below 0
                         // where the estimator of transmittance was
  float pdf = 0.0f;      // of the direction, 1/sr; 0 where the light has one direction only
};

/// What shadow rays go by, and what they count.
struct ShadowRays {
  const Scene& scene;
  const TransmittanceEstimator& transmittance;
  Rng& rng;
  WalkCounters& counters;
};

/// Where light is asked for: at a point within a medium, or on one side of a surface.
struct Receiver {
  Vec3 point{0.0f};           // at a surface: just off it (leave_surface())
  MediumId medium = kVacuum;  // there
  Vec3 normal{0.0f};          // unit, to the side whose light counts; zero: light from everywhere
};

/// Estimates what light number `light` sends to the receiver: from that point of it, where one was drawn before.
DirectSample sample_direct(const ShadowRays& rays, int light, const Receiver& receiver,
                           const std::optional<LightPoint>& from = std::nullopt);

/// The side on which a path in `medium` meets the surface along `travel`; and the other one, from which light reaches
/// the path's side where the material scatters it through.
Receiver near_side(const Hit& hit, const Vec3& travel, MediumId medium);
Receiver far_side(const Scene& scene, const Hit& hit, const Vec3& travel, MediumId medium);

/// The transmittance from the ray's origin, in `medium`, to light number `light` at `distance`: black where a surface
/// stands between that is no boundary, be it another part of the light's own.
Rgb visibility(const ShadowRays& rays, Ray ray, float distance, int light, MediumId medium);

/// The light that a uniform number picks, by power (Scene::light_probability). The scene has a light.
struct PickedLight {
  int number = 0;            // in Scene::lights
  float probability = 1.0f;  // that it is picked
};
PickedLight pick_light(const Scene& scene, double u);

}  // namespace vpm
