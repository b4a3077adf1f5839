// Small scenes built in code, for tests.
#pragma once

#include "scene/scene.h"
#include "support/grids.h"

namespace vpm {

/// Twelve outward triangles around the box.
inline TriangleMesh box_mesh(const Vec3& lo, const Vec3& hi) {
  TriangleMesh mesh;
  for (int c = 0; c < 8; ++c)
    mesh.positions.push_back(Vec3(c & 1 ? hi.x : lo.x, c & 2 ? hi.y : lo.y, c & 4 ? hi.z : lo.z));
  mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return mesh;
}

/// A quad as a mesh, normal cross(u, v).
inline TriangleMesh quad_mesh(const Vec3& corner, const Vec3& u, const Vec3& v) {
  return {{corner, corner + u, corner + u + v, corner + v}, {{0, 1, 2}, {0, 2, 3}}};
}

/// Adds a shape of a material of its own; separates media where `media` is given.
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

/// A medium inside the boundary box [-1, 1]^3, vacuum around it.
inline Scene boxed_medium(const Medium& medium, const Light& light) {
  Scene scene;
  scene.media.push_back(medium);
  const Interface media{0, kVacuum};
  add_shape(scene, box_mesh(Vec3(-1.0f), Vec3(1.0f)), Boundary{}, &media);
  scene.lights.push_back(light);
  scene.geometry.commit();
  finish(scene);
  return scene;
}

}  // namespace vpm
