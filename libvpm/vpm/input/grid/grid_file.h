// Density grids out of .vdb files, and what such a file holds.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "vpm/base/vec.h"
#include "vpm/medium/medium.h"

namespace vpm {

/// Least, greatest and mean value over the active voxels of a grid (a tile counts as the voxels that it fills).
struct ValueRange {
  double min = 0.0, max = 0.0, mean = 0.0;
};

/// What a grid of a file is, whether or not it can be a density.
struct GridSummary {
  std::string name;        // as a scene writes it: "density", or "density[1]" where the name repeats
  std::string value_type;  // "float", "float stored as half", "double", "int32", "vec3s", ...
  bool numbers = false;    // is a value one number, float, double, whole or bool? Below, "numbers" are such grids
  std::string grid_class;  // "fog volume", "level set", ..., "unknown"
  std::string problem;     // why the rest could not be read, or ""; below, what could not is left as it is here
  std::optional<Mat4d> index_to_world;  // the transform; none where it is not affine
  Vec3d voxel_size{0.0};                // m, lengths of the transform's columns
  Vec3d translation{0.0};               // m, world position of voxel (0, 0, 0)
  bool axis_aligned = false;            // the grid's axes lie along those of the world (mirrored or not)
  uint64_t active_voxels = 0;           // those that tiles fill included; of other types what the file states
  uint64_t active_tiles = 0;
  Vec3i lo{0}, hi{-1};               // index box of the active voxels, both ends included; empty: lo > hi
  Box world_box;                     // m, around the positions of those voxels
  std::optional<ValueRange> values;  // of numbers with active voxels; NaN or infinity show in it
  std::optional<double> background;  // of numbers
  uint64_t memory_bytes = 0;         // of numbers, as OpenVDB holds them in floats
};

/// The box of the world, m, around the positions of the voxels of an index box, both ends included.
Box world_box(const Mat4d& index_to_world, const Vec3i& lo, const Vec3i& hi);

/// The grids of a file, in its order. The values of numbers are read, of others only the heading. Throws
/// InputError for what is not a whole .vdb file; a single grid that cannot be read becomes a summary with its
/// `problem`.
std::vector<GridSummary> list_grids(const std::string& path);
/// The same from the headings alone, without any value: at once.
std::vector<GridSummary> list_headings(const std::string& path);

struct GridRequest {
  std::string path;
  std::string name{};  // empty: "density", in capitals or small letters, or the file's one grid
  Interpolation interpolation = Interpolation::trilinear;
  bool from_level_set = false;      // turn a level set into a fog volume: 1 inside, falling to 0 at the surface
  bool clamp_negative = false;      // read negative values as 0
  bool has_bounding_shape = false;  // the medium is bounded by a shape, so that a background may be other than 0
  bool density = true;              // else what a medium emits, or its temperature
  Mat4d object_to_world{1.0};       // applied after the grid's own transform

  bool operator==(const GridRequest&) const = default;
};

struct LoadedGrid {
  std::shared_ptr<const DensityGrid> grid;
  uint64_t clamped_values = 0;       // voxels inside the active box that were negative; a negative background adds 1
  std::vector<std::string> notes{};  // for people: what is possible, but suspicious
};

/// Reads a grid of numbers as a density. It fills the box of its active voxels: inside, every voxel has the value
/// that OpenVDB answers for it, active or not; outside, the background. A grid without active voxels, as of a frame
/// before the smoke appears, has the density 0 everywhere. Throws InputError, listing the grids of the
/// file, for whatever cannot be a density: no such grid, a level set (unless asked for), other types, a transform that
/// is not affine, a background other than 0 without a bounding shape, NaN, infinite or negative values, a damaged file,
/// so many occupied bricks that their table would take over 256 MiB, or 2^31 voxels from one to another.
LoadedGrid load_grid(const GridRequest& request);

/// What loads the grid of this name.
using GridLoader = std::function<LoadedGrid(const GridName& name, const GridRequest& request)>;

}  // namespace vpm
