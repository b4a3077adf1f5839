// The strides of the rule.
#include "vpm/photon/cell_lists.h"

#include <algorithm>
#include <cmath>

namespace vpm {
namespace {

// Multiples of 1/p and 1/p^2, p^3 = p + 1, together stay as far from integers as those of any pair of numbers: so the
// cells that share a list are spread evenly over space, and over each plane of cells. The nearest two are at least
// (lists/16)^(1/3) apart along an axis, for every number of lists that was tried (tests/photon/cell_lists_test.cpp).
constexpr double kPlasticNumber = 1.32471795724474602596;
constexpr double kPerWindow = 16.0;

}  // namespace

CellLists::CellLists(const Vec3d& cells, double most) {
  const double number = cells.x * cells.y * cells.z;
  if (number <= most) {
    stride_y_ = static_cast<uint64_t>(cells.x);
    stride_z_ = static_cast<uint64_t>(cells.x * cells.y);
    number_ = static_cast<uint64_t>(number);
    window_ = Vec3i(cells);
    return;
  }
  stride_y_ = static_cast<uint64_t>(most / kPlasticNumber);
  stride_z_ = static_cast<uint64_t>(most / (kPlasticNumber * kPlasticNumber));
  number_ = static_cast<uint64_t>(most);
  window_ = Vec3i(static_cast<int>(std::max(1.0, std::cbrt(most / kPerWindow))));
}

}  // namespace vpm
