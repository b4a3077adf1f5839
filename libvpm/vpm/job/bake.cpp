// The passes of a light map, in the loop of every render.
#include "vpm/job/bake.h"

#include "vpm/job/validate.h"
#include "vpm/render/photon_blocks.h"

namespace vpm {

RenderResult bake_light_map(const Scene& scene, const RenderSettings& settings, const UvLayout& layout,
                            const RunControl& control) {
  validate_light_map(settings, facts_of(scene));
  const auto make = [&](int pass, const RenderResult&, const PassProgress& shown) {
    return light_map_pass(scene, settings, layout, pass, shown);
  };
  return run_passes(settings.until, {make, light_map_work(layout), block_count(settings)},
                    {Film(layout.resolution, layout.resolution), {}, 0.0, {}}, control);
}

}  // namespace vpm
