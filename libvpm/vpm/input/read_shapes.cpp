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

TriangleMesh read_mesh(TableReader& table, ShapePart& part) {
  const std::string path = table.path("path");
  try {
    LoadedMesh loaded = load_mesh(path);
    part.degenerate_triangles = loaded.degenerate_triangles;
    return std::move(loaded.mesh);
  } catch (const InputError& error) {
    table.fail("path", error.what());
  }
}

/// Boxes, quads and meshes, where their transform puts them.
TriangleMesh read_triangles(TableReader& table, TriangleMesh mesh, ShapePart& part) {
  transform_mesh(read_transform(table, "transform"), mesh);
  for (const Vec3& p : mesh.positions)
    if (!is_finite(p))
      table.fail("transform", "the transform moves a point of " + table.title() + " out of single precision");
  part.degenerate_triangles += drop_flat_triangles(mesh);
  if (mesh.triangles.empty())
    table.fail(table.has("transform") ? "transform" : "type",
               "no triangle of " + table.title() + " has an area where it lies: single precision resolves none",
               "make it larger, or move it nearer to the origin");
  return mesh;
}

Surface read_surface(TableReader& table, ShapePart& part) {
  using Reader = Surface (*)(TableReader&, ShapePart&);
  const auto read = table.choice<Reader>(
      "type",
      {{"sphere", [](TableReader& t, ShapePart&) -> Surface { return read_sphere(t); }},
       {"disc", [](TableReader& t, ShapePart&) -> Surface { return read_disc(t); }},
       {"quad", [](TableReader& t, ShapePart& p) -> Surface { return QuadMesh{read_triangles(t, read_quad(t), p)}; }},
       {"box", [](TableReader& t, ShapePart& p) -> Surface { return read_triangles(t, read_box(t), p); }},
       {"mesh", [](TableReader& t, ShapePart& p) -> Surface { return read_triangles(t, read_mesh(t, p), p); }}});
  return read(table, part);
}

ShapePart read_shape(TableReader& table, const Names& media, const Names& material_names, MediumId world,
                     std::vector<MaterialPlan>& materials) {
  ShapePart part;
  part.name = table.string("name", "");
  part.title = table.title();
  part.surface = read_surface(table, part);
  part.material = read_shape_material(table, material_names, materials);
  const Interface sides{read_medium_name(table, "inside", media, world),
                        read_medium_name(table, "outside", media, world)};
  if (table.has("inside") || table.has("outside")) part.media = sides;
  if (table.has("emission")) part.emission = table.rgb("emission", kNotNegative);
  table.finish();
  return part;
}

}  // namespace

std::vector<ShapePlan> read_shapes(std::vector<TableReader>& tables, const Names& media, const Names& material_names,
                                   MediumId world, std::vector<MaterialPlan>& materials) {
  std::vector<ShapePlan> plans;
  for (TableReader& table : tables) {
    ShapePart part = read_shape(table, media, material_names, world, materials);
    plans.push_back({std::move(part), table});
  }
  return plans;
}

}  // namespace vpm
