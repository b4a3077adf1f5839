// Reading grids with OpenVDB: one grid at a time, its bytes checked first, then its values.
#include "vpm/input/grid_file.h"

#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetUtil.h>

#include "vpm/base/cancel.h"
#include "vpm/base/error.h"
#include "vpm/input/vdb_bricks.h"
#include "vpm/input/vdb_layout.h"

namespace vpm {
namespace {

using openvdb::Coord;
using openvdb::CoordBBox;

/// A file with its table of contents.
struct VdbFile {
  VdbCursor cursor;
  VdbLayout layout;

  explicit VdbFile(const std::string& path) : cursor(path), layout(read_vdb_layout(cursor)) {
    openvdb::initialize();
    openvdb::io::setVersion(cursor.stream(), {layout.library_major, layout.library_minor}, layout.file_version);
  }

  /// Throws InputError: what is wrong with a grid, and which grids there are.
  [[noreturn]] void refuse(const std::string& grid, const std::string& why) const {
    throw InputError(fmt::format("{}: grid '{}' {}; {}", cursor.path(), grid, why, layout.listing()));
  }
};

/// Calls use(typename Grid::Ptr) with an empty grid of the entry's type, which is scalar.
template <class Use>
auto with_grid_type(const VdbGridEntry& entry, Use&& use) {
  if (entry.type == openvdb::FloatGrid::gridType()) return use(openvdb::FloatGrid::create());
  return use(openvdb::DoubleGrid::create());
}

/// Reads an entry's transform, which is affine, and leaves the cursor behind it, where the tree begins.
openvdb::math::Transform::Ptr read_transform(VdbFile& file, const VdbGridEntry& entry) {
  auto transform = openvdb::math::Transform::createLinearTransform();
  file.cursor.seek(entry.transform_position);
  transform->read(file.cursor.stream());
  file.cursor.seek(static_cast<uint64_t>(file.cursor.stream().tellg()));
  return transform;
}

/// The transform as a matrix that acts on columns: OpenVDB's acts on rows, and its memory is the same.
Mat4d index_to_world(const openvdb::math::Transform& transform) {
  const openvdb::math::Mat4d rows = transform.baseMap()->getAffineMap()->getMat4();
  Mat4d columns;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) columns[i][j] = rows[i][j];
  return columns;
}

/// Reads the entry's tree into `grid`. Throws InputError where its bytes are damaged.
template <class Grid>
void read_tree(VdbFile& file, const VdbGridEntry& entry, Grid& grid) {
  const VdbGridEntry* source = entry.tree_of.empty() ? &entry : file.layout.find(entry.tree_of);
  if (!source || source->type != entry.type || !source->tree_of.empty() || !source->affine())
    file.refuse(entry.name, fmt::format("shares the tree of '{}', which cannot be read", entry.tree_of));
  read_transform(file, *source);
  check_vdb_tree(file.cursor, *source);
  std::istream& stream = file.cursor.stream();
  openvdb::io::setDataCompression(stream, source->compression);
  openvdb::io::setGridBackgroundValuePtr(stream, nullptr);
  grid.tree().readTopology(stream, source->stored_half);
  grid.tree().readBuffers(stream, source->stored_half);
}

// Summaries
// ----------------------------------------------------------------------------------------------------

Vec3i to_vec(const Coord& c) { return {c.x(), c.y(), c.z()}; }

template <class Tree>
ValueRange active_range(const Tree& tree) {
  ValueRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), 0.0};
  double sum = 0.0;
  double voxels = 0.0;
  uint32_t seen = 0;
  for (auto it = tree.cbeginValueOn(); it; ++it) {
    if (++seen % (1u << 16) == 0) cancellation_point();
    const double value = static_cast<double>(*it);
    const double count = static_cast<double>(it.getVoxelCount());
    range.min = std::min(range.min, value);  // passes over a NaN, which shows in the mean
    range.max = std::max(range.max, value);
    sum += value * count;
    voxels += count;
  }
  range.mean = sum / voxels;
  return range;
}

/// World-space box around the voxel positions of an index box.
Box world_box(const Mat4d& m, const Vec3i& lo, const Vec3i& hi) {
  Box box;
  for (int i = 0; i < 8; ++i)
    box.add(Vec3(m * glm::dvec4(i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z, 1.0)));
  return box;
}

template <class Tree>
void summarize_values(const Tree& tree, GridSummary& summary) {
  summary.active_voxels = tree.activeVoxelCount();
  summary.active_tiles = tree.activeTileCount();
  summary.background = static_cast<double>(tree.background());
  summary.memory_bytes = tree.memUsage();
  CoordBBox box;
  if (!tree.evalActiveVoxelBoundingBox(box)) return;
  summary.lo = to_vec(box.min());
  summary.hi = to_vec(box.max());
  if (summary.index_to_world) summary.world_box = world_box(*summary.index_to_world, summary.lo, summary.hi);
  summary.values = active_range(tree);
}

