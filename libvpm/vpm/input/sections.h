// The readers of a scene file's sections, one file each. They check everything that can be checked without reading a
// grid.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vpm/image/exr.h"
#include "vpm/input/given_parts.h"
#include "vpm/input/table_reader.h"
#include "vpm/integrators/render_scene.h"
#include "vpm/job/render_job.h"
#include "vpm/scene/parts.h"

namespace vpm {

/// Names that other sections refer to, with the number of each: its place in the list.
using Names = std::vector<std::string>;

/// The number of the medium named by `key`, kVacuum for "vacuum"; `fallback` where the key is missing.
MediumId read_medium_name(TableReader& table, const std::string& key, const Names& media, MediumId fallback);

// Each plan is a part of the scene and the table that it was read from, for errors.

/// A grid that is not read yet.
struct GridPlan {
  const GridRole& role;  // of kGridRoles
  GridRequest request;
  const GridValues* given;  // in the place of its file; null: the file is to be read
  TableReader table;        // that names it ...
  const char* key;          // ... under this
};
/// A medium without its grids.
struct MediumPlan {
  MediumPart part;
  TableReader table;
  std::vector<GridPlan> grids;
};
/// Reads [media.*].
std::vector<MediumPlan> read_media(TableReader& section, const Names& names, const GivenParts& given);

/// A material.
struct MaterialPlan {
  MaterialPart part;
  TableReader table;
};
/// Reads one material.
MaterialPlan read_material(TableReader table);
/// Reads [materials.*], in the file's order.
std::vector<MaterialPlan> read_materials(TableReader& section);
/// The key `reflectance`: an rgb in [0, 1], or a table that names a picture, which the part then holds; its mean is
/// returned. A fallback is what a missing key stands for.
Rgb read_reflectance(TableReader& table, MaterialPart& part, std::optional<Rgb> fallback = {});

/// The first texel of a picture that is not finite, below 0, or above `largest`: "column 3, row 0"; "" where there is
/// none.
std::string first_texel_outside(const Image& image, float largest);
/// The picture of an EXR file under `key`, of the layer that the table names.
ExrPicture read_exr_layer(TableReader& table, const std::string& key, const std::string& path);

/// A shape.
struct ShapePlan {
  ShapePart part;
  TableReader table;
};
/// What shapes may name: media and materials; which medium is around those that name none; and meshes that are given.
struct ShapeContext {
  const Names &media, &materials;
  MediumId world;
  const GivenParts& given;
};
/// Reads [[shapes]]; appends materials that shapes define in place to `materials`.
std::vector<ShapePlan> read_shapes(std::vector<TableReader>& tables, const ShapeContext& context,
                                   std::vector<MaterialPlan>& materials);

/// The affine map of a list of steps, applied in the list's order; the identity where `key` is missing. Refuses
/// singular ones.
Mat4d read_transform(TableReader& table, const std::string& key);

/// A light.
struct LightPlan {
  LightPart part;
  TableReader table;
};
/// The emission under `key`, which is not black.
Rgb read_emitted(TableReader& table, const std::string& key);
/// Reads a light of the kind "environment", but for its name.
LightPart read_environment(TableReader& table);
/// Reads [[lights]].
std::vector<LightPlan> read_lights(std::vector<TableReader>& tables);

/// A detector.
struct DetectorPlan {
  Detector detector;
  TableReader table;
};
/// Reads [[detectors]]: those without a name are "detector 0" and so on, by their places.
std::vector<DetectorPlan> read_detectors(std::vector<TableReader>& tables, const Names& media);

/// Reads [camera] and [film].
Camera read_camera(TableReader& camera, std::optional<TableReader>& film);

/// Reads [render] and [integrator], and validates the settings against the scene. Where a value is "auto" the settings
/// hold its default, and the job its key. What components do not have that options of the document put in the place of
/// others is left out, with a note in the job; other keys that they do not have are refused.
RenderSettings read_settings(TableReader& root, const Document& document, const SceneFacts& facts, LeftOut left_out,
                             RenderJob& job);

}  // namespace vpm
