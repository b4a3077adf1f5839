// The values of bricks, leaf by leaf, and where a sparse grid has any.
#include "vpm/input/grid/vdb_bricks.h"

#include <malloc.h>
#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace vpm {
namespace {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::FloatTree;

Coord to_coord(const Vec3i& v) { return {v.x, v.y, v.z}; }

/// Writes the 9^3 values of a brick: whole leaves and tiles, since a brick begins where a leaf does.
class BrickFiller {
 public:
  BrickFiller(const FloatTree& tree, const CoordBBox& box, float background)
      : accessor_(tree), box_(box), background_(background) {}

  DensityGrid::Filled operator()(const Vec3i& origin, float* values) {
    const std::optional<Tiles> before = std::exchange(last_, std::nullopt);
    if (fill_at_once(origin, values[0])) return DensityGrid::Filled::one;
    last_ = tiles_of(origin);
    if (last_ && last_ == before) return DensityGrid::Filled::as_last;
    for (int z = 0; z < kValues; z += kLeaf)
      for (int y = 0; y < kValues; y += kLeaf)
        for (int x = 0; x < kValues; x += kLeaf) fill_leaf(origin, Vec3i(x, y, z), values);
    return DensityGrid::Filled::all;
  }

 private:
  static constexpr int kValues = DensityGrid::kValues;
  static constexpr int kLeaf = 8;
  static constexpr int kLeafDepth = FloatTree::DEPTH - 1;  // as a tree gives the depth of a value

  /// The value of a brick that lies outside the box, or inside it where tiles have one value; false for others. Most
  /// bricks of a sparse grid are such.
  bool fill_at_once(const Vec3i& origin, float& value) {
    const Coord corner(origin.x, origin.y, origin.z);
    const CoordBBox brick(corner, corner.offsetBy(kValues - 1));
    value = background_;
    if (!box_.hasOverlap(brick)) return true;
    if (accessor_.getValueDepth(corner) == kLeafDepth) return false;
    value = density(accessor_.getValue(corner));
    if (value != background_ && !box_.isInside(brick)) return false;
    return lies_in_one_tile(origin, corner) || neighbours_have(value, corner);
  }

  /// What a brick without leaves is made of: the values of the tiles of its first leaf and of those beyond, and what of
  /// the brick lies in the box, in voxels from its corner.
  struct Tiles {
    std::array<float, 8> values;
    Vec3i lo, hi;

    bool operator==(const Tiles&) const = default;
  };

  std::optional<Tiles> tiles_of(const Vec3i& origin) {
    Tiles tiles;
    for (int i = 0; i < 8; ++i) {
      const Coord part = beyond(to_coord(origin), i);
      if (accessor_.getValueDepth(part) == kLeafDepth) return std::nullopt;
      tiles.values[static_cast<size_t>(i)] = accessor_.getValue(part);
    }
    tiles.lo = glm::clamp(to_vec(box_.min()) - origin, Vec3i(0), Vec3i(kValues));
    tiles.hi = glm::clamp(to_vec(box_.max()) - origin, Vec3i(-1), Vec3i(kValues - 1));
    return tiles;
  }

  /// The corner of one of the eight leaves that a brick reaches into.
  static Coord beyond(const Coord& corner, int number) {
    return corner.offsetBy(number & 1 ? kLeaf : 0, number & 2 ? kLeaf : 0, number & 4 ? kLeaf : 0);
  }

  bool lies_in_one_tile(const Vec3i& origin, const Coord& corner) {
    constexpr int kTile = 128;  // the smallest tile above the level of leaves
    const Vec3i place = origin & (kTile - 1);
    return std::max(place.x, std::max(place.y, place.z)) <= kTile - 2 * kLeaf &&
           accessor_.getValueDepth(corner) < kLeafDepth - 1;
  }

  /// Are the voxels of the brick that lie beyond its first leaf in tiles of this value, too?
  bool neighbours_have(float value, const Coord& corner) {
    for (int i = 1; i < 8; ++i) {
      const Coord other = beyond(corner, i);
      if (accessor_.getValueDepth(other) == kLeafDepth || density(accessor_.getValue(other)) != value) return false;
    }
    return true;
  }

