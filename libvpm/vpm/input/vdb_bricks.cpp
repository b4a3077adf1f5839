// The values of bricks, leaf by leaf, and where a sparse grid has any.
#include "vpm/input/vdb_bricks.h"

#include <algorithm>
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

  void operator()(const Vec3i& origin, float* values) {
    if (fill_at_once(origin, values)) return;
    for (int z = 0; z < kValues; z += kLeaf)
      for (int y = 0; y < kValues; y += kLeaf)
        for (int x = 0; x < kValues; x += kLeaf) fill_leaf(origin, Vec3i(x, y, z), values);
  }

 private:
  static constexpr int kValues = DensityGrid::kValues;
  static constexpr int kLeaf = 8;

  /// Fills a brick that lies outside the box, or inside it within one large tile; false for others. Most bricks of a
  /// sparse grid are such.
  bool fill_at_once(const Vec3i& origin, float* values) {
    const Coord corner(origin.x, origin.y, origin.z);
    const CoordBBox brick(corner, corner.offsetBy(kValues - 1));
    float value = background_;
    if (box_.hasOverlap(brick)) {
      constexpr int kTile = 128;  // the smallest tile above the level of leaves
      constexpr int kDepth = 1;   // of such a tile; larger ones have less
      const Vec3i place = origin & (kTile - 1);
      if (std::max(place.x, std::max(place.y, place.z)) > kTile - 2 * kLeaf || accessor_.getValueDepth(corner) > kDepth)
        return false;
      value = density(accessor_.getValue(corner));
      if (value != background_ && !box_.isInside(brick)) return false;
    }
    std::fill_n(values, DensityGrid::kBrickValues, value);
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

}  // namespace

std::shared_ptr<const DensityGrid> density_of(const FloatTree& tree, const GridFrame& frame) {
  const CoordBBox box(to_coord(frame.lo), to_coord(frame.hi));
  return std::make_shared<const DensityGrid>(frame, BrickFiller(tree, box, frame.background),
                                             occupied_boxes(tree, box));
}

}  // namespace vpm
