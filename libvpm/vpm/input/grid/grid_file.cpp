// Reading grids with OpenVDB: one grid at a time, its bytes checked first, then its values.
#include "vpm/input/grid/grid_file.h"

#include <fmt/format.h>
#include <openvdb/tools/LevelSetUtil.h>
#include <limits>
#include <utility>

#include "vpm/base/cancel.h"
#include "vpm/base/error.h"
#include "vpm/base/letters.h"
#include "vpm/input/grid/vdb_bricks.h"
#include "vpm/input/grid/vdb_layout.h"

namespace vpm {
namespace {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::FloatGrid;
using openvdb::FloatTree;

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

/// The values of a grid of other numbers as floats. Throws InputError where one is beyond them.
template <class Grid>
FloatGrid::Ptr rounded(const Grid& other, const VdbFile& file, const VdbGridEntry& entry) {
  const auto narrow = [&](auto number, auto&& where) {
    const auto value = static_cast<double>(number);
    const auto rounded = static_cast<float>(value);
    if (std::isinf(rounded) && std::isfinite(value))
      file.refuse(entry.name, fmt::format("has a value ({}){} that is beyond floats", value, where()));
    // A negative value stays one, however small, so that it is refused or counted.
    return value < 0.0 && rounded == 0.0f ? -std::numeric_limits<float>::denorm_min() : rounded;
  };
  const auto round = [&](auto value, const Coord& voxel) {
    return narrow(value, [&] { return fmt::format(" at voxel ({}, {}, {})", voxel.x(), voxel.y(), voxel.z()); });
  };
  const FloatGrid::Ptr grid = new_grid<FloatGrid>();
  FloatTree& tree = grid->tree();
  tree.root().setBackground(narrow(other.background(), [] { return ", its background,"; }), false);
  auto tile = other.tree().cbeginValueAll();
  tile.setMaxDepth(Grid::TreeType::ValueAllCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) {
    cancellation_point();
    tree.addTile(tile.getLevel(), tile.getCoord(), round(*tile, tile.getCoord()), tile.isValueOn());
  }
  for (auto from = other.tree().cbeginLeaf(); from; ++from) {
    cancellation_point();
    FloatTree::LeafNodeType& to = *tree.touchLeaf(from->origin());
    for (openvdb::Index i = 0; i < from->SIZE; ++i) {
      to.setValueOnly(i, round(from->getValue(i), from->offsetToGlobalCoord(i)));
      to.setActiveState(i, from->isValueOn(i));
    }
  }
  return grid;
}

/// The values of a grid of any numbers as floats.
FloatGrid::Ptr as_floats(const openvdb::GridBase::Ptr& grid, const VdbFile& file, const VdbGridEntry& entry) {
  using Others = openvdb::TypeList<openvdb::DoubleGrid, openvdb::Int32Grid, openvdb::Int64Grid, openvdb::BoolGrid,
                                   openvdb::MaskGrid>;
  FloatGrid::Ptr floats = openvdb::gridPtrCast<FloatGrid>(grid);
  if (!floats) std::as_const(*grid).apply<Others>([&](const auto& other) { floats = rounded(other, file, entry); });
  return floats;
}

/// Reads the values of an entry, which is scalar and affine; other numbers become floats. Throws InputError where its
/// bytes are damaged.
FloatGrid::Ptr read_values(VdbFile& file, const VdbGridEntry& entry) {
  const VdbGridEntry* source = entry.tree_of.empty() ? &entry : file.layout.find(entry.tree_of);
  if (!source || source->type != entry.type || !source->tree_of.empty() || !source->affine())
    file.refuse(entry.name, fmt::format("shares the tree of '{}', which cannot be read", entry.tree_of));
  read_transform(file, *source);
  check_vdb_tree(file.cursor, *source);
  std::istream& stream = file.cursor.stream();
  openvdb::io::setDataCompression(stream, source->compression);
  openvdb::io::setGridBackgroundValuePtr(stream, nullptr);
  const openvdb::GridBase::Ptr grid = openvdb::GridBase::createGrid(entry.type);
  grid->setSaveFloatAsHalf(source->stored_half);
  grid->readTopology(stream);
  grid->readBuffers(stream);
  return as_floats(grid, file, entry);
}

// Summaries
// ----------------------------------------------------------------------------------------------------

ValueRange active_range(const FloatTree& tree) {
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

void summarize_values(const FloatTree& tree, GridSummary& summary) {
  const openvdb::TreeBase& base = tree;
  summary.active_voxels = base.activeVoxelCount();
  summary.active_tiles = base.activeTileCount();
  summary.background = static_cast<double>(tree.background());
  summary.memory_bytes = base.memUsage();
  CoordBBox box;
  if (!base.evalActiveVoxelBoundingBox(box)) return;
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

GridSummary heading_of(const VdbGridEntry& entry) {
  GridSummary summary;
  summary.name = entry.name;
  summary.value_type = entry.value_type();
  summary.grid_class = entry.grid_class;
  summary.active_voxels = entry.stated_voxels;
  summary.numbers = entry.scalar();
  return summary;
}

GridSummary summarize(VdbFile& file, const VdbGridEntry& entry) {
  GridSummary summary = heading_of(entry);
  try {
    if (entry.affine()) summarize_transform(index_to_world(*read_transform(file, entry)), summary);
    if (entry.scalar() && entry.affine()) summarize_values(read_values(file, entry)->tree(), summary);
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
  float value = 0.0f;  // at `first`

  void add(uint64_t voxels, const Coord& where, float what) {
    if (count == 0) {
      first = where;
      value = what;
    }
    count += voxels;
  }
};

/// Counts the voxels of the box, active or not, with bad(value).
template <class Bad>
Fault find_faults(const FloatTree& tree, const CoordBBox& box, Bad&& bad) {
  Fault fault;
  auto tile = tree.cbeginValueAll();
  tile.setMaxDepth(FloatTree::ValueAllCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) {
    cancellation_point();
    if (!bad(*tile)) continue;
    CoordBBox shared;
    tile.getBoundingBox(shared);
    shared.intersect(box);
    if (!shared.empty()) fault.add(shared.volume(), shared.min(), *tile);
  }
  for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) {
    cancellation_point();
    for (openvdb::Index i = 0; i < leaf->SIZE; ++i) {
      if (!bad(leaf->getValue(i))) continue;
      const Coord where = leaf->offsetToGlobalCoord(i);
      if (box.isInside(where)) fault.add(1, where, leaf->getValue(i));
    }
  }
  return fault;
}

bool not_finite(float value) { return !std::isfinite(value); }

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
void convert_level_set(const DensitySource& source, FloatGrid& grid) {
  if (source.entry.grid_class == "fog volume") source.refuse("is a fog volume already; leave out from_level_set");
  if (!(grid.background() > 0.0f) || not_finite(grid.background()))
    source.refuse(fmt::format("is not a level set: its background is {}, not the positive width of a narrow band",
                              grid.background()));
  const Fault fault = find_faults(grid.tree(), CoordBBox::inf(), not_finite);
  if (fault.count) source.refuse(fault, "NaN or infinite", "");
  openvdb::tools::sdfToFogVolume(grid);
}

/// The box of the active voxels.
CoordBBox active_box(const DensitySource& source, const openvdb::TreeBase& tree) {
  CoordBBox box;
  if (!tree.evalActiveVoxelBoundingBox(box) || tree.activeVoxelCount() == 0) source.refuse("has no active voxels");
  constexpr int kFarthest = 1 << 30;
  if (std::min(box.min().x(), std::min(box.min().y(), box.min().z())) < -kFarthest ||
      std::max(box.max().x(), std::max(box.max().y(), box.max().z())) > kFarthest)
    source.refuse("has active voxels beyond index 2^30");
  return box;
}

/// The density outside the box.
float outside_density(const DensitySource& source, float background, uint64_t& clamped) {
  if (!std::isfinite(background)) source.refuse(fmt::format("has the background {}", background));
  if (background < 0.0f) {
    if (!source.request.clamp_negative)
      source.refuse(fmt::format("has the negative background {}; clamp_negative = true reads it as 0", background));
    ++clamped;
    background = 0.0f;
  }
  if (background > 0.0f && !source.request.has_bounding_shape)
    source.refuse(fmt::format(
        "has the background {}, {}", background,
        source.request.density ? "which would fill all space; bound the medium by a shape" : "which must be 0 here"));
  return background;
}

LoadedGrid make_density(const DensitySource& source, FloatTree& tree) {
  LoadedGrid loaded;
  const CoordBBox box = active_box(source, tree);
  const float background = outside_density(source, tree.background(), loaded.clamped_values);
  const Fault broken = find_faults(tree, box, not_finite);
  if (broken.count) source.refuse(broken, "NaN or infinite", "");
  const Fault negative = find_faults(tree, box, [](float value) { return value < 0.0f; });
  if (negative.count && !source.request.clamp_negative)
    source.refuse(negative, "negative", "; clamp_negative = true reads them as 0");
  loaded.clamped_values += negative.count;
  const GridFrame frame{source.index_to_world, to_vec(box.min()), to_vec(box.max()), source.request.interpolation,
                        background};
  try {
    loaded.grid = density_of(tree, frame);
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
    file.refuse(entry->name, fmt::format("holds {} values; one number a voxel is wanted", entry->value_type()));
  if (!entry->affine())
    file.refuse(entry->name, fmt::format("has a transform ({}) that is not affine", entry->map_type));
  if (entry->grid_class == "level set" && !request.from_level_set)
    file.refuse(entry->name, request.density
                                 ? "is a level set, not a density; from_level_set = true turns it into a fog volume"
                                 : "is a level set, which says nothing of what is emitted");
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

/// A grid of density 0: a voxel at the origin.
LoadedGrid vacuum(const DensitySource& source) {
  const GridFrame frame{source.index_to_world, Vec3i(0), Vec3i(0), source.request.interpolation, 0.0f};
  const auto nothing = [](const Vec3i&, float* values) {
    values[0] = 0.0f;
    return DensityGrid::Filled::one;
  };
  return {std::make_shared<const DensityGrid>(frame, nothing),
          0,
          {fmt::format("grid '{}' has no active voxels: it is vacuum", source.entry.name)}};
}

/// What the name of a grid that is taken for a density says that it is, in a note; "" where it says nothing else.
std::string doubt_of_name(const std::string& name) {
  const std::string small = small_letters(name);
  for (const char* other : {"temperature", "heat", "flame", "fuel", "burn"})
    if (small.find(other) != std::string::npos)
      return fmt::format("grid '{}' is taken for a density, though its name says {}", name, other);
  return "";
}

}  // namespace

Box world_box(const Mat4d& m, const Vec3i& lo, const Vec3i& hi) {
  Box box;
  for (int i = 0; i < 8; ++i)
    box.add(Vec3(m * glm::dvec4(i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z, 1.0)));
  return box;
}

std::vector<GridSummary> list_headings(const std::string& path) {
  VdbFile file(path);
  std::vector<GridSummary> headings;
  for (const VdbGridEntry& entry : file.layout.grids) headings.push_back(heading_of(entry));
  return headings;
}

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
    const FloatGrid::Ptr grid = read_values(file, entry);
    if (request.from_level_set) convert_level_set(source, *grid);
    const openvdb::TreeBase& tree = grid->tree();
    if (tree.activeVoxelCount() == 0 && grid->background() == 0.0f) return vacuum(source);
    LoadedGrid loaded = make_density(source, grid->tree());
    if (std::string doubt = doubt_of_name(entry.name); request.density && !doubt.empty())
      loaded.notes.push_back(std::move(doubt));
    return loaded;
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    file.refuse(entry.name, "needs more memory than there is");
  } catch (const std::exception& e) {
    file.refuse(entry.name, fmt::format("cannot be read: {}", e.what()));
  }
}

}  // namespace vpm
