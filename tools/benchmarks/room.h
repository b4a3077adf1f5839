// A room full of fog as a pass of photon beams sees it: the flights of photons, and the rays of a camera.
#pragma once

#include <vector>

#include "vpm/photon/photon_beam.h"
#include "vpm/scene/scene.h"

namespace vpm::bench {

/// The room of scenes/fog_room.toml, 2 m wide, with fog of that many free paths a metre. The camera stands in the fog.
Scene foggy_room(float sigma_t);

/// The first `count` flights of photons in the room. Their powers are not yet divided by the photons emitted.
std::vector<PhotonBeam> room_beams(const Scene& scene, size_t count);

/// An eye ray, up to the wall that it meets.
struct EyeRay {
  Ray ray;
  Interval interval;
};
/// A ray for each pixel, block by block: 16 that follow each other are 4 x 4 pixels.
std::vector<EyeRay> room_rays(const Scene& scene);

/// The beams cut into pieces of equal length, none longer than `longest`, m.
std::vector<PhotonBeam> cut_beams(const std::vector<PhotonBeam>& beams, double longest);

}  // namespace vpm::bench
