// Which estimators a render of photon maps uses: the one place that knows them all.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "vpm/estimate/surface/estimator.h"
#include "vpm/estimate/volume/estimator.h"
#include "vpm/render/pixel_disc.h"
#include "vpm/render/settings.h"
#include "vpm/scene/scene.h"

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

/// What scatters in a scene, and so needs estimators.
struct Scattering {
  bool media = false;
  bool surfaces = false;  // non-specular ones: mirrors and glass need no map
};
Scattering scattering_of(const Scene& scene);

/// Plans pass number `pass` of a render of photon maps. `discs` are those that earlier passes have left: none before
/// the first pass, and where pixels have no radii of their own. Nothing is traced or built yet, so a plan also serves
/// to ask what a render would do. The path tracer has no estimators.
Estimators plan_estimators(const Scene& scene, const RenderSettings& settings, int pass, const PixelDiscs& discs = {});
/// The same for surfaces alone.
Estimators plan_surface_estimators(const Scene& scene, const RenderSettings& settings, int pass);

/// Throws std::logic_error where two estimators find the same light, so that it would be counted twice.
void check_apart(const std::vector<std::unique_ptr<VolumeEstimator>>& estimators);

/// Does such a render cast shadow rays? The path tracer always does.
bool casts_shadow_rays(const Scattering& scattering, const RenderSettings& settings);

/// The squared radius of the pass's kernels, relative to the first pass. It is that of the first map whose radii depend
/// on the pass number: all of these shrink at nearly the same rate. 1 where there is no such map, 0 without maps.
float relative_square(const std::vector<MapInfo>& maps, int pass);
/// The power of the radius that the maps' bias goes with as radii shrink: the least of their kernels' orders; 0 where
/// none shrinks.
int bias_order(const std::vector<MapInfo>& maps);
/// The sections of the scene file whose maps are used, but do not shrink with the pass number: the bias of their
/// kernels cannot be seen.
std::vector<std::string> maps_of_unseen_bias(const Scene& scene, const RenderSettings& settings);

}  // namespace vpm
