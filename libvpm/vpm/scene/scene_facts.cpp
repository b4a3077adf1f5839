// Which media and surfaces take part is decided here alone.
#include "vpm/scene/scene_facts.h"

#include <algorithm>

namespace vpm {

void SceneFacts::add(const Medium& medium) {
  grids |= !medium.homogeneous();
  scattering_media |= medium.scatters();
  emitting_media |= medium.emits();
}

void SceneFacts::add_world(const Medium& medium) {
  endless = medium.scatters();
  endless_flights = endless && std::min({medium.sigma_t.r, medium.sigma_t.g, medium.sigma_t.b}) == 0.0f;
}

SceneFacts facts_of(const Scene& scene) {
  SceneFacts facts;
  for (const Medium& medium : scene.media) facts.add(medium);
  if (scene.world_medium != kVacuum) facts.add_world(scene.media[scene.world_medium]);
  for (const Shape& shape : scene.shapes) facts.rough_surfaces |= is_rough(scene.materials[shape.material]);
  facts.cyclic = scene.period.has_value();
  return facts;
}

}  // namespace vpm
