// Photon planes: flights of photons, each with a direction in which its photon might have been scattered from anywhere
// along it.
#pragma once

#include <vector>

#include "vpm/photon/photon_beam.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// The places that a photon comes to if it collides anywhere on its flight and is scattered into one direction
/// [Bitterli2017].
struct PhotonPlane {
  Vec3 origin{0.0f};          // of the flight, m
  float length = 0.0f;        // of the flight, m, > 0
  Vec3 direction{0.0f};       // of the flight, unit
  Vec3 scattered{0.0f};       // the direction after the collision, unit
  Rgb power{0.0f};            // of the photon at the origin, W
  MediumId medium = kVacuum;  // of the flight
};

/// A plane for each flight, by medium, also for those that end at surfaces and for photons that are absorbed: any place
/// on a flight might have been that of the collision. Directions are drawn from the media's phase functions. Powers are
/// multiplied by `scale`.
std::vector<PhotonPlane> planes_of(const std::vector<std::vector<PhotonBeam>>& flights, const Scene& scene, float scale,
                                   Rng& rng);

}  // namespace vpm
