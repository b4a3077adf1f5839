// Media as lights, as far as no scene is needed.
#include <cassert>

#include "vpm/light/emitting_volume.h"
#include "vpm/light/kinds.h"

namespace vpm {

Rgb power_of(const VolumeLight& light, const Box&) { return light.power; }

Emission emit_from(const VolumeLight&, const Box&, const EmissionNumbers&) {
  assert(!"photons of media are emitted by emit_photon()");
  return {};
}

std::optional<Incident> incident_from(const VolumeLight&, const Vec3&, Rng&) { return std::nullopt; }

float pdf_of(const VolumeLight& light, const Vec3& point, const SeenLight& seen) {
  return static_cast<float>(light.volume->direction_density({point, seen.direction}));
}

LightPlace place_of(const VolumeLight& light) {
  return {light.volume->bounds(), light.volume->draw(0.5, 0.5, Vec2(0.5f)).position};
}

}  // namespace vpm
