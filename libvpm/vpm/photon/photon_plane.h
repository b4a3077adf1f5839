// Photon planes: flights of photons, each with a direction in which its photon might have been scattered from anywhere
// along it, as records.
#pragma once

#include <memory>
#include <vector>

#include "vpm/photon/records.h"

namespace vpm {

/// The places that a photon comes to if it collides anywhere on its flight and is scattered into one direction
/// [Bitterli2017].
struct PhotonPlane {
  Vec3 origin{0.0f};     // of the flight, m
  float length = 0.0f;   // of the flight, m, > 0
  Vec3 direction{0.0f};  // of the flight, unit
  Vec3 scattered{0.0f};  // the direction after the collision, unit
  Rgb power{0.0f};       // of the photon at the origin, W
};

/// Records a plane for every flight through a scattering medium, also for those that end at surfaces and for photons
/// that are absorbed: any place on a flight might have been that of the collision. The direction is drawn from the
/// phase function, by the photon's random numbers.
class PlaneRecorder final : public PhotonRecorder {
 public:
  explicit PlaneRecorder(const Scene& scene) : planes(scene.media.size()), scene_(scene) {}

  std::unique_ptr<PhotonRecorder> part() const override { return std::make_unique<PlaneRecorder>(scene_); }
  void join(PhotonRecorder& part) override;
  RecordNeeds needs() const override { return {.collisions = false, .hits = false}; }
  void flew(const Track& track, const ArrivingPhoton& photon, Rng& rng) override;

  std::vector<std::vector<PhotonPlane>> planes;  // by the flight's medium; powers not yet divided by those emitted

 private:
  const Scene& scene_;
};

}  // namespace vpm
