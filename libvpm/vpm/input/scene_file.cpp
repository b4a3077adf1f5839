// From a scene file to a Scene: reads the sections, then the grids, then puts the parts together.
#include "vpm/input/scene_file.h"

#include <fmt/format.h>
#include <fstream>

#include "vpm/base/error.h"
#include "vpm/base/fnv.h"
#include "vpm/input/check_media.h"
#include "vpm/input/sections.h"
#include "vpm/render/setting.h"

namespace vpm {
namespace {

/// The file's sections with names resolved, grids not read yet.
struct ScenePlan {
  MediumId world = kVacuum;
  std::vector<MediumPlan> media;
  std::vector<MaterialPlan> materials;
  std::vector<ShapePlan> shapes;
  std::vector<LightPlan> lights;
  Camera camera;
  std::optional<MediumId> camera_medium;
  Place world_place, lights_place;
};

std::string hash_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  Fnv1a hash;
  hash.add(file);
  if (file.bad() || !file.eof()) throw InputError(path + ": cannot be read again for its hash");
  return hash.digits();
}

/// Of the text, the options, and all bytes of the files.
std::string hash_of(const std::string& text, const std::vector<std::string>& overrides,
                    const std::vector<std::string>& files) {
  Fnv1a hash;
  const auto add = [&hash](const std::string& part) {
    hash.add(part);
    hash.add("\xff");  // no byte of UTF-8: keeps parts apart
  };
  add(text);
  for (const std::string& option : overrides) add(option);
  for (const std::string& file : files) add(hash_of_file(file));
  return hash.digits();
}

Names keys_of(const TableReader* section) { return section ? section->keys() : Names{}; }

void read_media_and_world(TableReader& root, ScenePlan& plan, Names& names) {
  std::optional<TableReader> media = root.table("media", "[media]");
  names = keys_of(media ? &*media : nullptr);
  if (std::optional<TableReader> world = root.table("world", "[world]")) {
    plan.world = read_medium_name(*world, "medium", names, kVacuum);
    plan.world_place = world->place_of("medium");
    world->finish();
  }
  if (media) plan.media = read_media(*media, names, plan.world);
}

void read_all_lights(TableReader& root, ScenePlan& plan) {
  std::vector<TableReader> tables = root.tables("lights", "[[lights]]");
  plan.lights = read_lights(tables);
  plan.lights_place = root.place_of("lights");
  for (const LightPlan& light : plan.lights)
    if (is_infinite(light.light) && plan.world != kVacuum)
      fail_at(plan.world_place, "a medium fills the world, but a light comes from infinity: it would never arrive",
              "remove [world], or the directional and environment lights");
  for (ShapePlan& shape : plan.shapes) {
    if (!shape.light) continue;
    shape.shape.light = static_cast<int>(plan.lights.size());
    plan.lights.push_back({shape.shape.name, *shape.light});
  }
  if (plan.lights.empty()) root.fail_here("the scene has no light", "add [[lights]], or a shape with emission");
}

void read_camera_section(TableReader& root, const Names& media, ScenePlan& plan) {
  root.require("camera");
  TableReader camera = *root.table("camera", "[camera]");
  std::optional<TableReader> film = root.table("film", "[film]");
  plan.camera = read_camera(camera, film);
  if (camera.has("medium")) plan.camera_medium = read_medium_name(camera, "medium", media, kVacuum);
  camera.finish();
}

SceneFacts facts_of(const ScenePlan& plan) {
  SceneFacts facts;
  for (const MediumPlan& medium : plan.media) {
    facts.grids |= medium.grid.has_value();
    facts.scattering_media |= medium.medium.scatters();
  }
  for (const ShapePlan& shape : plan.shapes)
    facts.rough_surfaces |= is_rough(plan.materials[shape.shape.material].material);
  return facts;
}

ScenePlan read_plan(TableReader& root, LoadedScene& loaded) {
  ScenePlan plan;
  Names media;
  read_media_and_world(root, plan, media);
  std::optional<TableReader> materials = root.table("materials", "[materials]");
  if (materials) plan.materials = read_materials(*materials);
  std::vector<TableReader> shapes = root.tables("shapes", "[[shapes]]");
  plan.shapes = read_shapes(shapes, media, keys_of(materials ? &*materials : nullptr), plan.world, plan.materials);
  read_all_lights(root, plan);
  read_camera_section(root, media, plan);
  loaded.settings = read_settings(root, facts_of(plan), loaded.automatic);
  root.finish();
  return plan;
}

/// The options that make kAuto of what may be and is left out, and is not decided by what is given.
std::vector<std::string> left_to_choose(const Document& document) {
  const auto has = [&](const std::string& key) {
    const size_t dot = key.find('.');
    const Entry* entry = find_entry(*document.root.table(), key.substr(0, dot));
    const Node::Table* table = entry ? entry->node.table() : nullptr;
    return table && dot != std::string::npos && find_entry(*table, key.substr(dot + 1));
  };
  std::vector<std::string> options;
  for (const Setting& setting : all_settings())
    if (setting.automatic && !has(setting.key) && !has(std::string(setting.decided_by.key)))
      options.push_back(fmt::format("{}={}", setting.key, kAuto));
  return options;
}

/// Is the grid medium met within a box of its own, rather than within the scene's shapes?
bool needs_box(const ScenePlan& plan, MediumId id) {
  const MediumPlan& medium = plan.media[static_cast<size_t>(id)];
  const std::string title = "the grid medium '" + medium.medium.name + "'";
  bool inside = false, outside = false;
  for (const ShapePlan& shape : plan.shapes) {
    inside = inside || (shape.shape.separates_media && shape.shape.media.inside == id);
    outside = outside || (shape.shape.separates_media && shape.shape.media.outside == id);
  }
  if (plan.world == id) {
    if (medium.boundary == GridBoundary::box) fail_at(medium.place, title + " fills the world and cannot have a box");
    return false;
  }
  if (medium.boundary == GridBoundary::shapes && !inside && !outside)
    fail_at(medium.place, "no shape names " + title + ", which asks for shapes as its boundary",
            "name it as a shape's 'inside'");
  if (medium.boundary == GridBoundary::automatic && outside && !inside)
    fail_at(medium.place, title + " lies outside of shapes only: say where it ends",
            "give it boundary = \"box\" (its grid's own box, around those shapes) or \"shapes\" (they enclose it)");
  return medium.boundary == GridBoundary::box || (medium.boundary == GridBoundary::automatic && !inside);
}

/// The box around a grid's support, as a boundary with the medium inside.
TriangleMesh support_box(const DensityGrid& grid) {
  TriangleMesh mesh = box_mesh(grid.support_lo(), grid.support_hi());
  transform_mesh(grid.frame().index_to_world, mesh);
  return mesh;
}

void add_box(ScenePlan& plan, MediumId id) {
  const MediumPlan& medium = plan.media[static_cast<size_t>(id)];
  plan.materials.push_back({Boundary{}, nullptr});
  ShapePlan shape;
  shape.place = medium.place;
  shape.shape.name = "box of " + medium.medium.name;
  shape.shape.material = static_cast<uint32_t>(plan.materials.size() - 1);
  shape.shape.separates_media = true;
  shape.shape.media = {id, medium.outside};
  shape.surface = support_box(*medium.medium.grid);
  plan.shapes.push_back(std::move(shape));
}

void load_medium_grid(ScenePlan& plan, MediumId id, LoadedScene& loaded) {
  MediumPlan& medium = plan.media[static_cast<size_t>(id)];
  try {
    LoadedGrid grid = load_grid(*medium.grid);
    medium.medium.grid = std::move(grid.grid);
    loaded.clamped_density_values += grid.clamped_values;
    if (grid.clamped_values > 0)
      loaded.notes.push_back("medium '" + medium.medium.name + "': " + std::to_string(grid.clamped_values) +
                             " negative densities set to 0, as clamp_negative asks");
  } catch (const InputError& error) {
    fail_at(medium.path_place, error.what());
  }
  const DensityGrid& grid = *medium.medium.grid;
  if (plan.world == id && grid.frame().background == 0.0f)
    fail_at(plan.world_place, "the grid of '" + medium.medium.name + "' has background 0: it cannot fill the world",
            "remove [world]");
}

/// Reads the grids, and adds the boxes of those that no shape bounds.
void load_grids(ScenePlan& plan, LoadedScene& loaded) {
  std::vector<MediumId> boxed;
  for (size_t i = 0; i < plan.media.size(); ++i) {
    if (!plan.media[i].grid) continue;
    const auto id = static_cast<MediumId>(i);
    const bool box = needs_box(plan, id);
    plan.media[i].grid->has_bounding_shape = !box;
    if (box) boxed.push_back(id);
    load_medium_grid(plan, id, loaded);
  }
  for (const MediumId id : boxed) add_box(plan, id);
}

void add_shapes(ScenePlan& plan, LoadedScene& loaded) {
  Scene& scene = loaded.scene;
  for (ShapePlan& shape : plan.shapes) {
    if (shape.degenerate_triangles > 0)
      loaded.notes.push_back("shape '" + shape.shape.name + "': " + std::to_string(shape.degenerate_triangles) +
                             " triangles without area dropped");
    const Layer layer = layer_of(shape.shape, plan.materials[shape.shape.material].material);
    try {
      std::visit([&](const auto& surface) { scene.geometry.add(surface, layer); }, shape.surface);
    } catch (const InputError& error) {
      fail_at(shape.place, error.what());
    }
    scene.shapes.push_back(std::move(shape.shape));
  }
  scene.geometry.commit();
  bool infinite = false;
  for (const LightPlan& light : plan.lights) infinite = infinite || is_infinite(light.light);
  if (infinite && scene.geometry.bounds().empty())
    fail_at(plan.lights_place, "a light at infinity has nothing to shine on: the scene has no shapes");
}

void check_media(const Scene& scene, const ScenePlan& plan) {
  const std::optional<MediaContradiction> found = find_media_contradiction(scene);
  if (!found) return;
  const auto title = [&](MediumId id) {
    return id == kVacuum ? std::string("vacuum") : "'" + scene.media[id].name + "'";
  };
  fail_at(plan.shapes[found->shape].place,
          "shape '" + scene.shapes[found->shape].name + "' has " + title(found->declared) +
              (found->outside ? " outside" : " inside") + ", but the shapes around it say that " + title(found->found) +
              " is there",
          "name on both sides of every shape the media that are there; media fill closed shapes and may be nested, not "
          "overlap in part");
}

void check_faces(const Scene& scene, const ScenePlan& plan) {
  const std::optional<CommonFace> found = find_common_face(scene);
  if (!found) return;
  fail_at(plan.shapes[found->shape].place,
          "shape '" + scene.shapes[found->shape].name + "' has a face in common with shape '" +
              scene.shapes[found->other].name + "': light that must meet both there would meet but one of them",
          "let one reach a little into the other (where not both name media), leave a gap between them, or give the "
          "common face once: as a "
          "dielectric with the ratio of the two indices, and the media on its two sides");
}

/// Tells of a scene so far from the origin that the spacing of floats there shows in its shapes.
void note_unresolved_place(LoadedScene& loaded) {
  const Box& bounds = loaded.scene.bounds;
  if (bounds.empty()) return;
  constexpr double kVisible = 1e-4;  // of the scene's size
  const Vec3 apart = glm::abs(bounds.centre());
  const float far = std::max({apart.x, apart.y, apart.z});
  const double spacing = double(std::nextafter(far, kInfinity)) - far;
  if (spacing > kVisible * bounds.diagonal())
    loaded.notes.push_back(fmt::format(
        "the scene, {:.2g} m across, is {:.2g} m from the origin, where positions are {:.2g} m apart: its shapes are "
        "rounded to that; move it to the origin",
        bounds.diagonal(), glm::length(bounds.centre()), spacing));
}

/// Tells of media whose free paths are shorter than floats resolve positions: what enters these does not come out
/// again.
void note_unresolved_media(LoadedScene& loaded) {
  const Box& bounds = loaded.scene.bounds;
  const double resolved =
      0x1p-20 * (glm::length(bounds.centre()) + 0.5 * bounds.diagonal());  // m: a few units in the last place
  for (const Medium& medium : loaded.scene.media) {
    const double extinction = double(max_channel(medium.sigma_t)) * medium.max_density();  // 1/m
    if (medium.scatters() && extinction * resolved > 1.0)
      loaded.notes.push_back(fmt::format(
          "medium '{}': its free paths, down to {:.2g} m, are shorter than positions of this scene resolve, "
          "{:.2g} m: light that enters it stays there",
          medium.name, 1.0 / extinction, resolved));
  }
}

}  // namespace

