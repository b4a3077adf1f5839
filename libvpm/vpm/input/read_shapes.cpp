// The section [[shapes]].
#include <algorithm>

#include "vpm/base/error.h"
#include "vpm/input/mesh/mesh_file.h"
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

/// `given`: the mesh is in memory, and the key `mesh` describes it.
TriangleMesh read_mesh(TableReader& table, ShapePart& part, const TriangleMesh* given) {
  const std::string key = given ? "mesh" : "path";
  const std::string source = given ? table.string(key) : table.path(key);
  try {
    LoadedMesh loaded = given ? checked_mesh(source, *given) : load_mesh(source);
    part.notes = loaded.notes;
    return std::move(loaded.mesh);
  } catch (const InputError& error) {
    table.fail(key, error.what());
  }
}

/// Boxes, quads and meshes, where their transform puts them.
TriangleMesh read_triangles(TableReader& table, TriangleMesh mesh, ShapePart& part) {
  transform_mesh(read_transform(table, "transform"), mesh);
  for (const Vec3& p : mesh.positions)
    if (!is_finite(p))
      table.fail("transform", "the transform moves a point of " + table.title() + " out of single precision");
  part.notes.without_area += drop_flat_triangles(mesh);
  if (mesh.triangles.empty())
    table.fail(table.has("transform") ? "transform" : "type",
               "no triangle of " + table.title() + " has an area where it lies: single precision resolves none",
               "make it larger, or move it nearer to the origin");
  return mesh;
}

Surface read_surface(TableReader& table, ShapePart& part, const TriangleMesh* given) {
  enum class Kind { sphere, disc, quad, box, mesh };
  switch (table.choice<Kind>("type", {{"sphere", Kind::sphere},
                                      {"disc", Kind::disc},
                                      {"quad", Kind::quad},
                                      {"box", Kind::box},
                                      {"mesh", Kind::mesh}})) {
    case Kind::sphere:
      return read_sphere(table);
    case Kind::disc:
      return read_disc(table);
    case Kind::quad:
      return QuadMesh{read_triangles(table, read_quad(table), part)};
    case Kind::box:
      return read_triangles(table, read_box(table), part);
    case Kind::mesh:
      return read_triangles(table, read_mesh(table, part, given), part);
  }
  __builtin_unreachable();
}

ShapePart read_shape(TableReader& table, const ShapeContext& context, const TriangleMesh* given,
                     std::vector<MaterialPlan>& materials) {
  ShapePart part;
  part.name = table.string("name", "");
  part.title = table.title();
  part.surface = read_surface(table, part, given);
  part.material = read_shape_material(table, context.materials, materials);
  const Interface sides{read_medium_name(table, "inside", context.media, context.world),
                        read_medium_name(table, "outside", context.media, context.world)};
  if (table.has("inside") || table.has("outside")) part.media = sides;
  if (table.has("emission")) part.emission = table.rgb("emission", kNotNegative);
  table.finish();
  return part;
}

}  // namespace

std::vector<ShapePlan> read_shapes(std::vector<TableReader>& tables, const ShapeContext& context,
                                   std::vector<MaterialPlan>& materials) {
  std::vector<ShapePlan> plans;
  for (TableReader& table : tables) {
    ShapePart part = read_shape(table, context, context.given.mesh(plans.size()), materials);
    plans.push_back({std::move(part), table});
  }
  return plans;
}

}  // namespace vpm
