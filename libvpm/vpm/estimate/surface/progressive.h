// Direct light of surfaces by shadow rays, all other from their photon map, whose radius shrinks from pass to pass.
#pragma once

#include "vpm/estimate/surface/surface_map.h"
#include "vpm/estimate/surface/surface_shadow_rays.h"

namespace vpm {

class Progressive final : public SurfaceEstimator {
 public:
  Progressive(const Scene& scene, const SurfaceMapSettings& settings, SurfaceShadowRays direct)
      : map_(scene, settings, indirect_photon), direct_(std::move(direct)) {}

  std::vector<MapInfo> maps() const override { return {map_.info()}; }
  Recorders recorders() override { return {map_.recorder()}; }
  void build(uint64_t, RenderStatistics& statistics) override { map_.build(statistics); }
  KernelEstimate sent(const SurfaceView& view, EyeWork& work) const override {
    const Rgb direct = direct_.sent(view, work);
    return map_.gather(view, work) + direct;
  }

 private:
  SurfaceMap map_;
  SurfaceShadowRays direct_;
};

}  // namespace vpm
