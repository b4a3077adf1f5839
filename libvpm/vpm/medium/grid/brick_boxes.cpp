// Cutting what is occupied into boxes: at the widest gaps first.
#include "vpm/medium/grid/brick_boxes.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>

#include "vpm/base/memory/packed_tables.h"

namespace vpm {
namespace {

double volume_of(const IndexBox& box) {
  const Vec3d extent = Vec3d(box.hi) - Vec3d(box.lo) + 1.0;
  return extent.x * extent.y * extent.z;
}

/// The bricks of a box that begin with voxels, not counting those that the voxels of their neighbours reach into: of
/// adjoining boxes each is counted once.
double filled_by(const IndexBox& box) {
  const Vec3d extent = glm::max(Vec3d(box.hi) - Vec3d(box.lo), Vec3d(1.0));
  return extent.x * extent.y * extent.z;
}

IndexBox bounds_of(const std::vector<IndexBox>& boxes) {
  IndexBox bounds = boxes.front();
  for (const IndexBox& box : boxes) bounds = {glm::min(bounds.lo, box.lo), glm::max(bounds.hi, box.hi)};
  return bounds;
}

/// Bricks below `at` along the axis, and the others.
struct Cut {
  int axis = 0, at = 0;
};

/// The plane in the widest gap; of gaps as wide that which leaves more boxes on its smaller side, so that the tree of
/// evenly spaced boxes is a flat one. Nothing where there is no gap.
std::optional<Cut> widest_gap(std::vector<IndexBox>& boxes) {
  std::optional<Cut> best;
  double most = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    std::sort(boxes.begin(), boxes.end(),
              [&](const IndexBox& a, const IndexBox& b) { return a.lo[axis] < b.lo[axis]; });
    int reached = boxes.front().hi[axis];
    for (size_t i = 1; i < boxes.size(); ++i) {
      const double gap = double(boxes[i].lo[axis]) - reached - 1.0;
      const double worth = gap * static_cast<double>(std::min(i, boxes.size() - i));
      if (worth > most) {
        most = worth;
        best = {axis, boxes[i].lo[axis]};
      }
      reached = std::max(reached, boxes[i].hi[axis]);
    }
  }
  return best;
}

Cut middle_of(const IndexBox& bounds) {
  const Vec3i extent = bounds.hi - bounds.lo;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  return {axis, bounds.lo[axis] + extent[axis] / 2 + 1};
}

/// The parts of the boxes on each side of the plane.
std::pair<std::vector<IndexBox>, std::vector<IndexBox>> parts_of(const std::vector<IndexBox>& boxes, const Cut& cut) {
  std::vector<IndexBox> below, above;
  for (const IndexBox& box : boxes) {
    if (box.lo[cut.axis] < cut.at) {
      below.push_back(box);
      below.back().hi[cut.axis] = std::min(box.hi[cut.axis], cut.at - 1);
    }
    if (box.hi[cut.axis] >= cut.at) {
      above.push_back(box);
      above.back().lo[cut.axis] = std::max(box.lo[cut.axis], cut.at);
    }
  }
  return {std::move(below), std::move(above)};
}

}  // namespace

BrickBoxes::BrickBoxes(std::vector<IndexBox> occupied) {
  assert(!occupied.empty());
  root_ = build(std::move(occupied));
}

BrickBoxes::BrickBoxes(TableUnpacker& packed) {
  const std::span<const BrickBox> boxes = packed.take<BrickBox>();
  const std::span<const Node> nodes = packed.take<Node>();
  boxes_.assign(boxes.begin(), boxes.end());
  nodes_.assign(nodes.begin(), nodes.end());
  whole_ = packed.take_one<bool>();
  root_ = packed.take_one<int32_t>();
}

void BrickBoxes::pack(TablePacker& packer) const {
  packer.add(std::span(boxes_));
  packer.add(std::span(nodes_));
  packer.add_one(whole_);
  packer.add_one(root_);
}

int32_t BrickBoxes::build(std::vector<IndexBox> occupied) {
  constexpr double kMostPerFilled = 8.0;
  const IndexBox bounds = bounds_of(occupied);
  double filled = 0.0;
  for (const IndexBox& box : occupied) filled += filled_by(box);
  if (volume_of(bounds) <= kMostPerFilled * filled) return add_box(bounds);
  const Cut cut = widest_gap(occupied).value_or(middle_of(bounds));
  auto [below, above] = parts_of(occupied, cut);
  occupied = {};
  const auto number = static_cast<int32_t>(nodes_.size());
  nodes_.push_back({cut.axis, cut.at, {0, 0}});
  const int32_t first = build(std::move(below)), second = build(std::move(above));
  nodes_[number].child[0] = first;
  nodes_[number].child[1] = second;
  return number;
}

int32_t BrickBoxes::add_box(const IndexBox& bounds) {
  const size_t first = boxes_.empty() ? 0 : bricks();
  boxes_.push_back({bounds.lo, bounds.hi - bounds.lo + 1, first});
  return ~static_cast<int32_t>(boxes_.size() - 1);
}

const BrickBox* BrickBoxes::find(const Vec3i& brick) const {
  int32_t child = root_;
  while (child >= 0) child = nodes_[child].child[brick[nodes_[child].axis] >= nodes_[child].at];
  const BrickBox& box = boxes_[~child];
  return box.holds(brick) ? &box : nullptr;
}

const BrickBox& BrickBoxes::of_number(size_t number) const {
  const auto after = std::upper_bound(boxes_.begin(), boxes_.end(), number,
                                      [](size_t n, const BrickBox& box) { return n < box.first; });
  return *std::prev(after);
}

}  // namespace vpm
