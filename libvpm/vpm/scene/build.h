// Shapes put into a scene one by one, unchecked: by assemble(), and by studies and tests of scenes that it would
// refuse.
#pragma once

#include "vpm/scene/scene.h"
#include "vpm/surface/mesh.h"

namespace vpm {

/// Adds a shape, whose material the scene has, and returns its number.
template <class Surface>
uint32_t place_shape(Scene& scene, Shape shape, const Surface& surface) {
  const uint32_t number = scene.geometry.add(surface, layer_of(shape, scene.materials[shape.material]));
  scene.shapes.push_back(std::move(shape));
  return number;
}

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
  return place_shape(scene, std::move(shape), surface);
}

}  // namespace vpm
