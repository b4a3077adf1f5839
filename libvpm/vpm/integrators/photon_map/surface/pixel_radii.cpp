// Discs of pixels, and what is found in them.
#include "vpm/integrators/photon_map/surface/pixel_radii.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "vpm/base/counters.h"
#include "vpm/base/settings/setting_error.h"
#include "vpm/estimate/surface_estimate.h"
#include "vpm/integrators/settings.h"

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

KernelEstimate PixelRadii::found_by_rays(const SurfaceView& view, EyeWork& work) const {
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

void check_pixel_radii(const RenderSettings& s) {
  if (s.radii != RadiusSchedule::per_pixel) return;
  const std::string pixels = "where 'radii' of [integrator] are \"per-pixel\" ";
  refuse_if(s.photons.in_cube > 0, "integrator.photons.in_cube",
            pixels + "photons are counted, so that none may be merged", "write 0, or other radii");
  refuse_if(
      s.until.first > 0, "integrator.radii",
      pixels + fmt::format("they follow from all passes before, so that no piece begins with pass {}", s.until.first),
      "write other radii, or render all passes in one run");
  refuse_if(s.surface.mode != GatherMode::radius, "integrator.surface.type", pixels + "surfaces gather by radius",
            "write \"radius\", or other radii");
  refuse_if(kernel_order(s.surface.kernel) > 2, "integrator.surface.kernel",
            pixels + "the rule of radii is for kernels whose bias goes with their square",
            "use another kernel, or write other radii");
  refuse_if(s.indirect.type == IndirectLight::final_gather, "integrator.indirect.type",
            pixels + "there is no final gathering", "take indirect light from \"photons\", or write other radii");
  refuse_if(s.surface.boundary == BoundaryRule::corrected, "integrator.surface.boundary",
            pixels + "the number of photons found sets the radius, so that none may be left out at borders",
            "write \"none\", or other radii");
}

}  // namespace vpm
