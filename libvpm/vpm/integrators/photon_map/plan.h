// Which estimators a render of photon maps uses: the one place that knows them all.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "vpm/estimate/photon_map.h"
#include "vpm/film/pixel_disc.h"
#include "vpm/integrators/photon_map/estimator.h"
#include "vpm/integrators/settings.h"
#include "vpm/scene/scene_facts.h"

namespace vpm {

/// The estimators of one pass. Immutable while rays run.
struct Estimators {
  std::vector<std::unique_ptr<VolumeEstimator>>
      volume;                                 // no two of them estimate the same light; none where no medium scatters
  std::unique_ptr<SurfaceEstimator> surface;  // null where there is no non-specular surface

  /// All of them.
  std::vector<Estimator*> all() const;
  /// The maps that they gather from; valid as long as the estimators.
  std::vector<MapInfo> maps() const;
  Recorders recorders() const;
};

/// Plans pass number `pass` of a render of photon maps. `discs` are those that earlier passes have left: none before
/// the first pass, and where pixels have no radii of their own. `around`, which outlives the plan: see PassOfMaps.
/// Nothing is traced or built yet, so a plan also serves to ask what a render would do. Only a render of photon maps
/// has estimators.
Estimators plan_estimators(const Scene& scene, const RenderSettings& settings, int pass, const PixelDiscs& discs = {},
                           const MediaBounds* around = nullptr);
/// The same for surfaces alone.
Estimators plan_surface_estimators(const Scene& scene, const RenderSettings& settings, int pass);

/// Throws std::logic_error where two estimators find the same light, so that it would be counted twice.
void check_apart(const std::vector<std::unique_ptr<VolumeEstimator>>& estimators);

/// Does such a render cast shadow rays?
bool casts_shadow_rays(const SceneFacts& facts, const RenderSettings& settings);

/// The sections of the scene file whose maps are used, but give no correction of their kernels: their bias
/// cannot be seen.
std::vector<std::string> maps_of_unseen_bias(const Scene& scene, const RenderSettings& settings);

}  // namespace vpm
