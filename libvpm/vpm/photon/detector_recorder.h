// Power that passes detectors, by all photons as they fly and collide.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "vpm/photon/recorder.h"
#include "vpm/scene/detector.h"

namespace vpm {

/// What a part of a detector counts.
struct Counted {
  Rgbd power{0.0};     // W
  uint64_t count = 0;  // of passages, or of collisions
};

/// Counts for each bin of each detector. Flights must be drawn from the media's own transmittance: where a medium is
/// chromatic, the power at a place on a flight is that which it would have there.
class DetectorRecorder final : public PhotonRecorder {
 public:
  DetectorRecorder(const Scene& scene, const std::vector<Detector>& detectors);

  std::unique_ptr<PhotonRecorder> part() const override;
  void join(PhotonRecorder& part) override;
  RecordNeeds needs() const override;
  void travelled(const ArrivingPhoton& photon, const std::vector<Track>& tracks) override;
  void collided(const ArrivingPhoton& photon) override;

  /// By detector and bin.
  const std::vector<std::vector<Counted>>& counted() const { return counted_; }
  void clear();

 private:
  const Scene& scene_;
  const std::vector<Detector>& detectors_;
  bool chromatic_, surfaces_ = false, media_ = false;  // are there such?
  std::vector<std::vector<Counted>> counted_;
};

}  // namespace vpm