LoadedScene load_scene(const std::string& path, const std::vector<std::string>& options, LeftOut left_out) {
  Document document = read_toml(path);
  for (const std::string& option : options) apply_override(document, option);
  std::vector<std::string> overrides = options;
  if (left_out == LeftOut::automatic)
    for (const std::string& option : left_to_choose(document)) {
      apply_override(document, option);
      overrides.push_back(option);
    }
  LoadedScene loaded;
  TableReader root(document.root, "the scene file", loaded.files);
  ScenePlan plan = read_plan(root, loaded);
  load_grids(plan, loaded);
  loaded.hash = hash_of(document.text, overrides, loaded.files);

  Scene& scene = loaded.scene;
  add_shapes(plan, loaded);
  for (MediumPlan& medium : plan.media) scene.media.push_back(std::move(medium.medium));
  for (MaterialPlan& material : plan.materials) {
    scene.materials.push_back(material.material);
    scene.textures.push_back(std::move(material.texture));
  }
  for (LightPlan& light : plan.lights) {
    scene.lights.push_back(std::move(light.light));
    loaded.light_names.push_back(std::move(light.name));
  }
  scene.world_medium = plan.world;
  scene.camera = plan.camera;
  scene.camera_medium = plan.camera_medium ? *plan.camera_medium : medium_around(scene, scene.camera.position);
  try {
    finish(scene);
  } catch (const InputError& error) {
    fail_at(plan.lights_place, error.what());
  }
  check_media(scene, plan);
  check_faces(scene, plan);
  note_unresolved_place(loaded);
  note_unresolved_media(loaded);
  return loaded;
}

}  // namespace vpm
