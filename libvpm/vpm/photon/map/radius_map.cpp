// Building the grid of the fixed-radius map: a counting sort by list, and the strides of the rule that shares lists.
#include "vpm/photon/map/radius_map.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "vpm/base/parallel.h"

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

namespace {

constexpr size_t kCellChunk = 1 << 14;  // photons one thread takes at once
constexpr size_t kParts = 8;            // of the lists, that threads sort one by one
constexpr double kMostWide = 2.0;       // radii, of a cell that shares its list
constexpr double kMostAlong = 1 << 20;  // cells along an axis: floats resolve a quarter of one

/// Cells of edge `size` that cover `extent`, each at least 1.
Vec3d cells_for(const Vec3& extent, double size) { return glm::floor(Vec3d(extent) / size) + 1.0; }

/// The edge of the cells: a radius, or more where that would make over a cell a photon.
double cell_size(const Vec3& extent, double radius, size_t photons) {
  const double least = std::max(radius, max_channel(extent) / kMostAlong), most = static_cast<double>(photons);
  double size = least;
  for (Vec3d n = cells_for(extent, size); n.x * n.y * n.z > most && size < kMostWide * least;
       n = cells_for(extent, size))
    size *= std::max(1.01, 0.9 * std::cbrt(n.x * n.y * n.z / most));
  return std::min(size, kMostWide * least);
}

}  // namespace

RadiusMap::RadiusMap(const std::vector<Photon>& photons, float radius, float scale, std::vector<uint32_t>* numbers) {
  assert(radius > 0.0f);
  if (photons.empty()) return;
  bounds_ = bounds_of(photons);
  const double size = cell_size(bounds_.extent(), radius, photons.size());
  const Vec3d cells = cells_for(bounds_.extent(), size);
  per_cell_ = static_cast<float>(1.0 / size);
  slack_ = static_cast<float>(size * (1e-3 + 0x1p-22 * std::max({cells.x, cells.y, cells.z})));
  last_ = Vec3(cells - 1.0);
  lists_ = CellLists(cells, static_cast<double>(photons.size()));
  const double window = std::min({lists_.window().x, lists_.window().y, lists_.window().z});
  widest_ = lists_.window() == Vec3i(cells) ? kInfinity : static_cast<float>(0.5 * (window - 2.0) * size);
  std::vector<uint32_t> lists(photons.size());  // of each photon
  parallel_for_chunks(lists.size(), kCellChunk, [&](size_t begin, size_t end, size_t) {
    for (size_t i = begin; i < end; ++i) lists[i] = static_cast<uint32_t>(lists_.list_of(cell_at(photons[i].position)));
  });
  std::vector<uint32_t> order = sort_by_list(lists);
  photons_ = PhotonTable(photons, order, scale);
  if (numbers) *numbers = std::move(order);
}

std::vector<uint32_t> RadiusMap::sort_by_list(const std::vector<uint32_t>& lists) {
  const size_t count = lists_.number(), part = (count + kParts - 1) / kParts;
  // Every thread looks at all photons, and counts and sorts those of a part of the lists: no two write to one place,
  // and the order is that of the photons in each list, on however many threads.
  const auto for_each_part = [&](const auto& take) {
    parallel_for_chunks(count, part, [&](size_t begin, size_t end, size_t) {
      for (uint32_t i = 0; i < lists.size(); ++i)
        if (lists[i] - begin < end - begin) take(i, lists[i]);
    });
  };
  first_.assign(count + 1, 0);
  for_each_part([&](uint32_t, uint32_t list) { ++first_[list + 1]; });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  std::vector<uint32_t> order(lists.size()), next(first_.begin(), first_.end() - 1);
  for_each_part([&](uint32_t i, uint32_t list) { order[next[list]++] = i; });
  return order;
}

size_t RadiusMap::memory_bytes() const {
  return sizeof(*this) + first_.capacity() * sizeof(uint32_t) + photons_.memory_bytes();
}

}  // namespace vpm
