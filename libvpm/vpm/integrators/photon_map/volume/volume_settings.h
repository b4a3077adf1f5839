// How the light of media is estimated from photons, as a render asks for it: which estimator, and its settings.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "vpm/estimate/gather.h"
#include "vpm/photon/photon.h"

namespace vpm {

struct VolumeEstimatorInfo;

/// Where photon beams end: where the photon collides; or where its ray leaves the medium.
enum class BeamLength { short_beams, long_beams };

/// What photon planes find of the light that they can find: their share of it, with photon beams, or all.
enum class PlaneUse { combined, alone };

/// The radius is that of the kernel, in the first pass.
struct VolumeSettings : AskedGather {
  /// Points within a radius.
  VolumeSettings() { boundary = BoundaryRule::ends; }
  /// The estimator of that name. Throws std::invalid_argument where there is none.
  explicit VolumeSettings(std::string_view type, const AskedGather& gather = VolumeSettings());

  const std::string& type() const { return type_; }
  /// Chooses the estimator of that name. Throws std::invalid_argument where there is none.
  void choose(std::string_view type);
  const VolumeEstimatorInfo& info() const;

  VolumeForm form = VolumeForm::density_at_query;
  float density_floor = 0.1f;  // density at the query: where it is less, photons are also stored along flights, which
                               // bounds their weights, see CollisionRecorder; in [0, 1]; 0: at collisions alone
  BeamLength length = BeamLength::short_beams;
  uint64_t flights = 0;    // > 0: the most photon beams of a pass, see thin()
  uint64_t planes = 1000;  // the most photon planes of a pass, likewise, >= 1
  PlaneUse share = PlaneUse::combined;

 private:
  std::string type_ = "radius";
};

}  // namespace vpm
