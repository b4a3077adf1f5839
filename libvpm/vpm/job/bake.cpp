// The passes of a light map, in the loop of every render.
#include "vpm/job/bake.h"

#include "vpm/job/validate.h"

namespace vpm {

RenderResult bake_light_map(const Scene& scene, const RenderSettings& settings, const UvLayout& layout,
                            const RunControl& control) {
  validate_light_map(settings, facts_of(scene));
  const auto make = [&](const RenderResult& so_far, const PassProgress& shown) {
    return light_map_pass(scene, settings, layout, so_far.film.next_pass(), control.stop, shown);
  };
  return run_passes(settings.until, {make, light_map_work(layout)},
                    {Film(layout.resolution, layout.resolution), {}, 0.0, {}}, control);
}

}  // namespace vpm
