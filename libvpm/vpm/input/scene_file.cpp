// From a scene file to a Scene: reads the sections, then the grids, has the parts put together, and says at which
// place in the file a part is refused.
#include "vpm/input/scene_file.h"

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>

#include "vpm/base/error.h"
#include "vpm/base/fnv.h"
#include "vpm/input/fingerprint.h"
#include "vpm/input/sections.h"
#include "vpm/scene/assemble.h"
#include "vpm/scene/check_parts.h"

namespace vpm {
namespace {

/// The file's sections with names resolved, grids not read yet.
struct ScenePlan {
  MediumId world_medium = kVacuum;
  std::vector<MediumPlan> media;
  std::vector<MaterialPlan> materials;
  std::vector<ShapePlan> shapes;
  std::vector<LightPlan> lights;
  std::vector<DetectorPlan> detectors;
  std::array<bool, 3> cyclic{};
  Camera camera;
  std::optional<MediumId> camera_medium;
  std::optional<TableReader> world_table, camera_table;
};

Names keys_of(const TableReader* section) { return section ? section->keys() : Names{}; }

void read_media_and_world(TableReader& root, const GivenParts& given, ScenePlan& plan, Names& names) {
  std::optional<TableReader> media = root.table("media", "[media]");
  names = keys_of(media ? &*media : nullptr);
  plan.world_table = root.table("world", "[world]");
  if (plan.world_table) {
    plan.world_medium = read_medium_name(*plan.world_table, "medium", names, kVacuum);
    if (plan.world_table->has("cyclic"))
      for (const std::string& axis : plan.world_table->words("cyclic", {"x", "y", "z"}))
        plan.cyclic[axis[0] - 'x'] = true;
    plan.world_table->finish();
  }
  if (media) plan.media = read_media(*media, names, given);
}

void read_camera_section(TableReader& root, const Names& media, ScenePlan& plan) {
  if (!root.has("camera"))
    root.fail_here(root.title() + " lacks the table [camera]",
                   "add [camera] with position, target and fov: scenes/README.md begins with a whole scene");
  plan.camera_table = root.table("camera", "[camera]");
  TableReader& camera = *plan.camera_table;
  std::optional<TableReader> film = root.table("film", "[film]");
  plan.camera = read_camera(camera, film);
  if (camera.has("medium")) plan.camera_medium = read_medium_name(camera, "medium", media, kVacuum);
  camera.finish();
}

SceneFacts facts_of(const ScenePlan& plan) {
  SceneFacts facts;
  for (const MediumPlan& medium : plan.media) {
    for (const GridPlan& grid : medium.grids) facts.grids |= grid.role.grid == &Medium::grid;  // not read yet
    facts.scattering_media |= medium.part.medium.scatters();
    facts.emitting_media |= medium.part.medium.emits();
  }
  if (plan.world_medium != kVacuum) facts.add_world(plan.media[plan.world_medium].part.medium);
  for (const ShapePlan& shape : plan.shapes)
    facts.rough_surfaces |= is_rough(plan.materials[shape.part.material].part.material);
  return facts;
}

ScenePlan read_plan(TableReader& root, const Document& document, const GivenParts& given, LeftOut left_out,
                    RenderJob& job) {
  ScenePlan plan;
  Names media;
  read_media_and_world(root, given, plan, media);
  std::optional<TableReader> materials = root.table("materials", "[materials]");
  if (materials) plan.materials = read_materials(*materials);
  std::vector<TableReader> shapes = root.tables("shapes", "[[shapes]]");
  const Names material_names = keys_of(materials ? &*materials : nullptr);
  plan.shapes = read_shapes(shapes, {media, material_names, plan.world_medium, given}, plan.materials);
  std::vector<TableReader> lights = root.tables("lights", "[[lights]]");
  plan.lights = read_lights(lights);
  std::vector<TableReader> detectors = root.tables("detectors", "[[detectors]]");
  plan.detectors = read_detectors(detectors, media);
  read_camera_section(root, media, plan);
  job.settings = read_settings(root, document, facts_of(plan), left_out, job);
  root.finish();
  return plan;
}

/// Does a table of the document, or an option, give a key?
bool gives(const Document& document, const std::vector<std::string>& options, const std::string& table_name,
           const std::string& key) {
  const Entry* const entry = find_entry(*document.root.table(), table_name);
  const Node::Table* const table = entry ? entry->node.table() : nullptr;
  const std::string begin = table_name + "." + key + "=";
  return (table && find_entry(*table, key)) ||
         std::any_of(options.begin(), options.end(),
                     [&](const std::string& option) { return option.starts_with(begin); });
}

/// Moves the parts out of the plan: the tables stay.
SceneParts parts_of(ScenePlan& plan) {
  SceneParts parts;
  for (MediumPlan& medium : plan.media) parts.media.push_back(std::move(medium.part));
  for (MaterialPlan& material : plan.materials) parts.materials.push_back(std::move(material.part));
  for (ShapePlan& shape : plan.shapes) parts.shapes.push_back(std::move(shape.part));
  for (LightPlan& light : plan.lights) parts.lights.push_back(std::move(light.part));
  for (DetectorPlan& detector : plan.detectors) parts.detectors.push_back(std::move(detector.detector));
  parts.world_medium = plan.world_medium;
  parts.cyclic = plan.cyclic;
  parts.camera = plan.camera;
  parts.camera_medium = plan.camera_medium;
  return parts;
}

/// Refuses what is wrong with a part at its place in the file: at the key of that name where the part's table has it.
[[noreturn]] void fail_at_part(const PartError& error, const TableReader& root, const ScenePlan& plan) {
  const PartName& part = error.part();
  const auto fail = [&](const TableReader& table, const std::string& key) {
    table.fail(key, error.wrong(), error.right());
  };
  switch (part.kind) {
    case PartKind::world:
      fail(*plan.world_table, "medium");
      break;
    case PartKind::cyclic:
      fail(*plan.world_table, "cyclic");
      break;
    case PartKind::camera:
      fail(*plan.camera_table, "");
      break;
    case PartKind::medium:
      fail(plan.media[part.number].table, part.field);
      break;
    case PartKind::material:
      fail(plan.materials[part.number].table, part.field);
      break;
    case PartKind::shape:
      fail(plan.shapes[part.number].table, part.field);
      break;
    case PartKind::light:
      fail(plan.lights[part.number].table, part.field);
      break;
    case PartKind::detector:
      fail(plan.detectors[part.number].table, part.field);
      break;
    case PartKind::lights:
      fail(root, "lights");
      break;
    case PartKind::scene:
      break;
  }
  root.fail_here(error.wrong(), error.right());
}

void load_grid_of(Medium& medium, const GridPlan& plan, const GridRequest& request, const GridLoader& load,
                  RenderJob& job) {
  try {
    LoadedGrid grid =
        plan.given ? density_of(*plan.given, request) : load({medium.name, std::string(plan.role.name)}, request);
    medium.*plan.role.grid = std::move(grid.grid);
    job.clamped_density_values += grid.clamped_values;
    for (const std::string& note : grid.notes) job.notes.push_back("medium '" + medium.name + "': " + note);
    if (grid.clamped_values > 0)
      job.notes.push_back("medium '" + medium.name + "': " + std::to_string(grid.clamped_values) + " negative " +
                          (plan.request.density ? "densities" : "values of its emission") +
                          " set to 0, as clamp_negative asks");
  } catch (const InputError& error) {
    plan.table.fail(plan.given ? "grid" : plan.key, error.what());
  }
}

/// Reads the grids of media into their parts.
void load_grids(const ScenePlan& plan, const GridLoader& load, SceneParts& parts, RenderJob& job) {
  for (size_t i = 0; i < plan.media.size(); ++i) {
    const MediumPlan& medium = plan.media[i];
    for (const GridPlan& grid : medium.grids) {
      GridRequest request = grid.request;
      const bool density = grid.role.grid == &Medium::grid;
      request.has_bounding_shape = density && !is_boxed(parts, static_cast<MediumId>(i));
      load_grid_of(parts.media[i].medium, grid, request, load, job);
    }
  }
}

/// Reads what the plan names and puts all together.
void assemble_plan(ScenePlan& plan, const GridLoader& load, RenderJob& job) {
  SceneParts parts = parts_of(plan);
  check_parts(parts);  // before the grids are read, which takes long
  load_grids(plan, load, parts, job);
  AssembledScene assembled = assemble(std::move(parts));
  job.scene = std::move(assembled.scene);
  job.light_names = std::move(assembled.light_names);
  for (std::string& note : assembled.notes) job.notes.push_back(std::move(note));
}

std::string hash_of(const TriangleMesh& mesh) {
  Fnv1a hash;
  const auto add = [&](const auto& list) {
    hash.add({reinterpret_cast<const char*>(list.data()), list.size() * sizeof(list[0])});
    hash.add(std::to_string(list.size()));  // keeps lists apart
  };
  add(mesh.positions);
  add(mesh.triangles);
  add(mesh.normals);
  add(mesh.uvs);
  return hash.digits();
}

/// Names and hashes of parts that are in memory.
std::vector<std::pair<std::string, std::string>> hashes_of(const GivenParts& given) {
  std::vector<std::pair<std::string, std::string>> hashes;
  for (const auto& [name, grid] : given.grids)
    hashes.emplace_back(fmt::format("{} of {}", name.role, name.medium), hash_of(grid));
  for (const auto& [shape, mesh] : given.meshes)
    hashes.emplace_back("mesh of shape " + std::to_string(shape), hash_of(mesh));
  return hashes;
}

/// A scene file with its options applied becomes a job.
RenderJob job_of(const Document& document, const GivenParts& given, LeftOut left_out, const GridLoader& load) {
  RenderJob job;
  TableReader root(document.root, "the scene file", job.files);
  ScenePlan plan = read_plan(root, document, given, left_out, job);
  try {
    assemble_plan(plan, load, job);
  } catch (const PartError& error) {
    fail_at_part(error, root, plan);
  }
  Fingerprint fingerprint = fingerprint_of(document, job.files, hashes_of(given), left_out);
  job.hash = std::move(fingerprint.hash);
  job.contents = std::move(fingerprint.contents);
  return job;
}

/// The same of one without its options.
RenderJob job_with(Document document, const std::vector<std::string>& options, LeftOut left_out,
                   const GivenParts& given, const GridLoader& load) {
  const bool all = left_out == LeftOut::all_automatic ||
                   (left_out == LeftOut::automatic && gives(document, options, "render", "seconds"));
  if (all && !gives(document, options, "integrator", "type"))
    apply_override(document, fmt::format("integrator.type={}", kAuto));  // first: what options say is not left out
  for (const std::string& option : options) apply_override(document, option);
  RenderJob job = job_of(document, given, left_out, load);
  job.source = document.sources.front()->name;
  job.overrides = options;
  job.chooses_defaults = left_out != LeftOut::defaults;
  return job;
}

LoadedGrid load_from_file(const GridName&, const GridRequest& request) { return load_grid(request); }

}  // namespace

std::vector<std::string> components_first(std::vector<std::string> overrides) {
  const auto place = [](const std::string& option) {
    const std::string key = option.substr(0, option.find('='));
    return key == "integrator.type" ? 0 : key.starts_with("integrator.") && key.ends_with(".type") ? 1 : 2;
  };
  std::stable_sort(overrides.begin(), overrides.end(),
                   [&](const std::string& a, const std::string& b) { return place(a) < place(b); });
  return overrides;
}

RenderJob load_scene(const std::string& path, const std::vector<std::string>& options, LeftOut left_out,
                     const GridLoader& load) {
  if (std::filesystem::path(path).extension() == ".vdb")
    throw InputError(fmt::format(
        "{}: this is a grid, not a scene: a scene file (.toml) names it in a medium, as scenes/smoke.toml does; "
        "vpm info {} lists what it holds",
        path, path));
  if (lower_extension(path) == ".pbrt")
    throw InputError(path + ": this is a scene of pbrt's, which is not read; scenes here are .toml files");
  return job_with(read_toml(path), options, left_out, {}, load ? load : load_from_file);
}

RenderJob load_scene(const SceneText& scene, const std::vector<std::string>& options, LeftOut left_out,
                     const GridLoader& load) {
  return job_with(parse_toml(scene.name, scene.text), options, left_out, scene.given, load ? load : load_from_file);
}

}  // namespace vpm
