// Discs of pixels, and what is found in them.
#include "vpm/integrators/photon_map/surface/pixel_radii.h"

#include <algorithm>
#include <cassert>

#include "vpm/base/counters.h"
#include "vpm/estimate/surface_estimate.h"

namespace vpm {

PixelRadii::PixelRadii(const Scene& scene, const AskedGather& gather, const PassOfMaps& pass, std::vector<float> radii,
                       std::optional<SurfaceShadowRays> direct)
    : radii_(std::move(radii)),
      direct_(std::move(direct)),
      map_(scene, gather, pass, direct_ ? indirect_photon : any_photon),
      found_(radii_.size()) {
  assert(gather.mode == GatherMode::radius && gather.boundary == BoundaryRule::none);
}

void PixelRadii::build(uint64_t, RenderStatistics& statistics) {
  map_.build(statistics);
  statistics.last_surface_radius = *std::max_element(radii_.begin(), radii_.end());
}

KernelEstimate PixelRadii::sent(const SurfaceView& view, EyeWork& work) const {
  GatherCounters& counters = work.counters.gather;
  const Rgb direct = direct_ ? direct_->sent(view, work) : Rgb(0.0f);
  GatherSettings own = map_.map().settings;
  own.radius = radii_[work.pixel];
  count(work.counters.surface_queries);
  const uint64_t before = counters.used;
  const KernelEstimate radiance =
      scattered_radiance(view.material, view.hit, -view.travel, CountedMap{map_.map(), work.gather(), own});
  found_[work.pixel] += counters.used - before;
  return radiance + direct;
}

}  // namespace vpm
