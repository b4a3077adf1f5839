// The checks of parts: each in its list's order, then what they say of each other.
#include "vpm/scene/check_parts.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "vpm/base/overloads.h"
#include "vpm/light/light.h"
#include "vpm/light/of_surface.h"
#include "vpm/medium/medium.h"
#include "vpm/surface/material/material.h"

namespace vpm {
namespace {

void check_medium_number(const SceneParts& parts, MediumId medium, const PartName& part) {
  const auto count = static_cast<MediumId>(parts.media.size());
  if (medium >= kVacuum && medium < count) return;
  throw PartError(part, "there is no medium of number " + std::to_string(medium),
                  "there are " + std::to_string(count) + ", counted from 0; " + std::to_string(kVacuum) + " is vacuum");
}

void check_media(const SceneParts& parts) {
  for (size_t i = 0; i < parts.media.size(); ++i) {
    const MediumPart& medium = parts.media[i];
    const std::string problem = problem_of(medium.medium);
    if (!problem.empty()) throw PartError({PartKind::medium, i}, problem);
    if (medium.medium.emits() && parts.world_medium == static_cast<MediumId>(i))
      throw PartError({PartKind::world}, "'" + medium.medium.name + "' emits: it would fill the world with light",
                      "name it as a shape's 'inside'");
    if (medium.medium.name == "vacuum")
      throw PartError({PartKind::medium, i}, "no medium can be named 'vacuum': that is the empty space");
    if (!medium.outside) continue;
    const PartName outside{PartKind::medium, i, "outside"};
    check_medium_number(parts, *medium.outside, outside);
    if (*medium.outside == static_cast<MediumId>(i)) throw PartError(outside, "a medium cannot be outside itself");
  }
}

void check_materials(const SceneParts& parts) {
  for (size_t i = 0; i < parts.materials.size(); ++i) {
    Material material = parts.materials[i].material;
    const std::string problem = problem_of(material);
    if (!problem.empty()) throw PartError({PartKind::material, i}, problem);
    if (parts.materials[i].texture && !reflectance_of(material))
      throw PartError({PartKind::material, i, "texture"}, "a texture is a reflectance, which this material lacks",
                      "remove it, or make the material lambertian or a mirror");
  }
}

bool has_uvs(const Surface& surface) {
  return std::visit(Overloads{[](const TriangleMesh& mesh) { return !mesh.uvs.empty(); },
                              [](const QuadMesh& quad) { return !quad.mesh.uvs.empty(); },
                              [](const SphereShape&) { return true; }, [](const DiscShape&) { return false; }},
                    surface);
}

void check_emission(const ShapePart& shape, const std::string& title, const Material& material, size_t number) {
  if (!shape.emission) return;
  const Rgb& radiance = *shape.emission;
  const PartName part{PartKind::shape, number, "emission"};
  if (!is_finite(radiance) || std::min({radiance.r, radiance.g, radiance.b}) < 0.0f)
    throw PartError(part, "the emission of " + title + " must be at least 0 and finite");
  if (is_black(radiance)) throw PartError(part, "the emission of " + title + " is black", "remove the key");
  if (is_boundary(material))
    throw PartError(part, "a boundary has no surface that could emit", "give " + title + " another material");
}

void check_disc(const ShapePart& shape, size_t number) {
  constexpr float kRounding = 1e-4f;
  const auto* disc = std::get_if<DiscShape>(&shape.surface);
  if (disc && !(std::abs(glm::length(disc->normal) - 1.0f) < kRounding))
    throw PartError({PartKind::shape, number, "surface"}, "the normal of a disc must be a unit vector");
}

void check_shape(const SceneParts& parts, size_t number) {
  const ShapePart& shape = parts.shapes[number];
  const std::string title = shape.title.empty() ? "shape '" + shape_name(parts, number) + "'" : shape.title;
  if (shape.material >= parts.materials.size())
    throw PartError({PartKind::shape, number, "material"},
                    "there is no material of number " + std::to_string(shape.material),
                    "there are " + std::to_string(parts.materials.size()) + ", counted from 0");
  if (shape.media) {
    check_medium_number(parts, shape.media->inside, {PartKind::shape, number, "inside"});
    check_medium_number(parts, shape.media->outside, {PartKind::shape, number, "outside"});
  }
  check_disc(shape, number);
  const MaterialPart& material = parts.materials[shape.material];
  check_emission(shape, title, material.material, number);
  if (!material.texture) return;
  if (!has_uvs(shape.surface))
    throw PartError({PartKind::shape, number, "material"},
                    "the material of " + title + " has a texture, but the shape has no coordinates in it",
                    "spheres and quads have them, and meshes whose file gives them to the vertices");
  if (shape.notes.without_uvs == 0) return;
  const uint32_t line = shape.notes.first_without_uvs;
  throw PartError({PartKind::shape, number, "material"},
                  "the material of " + title + " has a texture, but corners of its mesh have no coordinates in it" +
                      (line > 0 ? ", first those of the face in line " + std::to_string(line) : ""),
                  "give the mesh's file coordinates for all of its faces, or split it into two shapes");
}

void check_shapes(const SceneParts& parts) {
  std::set<std::string> names;
  for (size_t i = 0; i < parts.shapes.size(); ++i) {
    check_shape(parts, i);
    const std::string name = shape_name(parts, i);
    if (!names.insert(name).second)
      throw PartError({PartKind::shape, i, "name"}, "two shapes are named '" + name + "'",
                      "give each shape a name of its own");
  }
}

void check_lights(const SceneParts& parts) {
  for (size_t i = 0; i < parts.lights.size(); ++i) {
    const Light& light = parts.lights[i].light;
    if (is_surface(light))
      throw PartError({PartKind::light, i}, "a surface that emits is a shape", "give a shape emission");
    const std::string problem = problem_of(light);
    if (!problem.empty()) throw PartError({PartKind::light, i}, problem);
    if (is_infinite(light) && parts.world_medium != kVacuum)
      throw PartError({PartKind::world},
                      "a medium fills the world, but a light comes from infinity: it would never arrive",
                      "remove [world], or the directional and environment lights");
  }
  const bool emits =
      std::any_of(parts.shapes.begin(), parts.shapes.end(),
                  [](const ShapePart& s) { return s.emission.has_value(); }) ||
      std::any_of(parts.media.begin(), parts.media.end(), [](const MediumPart& m) { return m.medium.emits(); });
  if (parts.lights.empty() && !emits)
    throw PartError({PartKind::scene}, "the scene has no light",
                    "add [[lights]], or a shape or a medium with emission");
}

void check_cyclic(const SceneParts& parts) {
  const auto axes = std::count(parts.cyclic.begin(), parts.cyclic.end(), true);
  if (axes == 0) return;
  const auto refuse = [](const std::string& wrong, const std::string& right) {
    throw PartError({PartKind::cyclic}, wrong, right);
  };
  if (parts.world_medium != kVacuum)
    refuse("a medium that fills the world has no box to repeat", "name it as the 'inside' of a box");
  for (const LightPart& part : parts.lights) {
    if (!is_infinite(part.light)) continue;
    const auto* const parallel = std::get_if<DirectionalLight>(&part.light);
    if (!parallel)
      refuse("an environment does not light a scene that repeats itself",
             "let a quad as wide as the scene send the light: what it emits is even over all directions");
    for (size_t a = 0; axes == 2 && a < 3; ++a)
      if (!parts.cyclic[a] && parallel->direction[static_cast<int>(a)] == 0.0f)
        refuse("parallel light along the axes that repeat themselves never enters", "give it another direction");
    if (axes != 2)
      refuse("light from infinity enters a scene that repeats itself along two axes, no more and no fewer",
             "name two axes, such as [\"x\", \"z\"]");
  }
}

void check_detector(const SceneParts& parts, size_t number) {
  const Detector& detector = parts.detectors[number];
  const auto refuse = [&](const char* field, const std::string& wrong) {
    throw PartError({PartKind::detector, number, field}, wrong);
  };
  const auto positive = [&](float radius) {
    if (!(radius > 0.0f && std::isfinite(radius))) refuse("radius", "its radius must be positive and finite");
  };
  const auto finite = [&](const char* field, const Vec3& value) {
    if (!is_finite(value)) refuse(field, "must be finite");
  };
  const auto unit = [&](const Vec3& normal) {
    constexpr float kRounding = 1e-4f;
    if (!(std::abs(glm::length(normal) - 1.0f) < kRounding)) refuse("normal", "must be a unit vector");
  };
  std::visit(Overloads{[&](const PlaneDetector& plane) {
                         finite("point", plane.point);
                         unit(plane.normal);
                       },
                       [&](const DiscDetector& disc) {
                         finite("center", disc.center);
                         unit(disc.normal);
                         positive(disc.radius);
                       },
                       [&](const QuadDetector& quad) {
                         finite("corner", quad.corner);
                         const Vec3d u(quad.edge_u), v(quad.edge_v);
                         if (!(glm::length(glm::cross(u, v)) > 1e-6 * glm::length(u) * glm::length(v)))
                           refuse("edge_v", "its edges are parallel, or one is zero");
                         if (std::min(quad.cells[0], quad.cells[1]) < 1) refuse("cells", "must be 1 or more");
                       },
                       [&](const SphereDetector& sphere) {
                         finite("center", sphere.center);
                         positive(sphere.radius);
                       },
                       [&](const MediumDetector& of) {
                         check_medium_number(parts, of.medium, {PartKind::detector, number, "medium"});
                         if (of.medium == kVacuum) refuse("medium", "vacuum absorbs nothing");
                       }},
             detector.kind);
  if (detector.angles < 1) refuse("angles", "must be 1 or more");
}

void check_detectors(const SceneParts& parts) {
  constexpr size_t kMostBins = 100'000;  // each chunk of photons has its own
  std::set<std::string> names;
  size_t bins = 0;
  for (size_t i = 0; i < parts.detectors.size(); ++i) {
    check_detector(parts, i);
    if (!names.insert(parts.detectors[i].name).second)
      throw PartError({PartKind::detector, i, "name"}, "two detectors are named '" + parts.detectors[i].name + "'",
                      "give each a name of its own");
    bins += parts.detectors[i].bins();
    if (bins > kMostBins)
      throw PartError({PartKind::detector, i},
                      "cells times angles of all detectors are more than " + std::to_string(kMostBins / 2),
                      "count in fewer parts, or measure fluence in cells (vpm fluence)");
  }
}

void check_camera(const SceneParts& parts) {
  const Camera& camera = parts.camera;
  const PartName part{PartKind::camera};
  if (!is_finite(camera.position)) throw PartError(part, "its position must be finite");
  if (camera.width < 1 || camera.height < 1) throw PartError(part, "its film must have a pixel at least");
  if (!lies_in(camera.rendered(), camera.width, camera.height))
    throw PartError(part, "its crop must have a pixel, and lie inside the film");
  if (!(camera.tan_half_fov > 0.0f && std::isfinite(camera.tan_half_fov)))
    throw PartError(part, "its field of view must lie between 0 and 180 degrees");
  if (!(camera.filter.radius > 0.0f && std::isfinite(camera.filter.radius)))
    throw PartError(part, "the filter's radius must be positive");
  if (parts.camera_medium) check_medium_number(parts, *parts.camera_medium, {PartKind::camera, 0, "camera_medium"});
}

}  // namespace

void check_parts(const SceneParts& parts) {
  check_medium_number(parts, parts.world_medium, {PartKind::world});
  check_media(parts);
  check_materials(parts);
  check_shapes(parts);
  check_lights(parts);
  check_cyclic(parts);
  check_detectors(parts);
  check_camera(parts);
}

bool is_boxed(const SceneParts& parts, MediumId id) {
  const auto number = static_cast<size_t>(id);
  const MediumPart& medium = parts.media[number];
  const PartName part{PartKind::medium, number};
  const std::string title = "the grid medium '" + medium.medium.name + "'";
  bool inside = false, outside = false;
  for (const ShapePart& shape : parts.shapes) {
    inside = inside || (shape.media && shape.media->inside == id);
    outside = outside || (shape.media && shape.media->outside == id);
  }
  if (parts.world_medium == id) {
    if (medium.boundary == GridBoundary::box) throw PartError(part, title + " fills the world and cannot have a box");
    return false;
  }
  if (medium.boundary == GridBoundary::shapes && !inside && !outside)
    throw PartError(part, "no shape names " + title + ", which asks for shapes as its boundary",
                    "name it as a shape's 'inside'");
  if (medium.boundary == GridBoundary::automatic && outside && !inside)
    throw PartError(part, title + " lies outside of shapes only: say where it ends",
                    "give it boundary = \"box\" (its grid's own box, around those shapes) or \"shapes\" (they enclose "
                    "it)");
  return medium.boundary == GridBoundary::box || (medium.boundary == GridBoundary::automatic && !inside);
}

}  // namespace vpm