  /// The part of the leaf (or tile) at origin + from that belongs to the brick.
  void fill_leaf(const Vec3i& origin, const Vec3i& from, float* values) {
    const Coord corner(origin.x + from.x, origin.y + from.y, origin.z + from.z);
    const auto* leaf = accessor_.probeConstLeaf(corner);
    const float tile = leaf ? 0.0f : density(accessor_.getValue(corner));
    const Vec3i count = glm::min(Vec3i(kLeaf), Vec3i(kValues) - from);
    const CoordBBox part(corner, corner.offsetBy(count.x - 1, count.y - 1, count.z - 1));
    const bool inside = box_.isInside(part);
    const bool constant = !leaf && (inside || tile == background_);
    for (int z = 0; z < count.z; ++z)
      for (int y = 0; y < count.y; ++y) {
        float* row = values + ((from.z + z) * kValues + from.y + y) * kValues + from.x;
        if (constant) {
          std::fill_n(row, count.x, tile);
          continue;
        }
        for (int x = 0; x < count.x; ++x) {
          const Coord where = corner.offsetBy(x, y, z);
          row[x] = !inside && !box_.isInside(where) ? background_ : leaf ? density(leaf->getValue(where)) : tile;
        }
      }
  }

  /// Negative values are read as 0.
  static float density(float value) { return std::max(0.0f, value); }

  openvdb::tree::ValueAccessor<const FloatTree> accessor_;
  CoordBBox box_;
  float background_;
  std::optional<Tiles> last_{};  // of the brick before, where it was no leaf's
};

/// Boxes of voxels around all in the box whose value is not the background's: leaves and tiles.
std::vector<IndexBox> occupied_boxes(const FloatTree& tree, const CoordBBox& box) {
  std::vector<IndexBox> occupied;
  const auto add = [&](CoordBBox voxels) {
    voxels.intersect(box);
    if (!voxels.empty()) occupied.push_back({to_vec(voxels.min()), to_vec(voxels.max())});
  };
  auto tile = tree.cbeginValueAll();
  tile.setMaxDepth(FloatTree::ValueAllCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) {
    CoordBBox voxels;
    if (*tile != tree.background() && tile.getBoundingBox(voxels)) add(voxels);
  }
  for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) add(leaf->getNodeBoundingBox());
  return occupied;
}

/// Frees the leaves of a tree, from below, and the pages that they took.
class LeafRemover {
 public:
  explicit LeafRemover(FloatTree& tree) : tree_(tree) {
    for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) corners_.push_back(leaf->origin());
    std::stable_sort(corners_.begin(), corners_.end(), [](const Coord& a, const Coord& b) { return a.z() > b.z(); });
  }

  void operator()(int z) {
    constexpr int kLeafEdge = 8;    // voxels
    constexpr size_t kTrim = 1024;  // leaves, of 2 MB
    const size_t before = corners_.size();
    for (; !corners_.empty() && corners_.back().z() + kLeafEdge <= z; corners_.pop_back())
      delete tree_.stealNode<FloatTree::LeafNodeType>(corners_.back(), 0.0f, false);
    freed_ += before - corners_.size();
    if (freed_ < kTrim) return;
    malloc_trim(0);  // leaves are small: the C library keeps their memory
    freed_ = 0;
  }

 private:
  FloatTree& tree_;
  std::vector<Coord> corners_;  // of the leaves that are left, the lowest last
  size_t freed_ = 0;            // since memory went back to the system
};

}  // namespace

std::shared_ptr<const DensityGrid> density_of(FloatTree& tree, const GridFrame& frame) {
  const CoordBBox box(to_coord(frame.lo), to_coord(frame.hi));
  return std::make_shared<const DensityGrid>(frame, BrickFiller(tree, box, frame.background), occupied_boxes(tree, box),
                                             LeafRemover(tree));
}

}  // namespace vpm
