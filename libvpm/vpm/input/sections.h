// The readers of a scene file's sections, one file each. They check everything that can be checked without reading a
// grid.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "vpm/input/grid_file.h"
#include "vpm/input/table_reader.h"
#include "vpm/render/automatic.h"
#include "vpm/render/settings.h"
#include "vpm/render/validate.h"
#include "vpm/scene/scene.h"
#include "vpm/surface/mesh.h"

namespace vpm {

/// Names that other sections refer to, with the number of each: its place in the list.
using Names = std::vector<std::string>;

/// The number of the medium named by `key`, kVacuum for "vacuum"; `fallback` where the key is missing.
MediumId read_medium_name(TableReader& table, const std::string& key, const Names& media, MediumId fallback);

/// Who draws the surface within which a grid medium is met.
enum class GridBoundary { automatic, box, shapes };

/// A medium as the file describes it, its grid not read yet.
struct MediumPlan {
  Medium medium;
  std::optional<GridRequest> grid;
  GridBoundary boundary = GridBoundary::automatic;
  MediumId outside = kVacuum;  // of the automatic box
  Place place, path_place;     // of the table and of the grid's path, for errors
};
/// Reads [media.*]. `world` is what [world] names.
std::vector<MediumPlan> read_media(TableReader& section, const Names& names, MediumId world);

/// A material and the picture that its reflectance is read from, null without.
struct MaterialPlan {
  Material material = Boundary{};
  std::shared_ptr<const Texture> texture;
};
/// Reads [materials.*], in the file's order.
std::vector<MaterialPlan> read_materials(TableReader& section);
/// The key `reflectance`: an rgb in [0, 1], or a table that names a picture, which the plan then holds; its mean is
/// returned. A fallback is what a missing key stands for.
Rgb read_reflectance(TableReader& table, MaterialPlan& plan, std::optional<Rgb> fallback = {});

/// The first texel of a picture that is not finite, below 0, or above `largest`: "column 3, row 0"; "" where there is
/// none.
std::string first_texel_outside(const Image& image, float largest);

/// A shape as the file describes it.
struct ShapePlan {
  Place place;  // of the shape in the file; of its medium for the box of a grid
  Shape shape;
  std::variant<TriangleMesh, SphereShape, DiscShape> surface;
  std::optional<Light> light;
  uint64_t degenerate_triangles = 0;  // dropped from a mesh
};
/// Reads [[shapes]]; appends materials that shapes define in place to `materials`.
std::vector<ShapePlan> read_shapes(std::vector<TableReader>& tables, const Names& media, const Names& material_names,
                                   MediumId world, std::vector<MaterialPlan>& materials);

/// Moves a mesh by an affine map. Its normals stay outward under mirrors too.
void transform_mesh(const Mat4d& transform, TriangleMesh& mesh);

/// The affine map of a list of steps, applied in the list's order; the identity where `key` is missing. Refuses
/// singular ones.
Mat4d read_transform(TableReader& table, const std::string& key);

/// A light as the file describes it.
struct LightPlan {
  std::string name;  // empty where it has none
  Light light;
};
/// Reads [[lights]].
std::vector<LightPlan> read_lights(std::vector<TableReader>& tables);

/// Reads [camera] and [film].
Camera read_camera(TableReader& camera, std::optional<TableReader>& film);

/// Reads the sections of all_settings(), and validates the settings against the scene. Where a value is "auto" the
/// settings hold its default, and `automatic` tells.
RenderSettings read_settings(TableReader& root, const SceneFacts& facts, AutomaticSettings& automatic);

}  // namespace vpm
