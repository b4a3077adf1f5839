// The immutable scene: geometry with its materials and media, lights, camera.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "vpm/base/vec.h"
#include "vpm/light/light.h"
#include "vpm/medium/medium.h"
#include "vpm/scene/camera.h"
#include "vpm/scene/detector.h"
#include "vpm/scene/period.h"
#include "vpm/surface/geometry.h"
#include "vpm/surface/material/facet_loss.h"
#include "vpm/surface/material/material.h"
#include "vpm/surface/material/texture.h"

namespace vpm {

/// The number of a medium in Scene::media, or kVacuum.
using MediumId = int;
inline constexpr MediumId kVacuum = -1;
inline constexpr MediumId kSeveralMedia = -2;

/// The media that meet at a surface: behind it (against its outward normal) and before it.
struct Interface {
  MediumId inside = kVacuum;
  MediumId outside = kVacuum;
};

/// What the scene knows about the shape of the same number in Geometry.
struct Shape {
  std::string name;
  uint32_t material = 0;
  bool separates_media = false;  // false: the medium is the same on both sides, whatever it is
  Interface media;               // where separates_media
  int light = -1;                // its number in Scene::lights where it emits
};

struct Scene {
  Geometry geometry;
  std::vector<Shape> shapes;
  std::vector<Material> materials;
  /// Of the material of the same number: the picture its reflectance is read from, in [0, 1]. The material itself holds
  /// the picture's mean. Null, or missing at the list's end: the reflectance is the same everywhere.
  std::vector<std::shared_ptr<const Texture>> textures;
  std::vector<Medium> media;
  std::vector<Light> lights;        // one at least, in scenes that light is followed through
  MediumId world_medium = kVacuum;  // fills all space outside the shapes that separate media
  Camera camera;
  MediumId camera_medium = kVacuum;  // kSeveralMedia where the camera stands on a boundary
  std::vector<Detector> detectors;
  std::array<bool, 3> cyclic{};  // along which axes the box around all shapes repeats itself: for photons alone

  // Derived by finish().
  Box bounds;                             // a little wider than all shapes; without any, 1 m about the origin
  std::optional<Period> period;           // where it repeats itself
  bool grey = false;                      // one channel carries everything
  std::vector<double> light_probability;  // of emitting the next photon, by power; sums to 1
  std::vector<std::shared_ptr<const FacetLoss>> facet_losses;  // of materials of microfacets, which point to them
  // That a light's photons start in; kSeveralMedia where a boundary cuts the light, or runs through its point.
  std::vector<MediumId> light_medium;
  std::vector<int> medium_light;  // the number of the light that a medium is; -1 where it emits nothing

  bool has_emitting_media() const {
    return std::any_of(medium_light.begin(), medium_light.end(), [](int light) { return light >= 0; });
  }
  /// The material of a hit shape: what it is, with the mean of a reflectance that a texture gives.
  const Material& material_of(const Hit& hit) const { return materials[shapes[hit.shape].material]; }
};

/// The material as light meets it at a hit, its reflectance read from the texture where it has one.
inline Material material_at(const Scene& scene, const Hit& hit) {
  const uint32_t number = scene.shapes[hit.shape].material;
  Material material = scene.materials[number];
  if (number < scene.textures.size() && scene.textures[number])
    *reflectance_of(material) = scene.textures[number]->at(scene.geometry.uv(hit));
  return material;
}

/// The medium on the side of a surface that `direction` points to, for a path that is in `current`.
inline MediumId medium_beyond(const Shape& shape, const Vec3& normal, const Vec3& direction, MediumId current) {
  if (!shape.separates_media) return current;
  return glm::dot(direction, normal) > 0.0f ? shape.media.outside : shape.media.inside;
}

/// The medium in which a ray along `direction` comes to an encounter: `current` where one of the shapes has it on the
/// near side, or none separates media; otherwise the near side that is no other shape's far side.
MediumId medium_before(const Scene& scene, const Encounter& met, const Vec3& direction, MediumId current);
/// The medium in which the ray goes on once it has crossed all of the encounter's shapes: each in turn whose near side
/// is the medium so far.
MediumId medium_after(const Scene& scene, const Encounter& met, const Vec3& direction, MediumId current);

/// What a shape of that material is to rays, for Geometry::add().
inline Layer layer_of(const Shape& shape, const Material& material) {
  if (is_boundary(material)) return Layer::boundary;
  if (is_dielectric(material)) return shape.separates_media ? Layer::interface : Layer::pane;
  return shape.separates_media ? Layer::dividing_surface : Layer::surface;
}

/// Fills in what a scene derives from its parts. Call once, after all else is set and the geometry committed. Throws
/// InputError where there are lights, but all of them black.
void finish(Scene& scene);

/// The box that light from infinity enters: the scene's, or a face of its period.
Box entrance_of(const Scene& scene, const Light& light);

/// The medium at a point that is not on a surface: what the nearest shape that separates media, along a fixed
/// direction, has on the near side; the world's medium where there is none. Three directions vote, because one may run
/// along an edge or a face.
MediumId medium_at(const Scene& scene, const Vec3& point);

/// The medium that rays from a point start in: kSeveralMedia where that may depend on their direction, as on a
/// boundary.
MediumId medium_around(const Scene& scene, const Vec3& point);

/// The medium that a ray starts in, from a place whose medium is `place`. Of kSeveralMedia it is what the first shape
/// along the ray that separates media has on the near side; the world's where there is none.
MediumId medium_of_ray(const Scene& scene, MediumId place, const Ray& ray);

}  // namespace vpm
