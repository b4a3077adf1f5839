// Where the bricks of a density grid are: in one box, as a rule; of a grid far wider than what it holds in several,
// which a kd-tree finds.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "vpm/base/vec.h"

namespace vpm {

class TablePacker;
class TableUnpacker;

/// A box of integer coordinates, both ends included; empty where lo > hi.
struct IndexBox {
  Vec3i lo{0}, hi{-1};
};

/// A box of bricks, of which those from lo to lo + count - 1 have entries in the grid's table: number `first` and the
/// following, x fastest.
struct BrickBox {
  Vec3i lo{0}, count{0};  // in bricks
  size_t first = 0;

  Vec3i strides() const { return {1, count.x, count.x * count.y}; }
  size_t bricks() const { return static_cast<size_t>(count.x) * count.y * count.z; }
  bool holds(const Vec3i& brick) const {
    return glm::all(glm::greaterThanEqual(brick, lo)) && glm::all(glm::lessThan(brick, lo + count));
  }
  size_t number(const Vec3i& brick) const {
    const Vec3i at = brick - lo;
    return first + (static_cast<size_t>(at.z) * count.y + at.y) * count.x + at.x;
  }
  Vec3i brick(size_t number) const {
    const auto n = static_cast<int64_t>(number - first), rows = n / count.x;
    return lo + Vec3i(n % count.x, rows % count.y, rows / count.y);
  }
};

class BrickBoxes {
 public:
  /// All of the bricks 0 to count - 1.
  explicit BrickBoxes(const Vec3i& count) : boxes_{{Vec3i(0), count, 0}}, whole_(true), root_(~0) {}
  /// Disjoint boxes that hold all bricks of `occupied`, of which there is at least one. Each of these is taken to hold
  /// voxels but in its last bricks, into which those reach. Boxes are cut, at gaps first, until bricks with voxels fill
  /// an eighth of each, as the one that a single brick of voxels takes is filled.
  explicit BrickBoxes(std::vector<IndexBox> occupied);
  /// A copy of those that pack() has packed, which must come next.
  explicit BrickBoxes(TableUnpacker& packed);
  /// Adds all that they are.
  void pack(TablePacker& packer) const;

  std::span<const BrickBox> all() const { return boxes_; }
  /// Is it one box that holds all bricks there are? A single box of what is occupied may be a part of them.
  bool whole() const { return whole_; }
  /// In all boxes.
  size_t bricks() const { return boxes_.back().first + boxes_.back().bricks(); }
  size_t memory_bytes() const { return boxes_.capacity() * sizeof(BrickBox) + nodes_.capacity() * sizeof(Node); }

  /// The box that holds a brick; null where none does.
  const BrickBox* find(const Vec3i& brick) const;
  /// The box that the brick of this number is in.
  const BrickBox& of_number(size_t number) const;

  /// Calls visit(const BrickBox&) for the boxes that the ray may meet in [t0, t1], in order, until it returns false.
  /// The ray is in units of bricks, from the lower corner of brick 0. Returns whether none did.
  template <class Visit>
  bool visit(const Vec3d& origin, const Vec3d& direction, double t0, double t1, Visit&& visit) const {
    return visit_child(root_, origin, direction, t0, t1, visit);
  }

 private:
  /// A plane between bricks: the first child has those below `at` along the axis. Children >= 0 are nodes, others the
  /// box ~child.
  struct Node {
    int32_t axis = 0, at = 0;
    int32_t child[2] = {0, 0};
  };

  int32_t build(std::vector<IndexBox> occupied);
  int32_t add_box(const IndexBox& bounds);

  template <class Visit>
  bool visit_child(int32_t child, const Vec3d& origin, const Vec3d& direction, double t0, double t1,
                   Visit& visit) const {
    if (child < 0) return visit(boxes_[~child]);
    const Node& node = nodes_[child];
    const double to_plane = node.at - origin[node.axis], along = direction[node.axis];
    const bool above = along != 0.0 ? along < 0.0 : to_plane <= 0.0;  // where the ray comes from
    const double t = along != 0.0 ? to_plane / along : std::numeric_limits<double>::infinity();
    return (t < t0 || visit_child(node.child[above], origin, direction, t0, std::min(t, t1), visit)) &&
           (t > t1 || visit_child(node.child[!above], origin, direction, std::max(t, t0), t1, visit));
  }

  std::vector<BrickBox> boxes_;  // in the order of their numbers
  std::vector<Node> nodes_;
  bool whole_ = false;
  int32_t root_ = 0;
};

}  // namespace vpm
