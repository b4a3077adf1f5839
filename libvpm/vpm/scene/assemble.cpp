// Parts become a scene: boxes around grids, shapes with their lights, what the scene derives, and checks of the whole.
#include "vpm/scene/assemble.h"

#include <algorithm>

#include "vpm/base/overloads.h"
#include "vpm/light/emitting_volume.h"
#include "vpm/light/of_surface.h"
#include "vpm/scene/build.h"
#include "vpm/scene/check_parts.h"
#include "vpm/scene/check_scene.h"
#include "vpm/surface/locate.h"

namespace vpm {
namespace {

/// The media whose boxes follow the shapes that are given.
struct Boxes {
  size_t first = 0;  // the number of the first box among the shapes
  std::vector<MediumId> media;

  /// The part that a shape stems from.
  PartName part_of(size_t shape) const {
    if (shape < first) return {PartKind::shape, shape};
    return {PartKind::medium, static_cast<size_t>(media[shape - first])};
  }
};

/// Checks the medium as a grid, or as one without. Is it to be met within a box?
bool check_grid(const SceneParts& parts, size_t number) {
  const MediumPart& part = parts.media[number];
  const auto id = static_cast<MediumId>(number);
  if (!part.medium.grid) {
    if (part.boundary != GridBoundary::automatic || part.outside)
      throw PartError({PartKind::medium, number}, "a medium without a grid has no box and no boundary of its own",
                      "name it as a shape's 'inside'");
    return false;
  }
  const bool boxed = is_boxed(parts, id);
  const float background = part.medium.grid->frame().background;
  if (parts.world_medium == id && background == 0.0f)
    throw PartError({PartKind::world},
                    "the grid of '" + part.medium.name + "' has background 0: it cannot fill the world",
                    "remove [world]");
  if (boxed && background != 0.0f)
    throw PartError({PartKind::medium, number}, "the grid of '" + part.medium.name + "' has a background other than 0",
                    "name the medium as a shape's 'inside', so that the shape bounds it");
  return boxed;
}

/// By how many voxels the faces of a grid's box may be off, where rays meet them in single precision. 0 for boxes of
/// which that is no more than a hundredth.
double lost_voxels(const DensityGrid& grid) {
  constexpr double kOff = 0x1p-19, kNegligible = 0.01;  // of the farthest corner's distance; voxels
  const Box bounds = grid.bounds();
  const Vec3d farthest = glm::max(glm::abs(Vec3d(bounds.lo)), glm::abs(Vec3d(bounds.hi)));
  const double voxels = kOff * glm::length(farthest) / double{grid.voxel_size()};
  return voxels > kNegligible ? voxels : 0.0;
}

/// Where emission does not go by density, the box of a medium holds the grids of both.
void add_support_of_emission(const Medium& medium, Vec3d& lo, Vec3d& hi) {
  if (!medium.emission_grid || medium.emission->meaning == MediumEmission::Meaning::thermal) return;
  const DensityGrid& emission = *medium.emission_grid;
  const Mat4d to_density = glm::inverse(medium.grid->frame().index_to_world) * emission.frame().index_to_world;
  const Vec3d a = emission.support_lo(), b = emission.support_hi();
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3d p(corner & 1 ? b.x : a.x, corner & 2 ? b.y : a.y, corner & 4 ? b.z : a.z);
    const Vec3d index(to_density * glm::dvec4(p, 1.0));
    lo = glm::min(lo, index);
    hi = glm::max(hi, index);
  }
}

/// The box around a grid's support, as a boundary with the medium inside. Around it there is no density, so that a wide
/// box may be larger by what its faces are off: else clouds at its ends would lie outside.
ShapePart box_of(const SceneParts& parts, MediumId id) {
  const MediumPart& medium = parts.media[static_cast<size_t>(id)];
  const DensityGrid& grid = *medium.medium.grid;
  const double margin = lost_voxels(grid);
  Vec3d lo = grid.support_lo(), hi = grid.support_hi();
  add_support_of_emission(medium.medium, lo, hi);
  TriangleMesh mesh = box_mesh(lo - margin, hi + margin);
  transform_mesh(grid.frame().index_to_world, mesh);
  ShapePart box;
  box.name = "box of " + medium.medium.name;
  box.surface = std::move(mesh);
  box.media = Interface{id, medium.outside.value_or(parts.world_medium)};
  return box;
}

Boxes add_boxes(SceneParts& parts) {
  Boxes boxes{parts.shapes.size(), {}};
  for (size_t i = 0; i < parts.media.size(); ++i)
    if (check_grid(parts, i)) boxes.media.push_back(static_cast<MediumId>(i));
  for (const MediumId id : boxes.media) {
    ShapePart box = box_of(parts, id);
    box.material = static_cast<uint32_t>(parts.materials.size());
    parts.materials.push_back({Boundary{}, nullptr});
    parts.shapes.push_back(std::move(box));
  }
  return boxes;
}

void add_surface(Scene& scene, Shape shape, const Surface& surface) {
  std::visit(Overloads{[&](const QuadMesh& quad) { place_shape(scene, std::move(shape), quad.mesh); },
                       [&](const auto& other) { place_shape(scene, std::move(shape), other); }},
             surface);
}

size_t triangles_of(const Surface& surface) {
  return std::visit(Overloads{[](const TriangleMesh& mesh) { return mesh.triangles.size(); },
                              [](const QuadMesh& quad) { return quad.mesh.triangles.size(); },
                              [](const SphereShape&) { return size_t{0}; }, [](const DiscShape&) { return size_t{0}; }},
                    surface);
}

void add_mesh_notes(const ShapePart& part, std::vector<std::string>& notes) {
  const auto add = [&](uint64_t number, const std::string& what) {
    if (number > 0) notes.push_back("shape '" + part.name + "': " + std::to_string(number) + what);
  };
  add(part.notes.without_area, " triangles without area dropped");
  add(part.notes.not_plane, " polygons are not plane: the file does not say how they bend between their corners");
  add(part.notes.bad_normals,
      " corners name a normal that is zero, no number or not there: they have that of the triangle");
  add(part.notes.free_form, " curves and free-form surfaces in the file are not read");
}

void add_shape_part(ShapePart part, AssembledScene& result) {
  Scene& scene = result.scene;
  const auto number = static_cast<uint32_t>(scene.shapes.size());
  const bool emits = part.emission.has_value();
  Shape shape;
  shape.name = part.name;
  shape.material = part.material;
  shape.separates_media = part.media.has_value();
  if (part.media) shape.media = *part.media;
  if (emits) shape.light = static_cast<int>(scene.lights.size());
  add_surface(scene, std::move(shape), part.surface);
  part.notes.without_area += triangles_of(part.surface) - scene.geometry.triangle_count(number);
  add_mesh_notes(part, result.notes);
  if (!emits) return;
  scene.lights.push_back(
      std::visit([&](auto& surface) { return light_of(std::move(surface), *part.emission); }, part.surface));
  result.light_names.push_back(part.name);
}

Box bounds_of_surface(const Surface& surface) {
  const auto of_mesh = [](const TriangleMesh& mesh) {
    Box box;
    for (const Vec3& position : mesh.positions) box.add(position);
    return box;
  };
  return std::visit(Overloads{of_mesh, [&](const QuadMesh& quad) { return of_mesh(quad.mesh); },
                              [](const auto& shape) { return bounds_of(shape); }},
                    surface);
}

bool is_closed_surface(const Surface& surface) {
  return std::visit(Overloads{[](const TriangleMesh& mesh) { return is_closed(mesh); },
                              [](const SphereShape&) { return true; }, [](const auto&) { return false; }},
                    surface);
}

/// Boxes that hold the medium: of each closed shape that has it inside; or, where others bound it that do not lie in
/// one of these, one around all.
std::vector<Box> boxes_around(const SceneParts& parts, MediumId id) {
  std::vector<Box> boxes, others;
  Box all;
  for (const ShapePart& shape : parts.shapes) {
    if (!shape.media || (shape.media->inside != id && shape.media->outside != id)) continue;
    const Box bounds = bounds_of_surface(shape.surface);
    const bool filled = shape.media->inside == id && is_closed_surface(shape.surface);
    (filled ? boxes : others).push_back(bounds);
    all.add(bounds);
  }
  for (const Box& other : others)
    if (std::none_of(boxes.begin(), boxes.end(),
                     [&](const Box& box) { return box.contains(other.lo) && box.contains(other.hi); }))
      return {all};
  return boxes;
}

/// Media that emit are lights, behind all others.
void add_emitting_media(const std::vector<std::vector<Box>>& around, AssembledScene& result) {
  Scene& scene = result.scene;
  for (size_t i = 0; i < scene.media.size(); ++i) {
    const Medium& medium = scene.media[i];
    if (!medium.emits()) continue;
    if (around[i].empty())
      throw PartError({PartKind::medium, i}, "'" + medium.name + "' emits, but fills no shape",
                      "name it as a shape's 'inside', or leave out its emission");
    try {
      scene.lights.push_back(VolumeLight{.medium = static_cast<int>(i),
                                         .volume = std::make_shared<const EmittingVolume>(medium, around[i])});
    } catch (const InputError& error) {
      const std::string doubt = doubt_of_temperatures(medium);
      throw PartError(
          {PartKind::medium, i}, error.what(),
          doubt.empty() ? "let density, absorption (albedo below 1) and emission be above 0 at one place" : doubt);
    }
    result.light_names.push_back(medium.name);
  }
}

void add_shapes(SceneParts& parts, const Boxes& boxes, AssembledScene& result) {
  for (size_t i = 0; i < parts.shapes.size(); ++i) {
    parts.shapes[i].name = shape_name(parts, i);
    try {
      add_shape_part(std::move(parts.shapes[i]), result);
    } catch (const InputError& error) {
      throw PartError(boxes.part_of(i), error.what());
    }
  }
  result.scene.geometry.commit();
  if (!result.scene.geometry.bounds().empty()) return;
  for (const LightPart& light : parts.lights)
    if (is_infinite(light.light))
      throw PartError({PartKind::lights}, "a light at infinity has nothing to shine on: the scene has no shapes");
}

/// All lists but that of the shapes.
void add_lists(SceneParts& parts, AssembledScene& result) {
  Scene& scene = result.scene;
  for (MediumPart& medium : parts.media) scene.media.push_back(std::move(medium.medium));
  for (MaterialPart& part : parts.materials) {
    for (std::string& note : part.notes) result.notes.push_back("a texture: " + note);
    if (part.texture) *reflectance_of(part.material) = part.texture->mean();
    scene.materials.push_back(part.material);
    scene.textures.push_back(std::move(part.texture));
  }
  for (const LightPart& light : parts.lights) {
    scene.lights.push_back(light.light);
    result.light_names.push_back(light.name);
    for (const std::string& note : light.notes) result.notes.push_back("light '" + light.name + "': " + note);
  }
  scene.world_medium = parts.world_medium;
  scene.cyclic = parts.cyclic;
  scene.detectors = std::move(parts.detectors);
  scene.camera = parts.camera;
}

/// Lights and detectors of a scene that repeats itself lie between its sides.
void check_period(const Scene& scene) {
  if (!scene.period) return;
  const auto leaves = [&](const Box& box) {
    for (int a = 0; a < 3; ++a)
      if (scene.period->repeats(a) && (box.lo[a] < scene.bounds.lo[a] || box.hi[a] > scene.bounds.hi[a])) return true;
    return false;
  };
  for (const Light& light : scene.lights)
    if (const std::optional<LightPlace> place = light_place(light); place && leaves(place->bounds))
      throw PartError({PartKind::cyclic},
                      "a light reaches beyond the box around all shapes, which repeats itself along that axis",
                      "move the light, or give the box the width of a period");
  for (size_t i = 0; i < scene.detectors.size(); ++i) {
    const Box around = bounds_of(scene.detectors[i]);
    const auto* const plane = std::get_if<PlaneDetector>(&scene.detectors[i].kind);
    bool across = !around.empty() && leaves(around);
    for (int a = 0; plane && a < 3; ++a) across = across || (scene.period->repeats(a) && plane->normal[a] != 0.0f);
    if (across)
      throw PartError({PartKind::detector, i},
                      "'" + scene.detectors[i].name +
                          "' reaches across the sides of a scene "
                          "that repeats itself",
                      "keep it between them; the normal of a plane is along an axis that does not repeat itself");
  }
}

/// The box around all shapes, which is to repeat itself, has a width.
void check_width(const Scene& scene) {
  const Box shapes = scene.geometry.bounds();
  for (int a = 0; a < 3; ++a)
    if (scene.cyclic[static_cast<size_t>(a)] && (shapes.empty() || !(shapes.extent()[a] > 0.0f)))
      throw PartError({PartKind::cyclic}, "the shapes have no width along an axis that is to repeat itself",
                      "add the box of a medium, or a floor");
}

void check_contradictions(const Scene& scene, const Boxes& boxes) {
  const std::optional<MediaContradiction> found = find_media_contradiction(scene);
  if (!found) return;
  const auto title = [&](MediumId id) {
    return id == kVacuum ? std::string("vacuum") : "'" + scene.media[static_cast<size_t>(id)].name + "'";
  };
  throw PartError(boxes.part_of(found->shape),
                  "shape '" + scene.shapes[found->shape].name + "' has " + title(found->declared) +
                      (found->outside ? " outside" : " inside") + ", but the shapes around it say that " +
                      title(found->found) + " is there",
                  "name on both sides of every shape the media that are there; media fill closed shapes and may be "
                  "nested, not overlap in part");
}

void check_faces(const Scene& scene, const Boxes& boxes) {
  const std::optional<CommonFace> found = find_common_face(scene);
  if (!found) return;
  throw PartError(
      boxes.part_of(found->shape),
      "shape '" + scene.shapes[found->shape].name + "' has a face in common with shape '" +
          scene.shapes[found->other].name + "': light that must meet both there would meet but one of them",
      "let one reach a little into the other (where not both name media), leave a gap between them, or give "
      "the common face once: as a dielectric with the ratio of the two indices, and the media on its two "
      "sides");
}

}  // namespace

AssembledScene assemble(SceneParts parts) {
  check_parts(parts);
  const Boxes boxes = add_boxes(parts);
  AssembledScene result;
  Scene& scene = result.scene;
  std::vector<std::vector<Box>> around(parts.media.size());  // those that emit
  for (size_t i = 0; i < around.size(); ++i)
    if (parts.media[i].medium.emits()) around[i] = boxes_around(parts, static_cast<MediumId>(i));
  add_lists(parts, result);
  add_shapes(parts, boxes, result);
  add_emitting_media(around, result);
  check_width(scene);
  scene.camera_medium = parts.camera_medium ? *parts.camera_medium : medium_around(scene, scene.camera.position);
  try {
    finish(scene);
  } catch (const InputError& error) {
    throw PartError({PartKind::lights}, error.what());
  }
  check_period(scene);
  check_contradictions(scene, boxes);
  check_faces(scene, boxes);
  for (std::string& note : notes_of(scene)) result.notes.push_back(std::move(note));
  return result;
}

}  // namespace vpm