void summarize_transform(const Mat4d& m, GridSummary& summary) {
  summary.index_to_world = m;
  summary.translation = Vec3d(m[3]);
  summary.axis_aligned = true;
  for (int i = 0; i < 3; ++i) {
    const Vec3d axis = glm::abs(Vec3d(m[i]));
    summary.voxel_size[i] = glm::length(axis);
    if (std::max(axis.x, std::max(axis.y, axis.z)) < (1.0 - 1e-9) * summary.voxel_size[i]) summary.axis_aligned = false;
  }
}

GridSummary summarize(VdbFile& file, const VdbGridEntry& entry) {
  GridSummary summary;
  summary.name = entry.name;
  summary.value_type = entry.value_type();
  summary.grid_class = entry.grid_class;
  summary.active_voxels = entry.stated_voxels;
  try {
    if (entry.affine()) summarize_transform(index_to_world(*read_transform(file, entry)), summary);
    if (entry.scalar() && entry.affine())
      with_grid_type(entry, [&](auto grid) {
        read_tree(file, entry, *grid);
        summarize_values(grid->tree(), summary);
      });
  } catch (const std::exception& e) {
    summary.problem = e.what();
  }
  return summary;
}

// Densities
// ----------------------------------------------------------------------------------------------------

/// The values of one kind that a grid should not have.
struct Fault {
  uint64_t count = 0;
  Coord first;
  double value = 0.0;  // at `first`

  void add(uint64_t voxels, const Coord& where, double what) {
    if (count == 0) {
      first = where;
      value = what;
    }
    count += voxels;
  }
};

/// Counts the voxels of the box, active or not, with bad(value).
template <class Tree, class Bad>
Fault find_faults(const Tree& tree, const CoordBBox& box, Bad&& bad) {
  Fault fault;
  auto tile = tree.cbeginValueAll();
  tile.setMaxDepth(Tree::ValueAllCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) {
    if (!bad(*tile)) continue;
    CoordBBox shared;
    tile.getBoundingBox(shared);
    shared.intersect(box);
    if (!shared.empty()) fault.add(shared.volume(), shared.min(), static_cast<double>(*tile));
  }
  for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) {
    cancellation_point();
    for (openvdb::Index i = 0; i < leaf->SIZE; ++i) {
      if (!bad(leaf->getValue(i))) continue;
      const Coord where = leaf->offsetToGlobalCoord(i);
      if (box.isInside(where)) fault.add(1, where, static_cast<double>(leaf->getValue(i)));
    }
  }
  return fault;
}

template <class Value>
bool not_finite(Value value) {
  return !std::isfinite(static_cast<float>(value));
}

/// What a caller needs to refuse or accept values: where they are, and in which file.
struct DensitySource {
  const VdbFile& file;
  const VdbGridEntry& entry;
  const GridRequest& request;
  Mat4d index_to_world;

  [[noreturn]] void refuse(const std::string& why) const { file.refuse(entry.name, why); }
  [[noreturn]] void refuse(const Fault& fault, const std::string& kind, const std::string& remedy) const {
    const Vec3d p(index_to_world * glm::dvec4(Vec3d(to_vec(fault.first)), 1.0));
    refuse(fmt::format(
        "has {} {} value{}, the first ({}) at voxel ({}, {}, {}), world position ({:.6g}, {:.6g}, {:.6g}) m{}",
        fault.count, kind, fault.count == 1 ? "" : "s", fault.value, fault.first.x(), fault.first.y(), fault.first.z(),
        p.x, p.y, p.z, remedy));
  }
};

/// Turns a level set into the fog volume of its inside.
template <class Grid>
void convert_level_set(const DensitySource& source, Grid& grid) {
  if (source.entry.grid_class == "fog volume") source.refuse("is a fog volume already; leave out from_level_set");
  if (!(grid.background() > 0) || not_finite(grid.background()))
    source.refuse(fmt::format("is not a level set: its background is {}, not the positive width of a narrow band",
                              grid.background()));
  const Fault fault = find_faults(grid.tree(), CoordBBox::inf(), not_finite<typename Grid::ValueType>);
  if (fault.count) source.refuse(fault, "NaN or infinite", "");
  openvdb::tools::sdfToFogVolume(grid);
}

