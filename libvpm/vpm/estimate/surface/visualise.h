// All light of surfaces from their photon map, seen straight: what the map holds is what is seen.
#pragma once

#include "vpm/estimate/surface/surface_map.h"

namespace vpm {

class Visualise final : public SurfaceEstimator {
 public:
  Visualise(const Scene& scene, const SurfaceMapSettings& settings) : map_(scene, settings, any_photon) {}

  std::vector<MapInfo> maps() const override { return {map_.info()}; }
  Recorders recorders() override { return {map_.recorder()}; }
  void build(uint64_t, RenderStatistics& statistics) override { map_.build(statistics); }
  KernelEstimate sent(const SurfaceView& view, EyeWork& work) const override { return map_.gather(view, work); }

 private:
  SurfaceMap map_;
};

}  // namespace vpm
