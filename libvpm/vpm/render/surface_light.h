// What a rough surface sends towards the eye: direct light, and the rest from the photon maps, straight or by final
// gathering.
//
// Final gathering [Jensen2001, ch. 9] leaves the light that a rough surface scattered last to rays over the hemisphere,
// each of which ends at the next rough surface with the light that all photons there tell of. What the eye sees of the
// map's blur is then an average over many places. Light that mirrors, glass and media led to the surface is too sharp
// for few rays; it comes from the caustic map.
//
// Where a ray is shorter than the radius that the map has there, the blur would show as bright or dark edges: the path
// then goes on as a path tracer's does, with direct light and the caustic map at each rough surface, until a ray is
// long enough, roulette ends it, or its events are used up. Taking the map at the end of the second short ray instead
// is no cheaper, since large radii hold many photons, and is darker: seen in a cube of 2 m of reflectance 0.5, in whose
// corners the map is dark, by 0.5 % against 0.4 % at a radius of 0.1 m, 6.8 % against 6.4 % at 1 m, 22 % against
// nothing at 10 m.
#pragma once

#include "vpm/base/rng.h"
#include "vpm/render/eye_context.h"

namespace vpm {

/// How a pixel gathers from the surface map under Stages::pixel_discs.
struct PixelGather {
  GatherSettings settings;  // in radius mode, of about the map's radius
  uint64_t* found;          // grows by the photons that count, with whatever weight
};

/// A rough surface as a path that travels along `travel` in `medium` meets it.
struct SurfaceView {
  const Hit& hit;
  const Material& material;
  Vec3 travel{0.0f};  // unit
  MediumId medium = kVacuum;
  const PixelGather* own = nullptr;  // of the pixel that looks
};

/// Radiance that leaves against `travel`, W/(m^2 sr), but for what the surface emits. `gather_rays` >= 1.
Rgb surface_light(const EyeContext& context, const SurfaceView& view, int gather_rays, Rng& rng, EyeCounters& counters);

}  // namespace vpm
