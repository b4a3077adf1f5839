// Light counted by detectors, in passes, with standard errors.
#pragma once

#include <string>
#include <vector>

#include "vpm/base/statistics/channel_moments.h"
#include "vpm/job/photon_passes.h"
#include "vpm/photon/detector_recorder.h"

namespace vpm {

/// What one detector counted: power over passes, W, and passages, by Detector::bin_of().
struct DetectorReading {
  Detector detector;
  std::vector<ChannelMoments> power{};
  std::vector<uint64_t> counts{};
  ChannelMoments forward{}, backward{};  // all bins of a side together; of a medium `forward` is what it absorbs
  uint64_t forward_count = 0, backward_count = 0;
};

struct Measurement {
  PhotonPasses run;
  std::vector<DetectorReading> detectors;
  ChannelMoments emitted, absorbed_in_media, absorbed_on_surfaces, escaped, cut;  // W, over passes
};

/// Counts the photons of passes. Throws as check_photon_passes() does, and InputError where there is no detector.
Measurement measure(const Scene& scene, const RenderSettings& settings, const std::vector<Detector>& detectors,
                    const PhotonRun& run);

/// The measurement as JSON: totals and errors of each of the scene's own detectors, which come first, and its cells and
/// angles where it has any.
std::string json_of(const Measurement& measurement, const Scene& scene);

}  // namespace vpm
