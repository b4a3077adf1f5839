// Photon beams: the flights of photons, as records.
#pragma once

#include <memory>
#include <vector>

#include "vpm/photon/records.h"

namespace vpm {

/// A flight of a photon through one medium, up to its collision or to where it leaves the medium [Jarosz2011].
struct PhotonBeam {
  Vec3 origin{0.0f};     // m
  float length = 0.0f;   // m, > 0
  Vec3 direction{0.0f};  // in which the photon travels, unit
  Rgb power{0.0f};       // of the photon at the origin, W
};
static_assert(sizeof(PhotonBeam) <= 48);

/// Records the flights of photons through scattering media. A flight that crosses boundaries between media is one
/// record in each.
class BeamRecorder final : public PhotonRecorder {
 public:
  BeamRecorder(const Scene& scene, PhotonFilter filter);

  std::unique_ptr<PhotonRecorder> part() const override { return std::make_unique<BeamRecorder>(scene_, filter_); }
  void join(PhotonRecorder& part) override;
  size_t stored() const override;
  RecordNeeds needs() const override { return {.collisions = false, .hits = false}; }
  void flew(const Track& track, const ArrivingPhoton& photon, Rng&) override;

  std::vector<std::vector<PhotonBeam>> beams;  // by medium; powers not yet divided by the photons emitted

 private:
  const Scene& scene_;
  PhotonFilter filter_;
};

/// Keeps no more than `most` flights, those of all media together; 0: all. They are evenly spaced in the list of all,
/// from a random place on, and take the power of those between them: sums over flights stay what they are in the mean.
void thin_flights(std::vector<std::vector<PhotonBeam>>& by_medium, uint64_t most, Rng& rng);

}  // namespace vpm