/// The box of the active voxels.
template <class Grid>
CoordBBox active_box(const DensitySource& source, const Grid& grid) {
  CoordBBox box;
  if (!grid.tree().evalActiveVoxelBoundingBox(box) || grid.tree().activeVoxelCount() == 0)
    source.refuse("has no active voxels");
  constexpr int kFarthest = 1 << 30;
  if (std::min(box.min().x(), std::min(box.min().y(), box.min().z())) < -kFarthest ||
      std::max(box.max().x(), std::max(box.max().y(), box.max().z())) > kFarthest)
    source.refuse("has active voxels beyond index 2^30");
  return box;
}

/// The density outside the box.
template <class Grid>
float outside_density(const DensitySource& source, const Grid& grid, uint64_t& clamped) {
  auto background = static_cast<float>(grid.background());
  if (!std::isfinite(background)) source.refuse(fmt::format("has the background {}", background));
  if (background < 0.0f) {
    if (!source.request.clamp_negative)
      source.refuse(fmt::format("has the negative background {}; clamp_negative = true reads it as 0", background));
    ++clamped;
    background = 0.0f;
  }
  if (background > 0.0f && !source.request.has_bounding_shape)
    source.refuse(
        fmt::format("has the background {}, which would fill all space; bound the medium by a shape", background));
  return background;
}

template <class Grid>
LoadedGrid make_density(const DensitySource& source, Grid& grid) {
  if (source.request.from_level_set) convert_level_set(source, grid);
  LoadedGrid loaded;
  const CoordBBox box = active_box(source, grid);
  const float background = outside_density(source, grid, loaded.clamped_values);
  const Fault broken = find_faults(grid.tree(), box, not_finite<typename Grid::ValueType>);
  if (broken.count) source.refuse(broken, "NaN or infinite", "");
  const Fault negative = find_faults(grid.tree(), box, [](auto value) { return value < 0; });
  if (negative.count && !source.request.clamp_negative)
    source.refuse(negative, "negative", "; clamp_negative = true reads them as 0");
  loaded.clamped_values += negative.count;
  const GridFrame frame{source.index_to_world, to_vec(box.min()), to_vec(box.max()), source.request.interpolation,
                        background};
  try {
    loaded.grid = density_of(grid, frame);
  } catch (const InputError& e) {
    source.refuse(fmt::format("is too large: {}", e.what()));
  }
  return loaded;
}

constexpr const char* kUsualName = "density";  // of a density among several grids

const VdbGridEntry& find_density(const VdbFile& file, const GridRequest& request) {
  const bool named = !request.name.empty(), one = file.layout.grids.size() == 1;
  const std::string name = named ? request.name : kUsualName;
  const VdbGridEntry* entry = !named && one ? &file.layout.grids.front() : file.layout.find(name);
  if (!entry)
    throw InputError(fmt::format("{}: has no single grid named '{}'{}; {}", request.path, name,
                                 named ? "" : ": name another one with grid = \"...\"", file.layout.listing()));
  if (!entry->scalar())
    file.refuse(entry->name, fmt::format("holds {} values; a density needs float or double", entry->value_type()));
  if (!entry->affine())
    file.refuse(entry->name, fmt::format("has a transform ({}) that is not affine", entry->map_type));
  if (entry->grid_class == "level set" && !request.from_level_set)
    file.refuse(entry->name, "is a level set, not a density; from_level_set = true turns it into a fog volume");
  return *entry;
}

Mat4d world_matrix(VdbFile& file, const VdbGridEntry& entry, const GridRequest& request) {
  Mat4d m = request.object_to_world * index_to_world(*read_transform(file, entry));
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      if (!std::isfinite(m[i][j])) file.refuse(entry.name, "has a transform that is not finite");
  const double volume = std::abs(glm::determinant(Mat3d(m)));
  const double box = glm::length(Vec3d(m[0])) * glm::length(Vec3d(m[1])) * glm::length(Vec3d(m[2]));
  if (!(volume > 1e-9 * box)) file.refuse(entry.name, "has a transform that flattens space");
  return m;
}

}  // namespace

std::vector<GridSummary> list_grids(const std::string& path) {
  VdbFile file(path);
  std::vector<GridSummary> summaries;
  for (const VdbGridEntry& entry : file.layout.grids) summaries.push_back(summarize(file, entry));
  return summaries;
}

LoadedGrid load_grid(const GridRequest& request) {
  VdbFile file(request.path);
  const VdbGridEntry& entry = find_density(file, request);
  try {
    const DensitySource source{file, entry, request, world_matrix(file, entry, request)};
    return with_grid_type(entry, [&](auto grid) {
      read_tree(file, entry, *grid);
      return make_density(source, *grid);
    });
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    file.refuse(entry.name, "needs more memory than there is");
  } catch (const std::exception& e) {
    file.refuse(entry.name, fmt::format("cannot be read: {}", e.what()));
  }
}

}  // namespace vpm
