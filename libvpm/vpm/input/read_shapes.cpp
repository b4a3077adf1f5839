// The section [[shapes]].
#include <algorithm>

#include "vpm/base/error.h"
#include "vpm/input/mesh_file.h"
#include "vpm/input/sections.h"

namespace vpm {
namespace {

/// The number of the shape's material, which it names or defines in place.
uint32_t read_shape_material(TableReader& table, const Names& names, std::vector<MaterialPlan>& materials) {
  if (table.require("material").table()) {
    materials.push_back(read_material(*table.table("material", "'material' of " + table.title())));
    return static_cast<uint32_t>(materials.size() - 1);
  }
  const std::string name = table.string("material");
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    table.fail("material", "there is no material '" + name + "'", suggest(name, names, "there are"));
  return static_cast<uint32_t>(found - names.begin());
}

SphereShape read_sphere(TableReader& table) { return {table.vector("center"), table.number("radius", kPositive)}; }

DiscShape read_disc(TableReader& table) {
  return {table.vector("center"), table.direction("normal"), table.number("radius", kPositive)};
}

TriangleMesh read_quad(TableReader& table) {
  const Vec3d corner(table.vector("corner")), u(table.vector("edge_u")), v(table.vector("edge_v"));
  if (!(glm::length(glm::cross(u, v)) > 1e-6 * glm::length(u) * glm::length(v)))
    table.fail("edge_v", "the edges of " + table.title() + " are parallel, or one is zero");
  return quad_mesh(corner, u, v);
}

TriangleMesh read_box(TableReader& table) {
  const Vec3 lo = table.vector("min"), hi = table.vector("max");
  if (!(lo.x < hi.x && lo.y < hi.y && lo.z < hi.z))
    table.fail("max", "'max' of " + table.title() + " must be larger than 'min' in every coordinate");
  return box_mesh(Vec3d(lo), Vec3d(hi));
}

TriangleMesh read_mesh(TableReader& table, ShapePlan& plan) {
  const std::string path = table.path("path");
  try {
    LoadedMesh loaded = load_mesh(path);
    plan.degenerate_triangles = loaded.degenerate_triangles;
    return std::move(loaded.mesh);
  } catch (const InputError& error) {
    table.fail("path", error.what());
  }
}

/// The quad's light: its corner and edges, in the order that keeps the normal.
QuadLight quad_light(const TriangleMesh& mesh, const Rgb& radiance) {
  const auto& p = mesh.positions;
  const glm::uvec3& t = mesh.triangles[0];
  const bool mirrored = t.y > t.z;
  const Vec3 u = p[1] - p[0], v = p[3] - p[0];
  return mirrored ? QuadLight{p[0], v, u, radiance} : QuadLight{p[0], u, v, radiance};
}

/// What the shape is once it emits: a quad and a mesh are both triangles.
Light light_of(const ShapePlan& plan, bool quad, const Rgb& radiance) {
  if (const auto* sphere = std::get_if<SphereShape>(&plan.surface))
    return SphereLight{sphere->centre, sphere->radius, radiance};
  if (const auto* disc = std::get_if<DiscShape>(&plan.surface))
    return DiscLight{disc->centre, disc->normal, disc->radius, radiance};
  const auto& mesh = std::get<TriangleMesh>(plan.surface);
  if (quad) return quad_light(mesh, radiance);
  return MeshLight{std::make_shared<EmittingMesh>(mesh), radiance};
}

void read_emission(TableReader& table, ShapePlan& plan, bool quad, const std::vector<MaterialPlan>& materials) {
  if (!table.has("emission")) return;
  const Rgb radiance = table.rgb("emission", kNotNegative);
  if (is_black(radiance)) table.fail("emission", "the emission of " + table.title() + " is black", "remove the key");
  if (is_boundary(materials[plan.shape.material].material))
    table.fail("emission", "a boundary has no surface that could emit", "give " + table.title() + " another material");
  plan.light = light_of(plan, quad, radiance);
}

bool has_uvs(const ShapePlan& plan) {
  const auto* mesh = std::get_if<TriangleMesh>(&plan.surface);
  return mesh ? !mesh->uvs.empty() : std::holds_alternative<SphereShape>(plan.surface);
}

/// Boxes, quads and meshes, where their transform puts them.
TriangleMesh read_triangles(TableReader& table, TriangleMesh mesh, ShapePlan& plan) {
  transform_mesh(read_transform(table, "transform"), mesh);
  for (const Vec3& p : mesh.positions)
    if (!is_finite(p))
      table.fail("transform", "the transform moves a point of " + table.title() + " out of single precision");
  plan.degenerate_triangles += drop_flat_triangles(mesh);
  if (mesh.triangles.empty())
    table.fail(table.has("transform") ? "transform" : "type",
               "no triangle of " + table.title() + " has an area where it lies: single precision resolves none",
               "make it larger, or move it nearer to the origin");
  return mesh;
}

ShapePlan read_shape(TableReader& table, const Names& media, const Names& material_names, MediumId world,
                     std::vector<MaterialPlan>& materials) {
  enum class Kind { sphere, disc, quad, box, mesh };
  ShapePlan plan;
  plan.place = table.place();
  plan.shape.name = table.string("name", "");
  const Kind kind = table.choice<Kind>(
      "type",
      {{"sphere", Kind::sphere}, {"disc", Kind::disc}, {"quad", Kind::quad}, {"box", Kind::box}, {"mesh", Kind::mesh}});
  plan.shape.material = read_shape_material(table, material_names, materials);
  plan.shape.separates_media = table.has("inside") || table.has("outside");
  plan.shape.media.inside = read_medium_name(table, "inside", media, world);
  plan.shape.media.outside = read_medium_name(table, "outside", media, world);
  if (kind == Kind::sphere) {
    plan.surface = read_sphere(table);
  } else if (kind == Kind::disc) {
    plan.surface = read_disc(table);
  } else {
    plan.surface = read_triangles(table,
                                  kind == Kind::quad  ? read_quad(table)
                                  : kind == Kind::box ? read_box(table)
                                                      : read_mesh(table, plan),
                                  plan);
  }
  read_emission(table, plan, kind == Kind::quad, materials);
  if (materials[plan.shape.material].texture && !has_uvs(plan))
    table.fail("material",
               "the material of " + table.title() + " has a texture, but the shape has no coordinates in it",
               "spheres and quads have them, and meshes whose file gives them to the vertices");
  table.finish();
  return plan;
}

}  // namespace

std::vector<ShapePlan> read_shapes(std::vector<TableReader>& tables, const Names& media, const Names& material_names,
                                   MediumId world, std::vector<MaterialPlan>& materials) {
  std::vector<ShapePlan> plans;
  for (TableReader& table : tables) {
    ShapePlan plan = read_shape(table, media, material_names, world, materials);
    const bool named = !plan.shape.name.empty();
    if (!named) plan.shape.name = "shape " + std::to_string(plans.size());
    for (const ShapePlan& other : plans)
      if (other.shape.name == plan.shape.name)
        table.fail("name", "two shapes are named '" + plan.shape.name + "'", "give each shape a name of its own");
    plans.push_back(std::move(plan));
  }
  return plans;
}

}  // namespace vpm
