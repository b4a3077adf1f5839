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
      volume;                                 // of light that does not overlap; none where no medium scatters
  std::unique_ptr<SurfaceEstimator> surface;  // null where no surface is rough

  /// All of them.
  std::vector<Estimator*> all() const;
  /// The maps that they gather from; valid as long as the estimators.
  std::vector<MapInfo> maps() const;
  Recorders recorders() const;
};

/// What of a scene scatters, and so asks for estimators.
struct Scattering {
  bool media = false;
  bool surfaces = false;  // rough ones: mirrors and glass need no map
};
Scattering scattering_of(const Scene& scene);

/// Plans pass number `pass` of a render of photon maps, after passes that have left such discs (none: there was none
/// before, or pixels have no radii of their own). Nothing is traced or built yet, so that a plan also serves to ask
/// what a render would do. By the path tracer: none.
Estimators plan_estimators(const Scene& scene, const RenderSettings& settings, int pass, const PixelDiscs& discs = {});
/// The same for surfaces alone.
Estimators plan_surface_estimators(const Scene& scene, const RenderSettings& settings, int pass);

/// Throws std::logic_error where two estimators find the same light, so that it would be counted twice.
void check_apart(const std::vector<std::unique_ptr<VolumeEstimator>>& estimators);

/// Does such a render cast shadow rays? The path tracer always does.
bool casts_shadow_rays(const Scattering& scattering, const RenderSettings& settings);

/// The squared radius of the pass's kernels over that of the first pass, of the first map whose radii go by the number
/// of the pass: all of these shrink at nearly the same rate. 1 where none does, 0 without maps.
float relative_square(const std::vector<MapInfo>& maps, int pass);
/// The sections of the scene file whose maps are used but do not shrink from pass to pass as its number tells: their
/// kernels' bias cannot be seen.
std::vector<std::string> maps_of_unseen_bias(const Scene& scene, const RenderSettings& settings);

}  // namespace vpm
