// Photon beams: the flights of photons, as records.
#pragma once

#include <memory>
#include <vector>

#include "vpm/photon/records.h"

namespace vpm {

/// A flight of a photon through one medium [Jarosz2011].
struct PhotonBeam {
  Vec3 origin{0.0f};     // m
  float length = 0.0f;   // m, > 0: to the collision, or to where the flight, or its ray, leaves the medium
  Vec3 direction{0.0f};  // in which the photon travels, unit
  Rgb power{0.0f};       // of the photon at the origin, W
  // If it is recorded that the flight began at a collision, not at a light or a surface:
  PackedDirection turned_from{};  // the direction before it
  float scattering_rate = 0.0f;   // the scattering coefficient there, the mean of its channels, 1/m; otherwise 0
};
static_assert(sizeof(PhotonBeam) <= 48);

/// Records the flights of photons through scattering media. They do not count towards TraceSettings::stored. A flight
/// that crosses boundaries between media is one record in each.
class BeamRecorder final : public PhotonRecorder {
 public:
  /// What is recorded besides flights: that they would have gone on without a collision; the collisions that they
  /// began at.
  struct More {
    bool long_beams = false, turns = false;
  };
  BeamRecorder(const Scene& scene, PhotonFilter filter, const More& more);

  std::unique_ptr<PhotonRecorder> part() const override {
    return std::make_unique<BeamRecorder>(scene_, filter_, more_);
  }
  void join(PhotonRecorder& part) override;
  RecordNeeds needs() const override { return {.collisions = false, .hits = false}; }
  bool reads_density() const override { return more_.turns; }
  void flew(const Track& track, const ArrivingPhoton& photon, Rng&) override;

  std::vector<std::vector<PhotonBeam>> beams;  // by medium; powers not yet divided by the photons emitted

 private:
  const Scene& scene_;
  PhotonFilter filter_;
  More more_;
};

}  // namespace vpm
