// Passes of photons for what is measured with them: as many as are asked for, or as fit into a time.
#pragma once

#include <functional>

#include "vpm/base/clock.h"
#include "vpm/base/progress.h"
#include "vpm/integrators/settings.h"
#include "vpm/photon/ledger.h"
#include "vpm/photon/recorder.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// How passes are run: `until` says passes or seconds on the clock, no error.
struct PhotonRun {
  StopRule until;
  std::shared_ptr<const Clock> clock = std::make_shared<WallClock>();
  ProgressMode progress = ProgressMode::never;
};

struct PhotonPasses {
  int passes = 0;
  Ledger ledger;             // of all passes
  bool interrupted = false;  // given up (base/cancel.h): what was finished before counts
};

/// Throws SettingError where photons fly by another law than transmittance or are guided, so that what they carry on
/// their way is not what light would, and where a pass has no end.
void check_photon_passes(const RenderSettings& settings);

/// Traces passes, each of as many photons as the settings emit, whatever the integrator, into the recorder; after each,
/// take(ledger of the pass, number of passes so far, from 1) reads and clears that. With a time no pass is begun that
/// would end after it if it took as long as the last one; the first is finished.
PhotonPasses run_photon_passes(const Scene& scene, const RenderSettings& settings, const PhotonRun& run,
                               PhotonRecorder& recorder, const std::function<void(const Ledger&, int)>& take);

}  // namespace vpm
