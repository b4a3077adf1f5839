// The photon map of surfaces, as estimators gather from it.
#pragma once

#include "vpm/estimate/pass_map.h"
#include "vpm/estimate/surface/estimator.h"
#include "vpm/photon/records.h"

namespace vpm {

/// The settings of estimators that gather photons of surfaces.
struct SurfaceMapSettings {
  AskedGather gather;
  PassOfMaps pass;
};

/// The surface radiance estimate [Jarosz2008, eq. 7.5, corrected] at a hit, gathered as the settings of the map say,
/// with or without the correction at borders.
Rgb gather_from(const PhotonMap& map, const Scene& scene, const SurfaceView& view, EyeWork& work);

/// Records, sorts and gathers the photons on non-specular surfaces.
class SurfaceMap {
 public:
  /// A map of the photons that the filter takes.
  SurfaceMap(const Scene& scene, const SurfaceMapSettings& settings, PhotonFilter filter,
             HitUse use = HitUse::surface_map)
      : scene_(scene), settings_(settings), hits_(scene, filter, use) {}

  /// The map whose settings are in the section [surface] of the scene file.
  MapInfo info() const {
    const AskedGather& gather = settings_.gather;
    return {"surface",
            2,
            shrinks(gather, settings_.pass),
            nullptr,
            &hits_.photons,
            hits_.emitted_count,
            kernel_order(gather.kernel)};
  }
  PhotonRecorder* recorder() { return &hits_; }
  void build(RenderStatistics& statistics);
  Rgb gather(const SurfaceView& view, EyeWork& work) const { return gather_from(map_, scene_, view, work); }
  const PhotonMap& map() const { return map_; }

 private:
  const Scene& scene_;
  SurfaceMapSettings settings_;
  HitRecorder hits_;
  PhotonMap map_;
};

}  // namespace vpm
