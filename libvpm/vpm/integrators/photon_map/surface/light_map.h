// Light maps: the irradiance on a mesh or a quad, texel by texel of its texture coordinates, from photon maps and
// shadow rays.
#pragma once

#include "vpm/film/pass.h"
#include "vpm/integrators/photon_map/surface/uv_layout.h"
#include "vpm/integrators/settings.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// Lays out the light map of a shape. Throws InputError, which names no shape, as lay_out() does, and where the shape's
/// material stores no photons.
UvLayout lay_out_light_map(const Scene& scene, uint32_t shape, int resolution);

/// One pass with photon maps: a pure function of its arguments, on any number of threads; by blocks of photons where
/// the settings say so (mean_of_blocks()). Texels have no radii of their own: `settings.radii` is another. Its image
/// holds the mean irradiance, W/m^2, on the side of the outward normal, over what each texel shows of the surface, by
/// samples_per_pixel points uniform over its area; black where that is nothing. Cosines are to the geometric normal:
/// irradiance times area is the power that arrives.
Pass light_map_pass(const Scene& scene, const RenderSettings& settings, const UvLayout& layout, int pass,
                    const PassProgress& progress = {});
/// The units of work of a pass, or of a block of it, by which it advances PassProgress::tiles.
uint64_t light_map_work(const UvLayout& layout);

}  // namespace vpm
