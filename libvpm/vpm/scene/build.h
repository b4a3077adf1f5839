// Scenes built in code: for studies and tests.
#pragma once

#include "vpm/scene/scene.h"
#include "vpm/surface/mesh.h"

namespace vpm {

/// Adds a shape with a material of its own, and returns its number. Separates media where `media` is given; emits where
/// `light` is the number of a light.
template <class Surface>
uint32_t add_shape(Scene& scene, const Surface& surface, const Material& material, const Interface* media = nullptr,
                   int light = -1) {
  Shape shape;
  shape.material = static_cast<uint32_t>(scene.materials.size());
  shape.separates_media = media != nullptr;
  if (media) shape.media = *media;
  shape.light = light;
  scene.materials.push_back(material);
  scene.shapes.push_back(shape);
  return scene.geometry.add(surface, layer_of(shape, material));
}

}  // namespace vpm
