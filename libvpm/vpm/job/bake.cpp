// The passes of a light map, in the loop of every render.
#include "vpm/job/bake.h"

#include "vpm/integrators/photon_map/photon_blocks.h"
#include "vpm/integrators/render_scene.h"

namespace vpm {

LightMap bake_light_map(const Scene& scene, const RenderSettings& settings, const UvLayout& layout,
                        const RunControl& control) {
  validate_light_map(settings, facts_of(scene));
  ChannelMoments power;
  const auto make = [&](int number, const RenderResult&, const PassProgress& shown) {
    Pass pass = light_map_pass(scene, settings, layout, number, shown);
    power.add(received_power(layout, pass.image));
    return pass;
  };
  RenderResult render = run_passes(settings.until, {make, light_map_work(layout), block_count(settings)},
                                   {Film(layout.resolution, layout.resolution), {}, 0.0, {}}, control);
  return {std::move(render), power};
}

}  // namespace vpm
