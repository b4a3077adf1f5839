// How estimators of the light of media are made for a pass, and which settings several of them have.
#pragma once

#include <memory>

#include "vpm/base/settings/setting.h"
#include "vpm/integrators/photon_map/volume/estimator_info.h"
#include "vpm/integrators/photon_map/volume/volume_maps.h"
#include "vpm/integrators/photon_map/volume/volume_settings.h"
#include "vpm/medium/transmittance/estimator.h"

namespace vpm {

/// What estimators of a pass are made of.
struct VolumePlan {
  const Scene& scene;
  VolumeSettings settings;
  MediaPass pass;
  std::shared_ptr<const TransmittanceEstimator> transmittance;
  float max_optical_step;  // of a march
};

/// Describes `type` and the settings of the estimator that it names. `photons_weigh`: do photons weigh 1/density, so
/// that a floor of densities bounds that?
void describe(VolumeSettings& settings, bool photons_weigh, Description& description);
/// Some of these, as others have them, too.
void describe_radius(AskedGather& gather, const char* meaning, Description& description);
void describe_kernel(AskedGather& gather, Description& description);
void describe_density_floor(VolumeSettings& settings, Description& description);
/// Which flights are kept as beams, and how long they are.
void describe_flights(VolumeSettings& settings, Description& description);

/// What all gathers of flights ask of other settings and the scene.
void check_flights(const RenderSettings& settings, const SceneFacts& facts);

/// Likewise of photon beams that rays cross.
void check_photon_beams(const RenderSettings& settings, const SceneFacts& facts);

/// Settings of gathers along rays, for which "corrected" at borders is the same as "ends".
VolumeSettings along_rays(VolumeSettings settings);

}  // namespace vpm
