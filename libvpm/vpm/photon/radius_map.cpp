// Building the grid of the fixed-radius map: a counting sort by cell.
#include "vpm/photon/radius_map.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "vpm/base/parallel.h"

namespace vpm {
namespace {

/// Cells of edge `size` that cover `extent`, each at least 1.
Vec3d cells_for(const Vec3& extent, double size) { return glm::floor(Vec3d(extent) / size) + 1.0; }

constexpr size_t kCellChunk = 1 << 14;  // photons one thread takes at once
constexpr size_t kParts = 8;            // of the cells, that threads sort one by one

/// The edge of the cells: a radius, or more where that would make over a cell a photon.
double cell_size(const Vec3& extent, float radius, size_t photons) {
  const double most = static_cast<double>(photons);
  double size = radius;
  for (Vec3d n = cells_for(extent, size); n.x * n.y * n.z > most; n = cells_for(extent, size))
    size *= std::max(1.01, 0.9 * std::cbrt(n.x * n.y * n.z / most));
  return size;
}

}  // namespace

RadiusMap::RadiusMap(const std::vector<Photon>& photons, float radius, float scale) {
  assert(radius > 0.0f);
  if (photons.empty()) return;
  bounds_ = bounds_of(photons);
  const double size = cell_size(bounds_.extent(), radius, photons.size());
  per_cell_ = static_cast<float>(1.0 / size);
  count_ = Vec3i(cells_for(bounds_.extent(), size));
  std::vector<uint32_t> cells(photons.size());  // of each photon
  parallel_for_chunks(cells.size(), kCellChunk, [&](size_t begin, size_t end, size_t) {
    for (size_t i = begin; i < end; ++i) {
      const Vec3& p = photons[i].position;
      cells[i] = (cell_along(2, p.z) * count_.y + cell_along(1, p.y)) * count_.x + cell_along(0, p.x);
    }
  });
  photons_ = PhotonTable(photons, sort_by_cell(cells), scale);
}

std::vector<uint32_t> RadiusMap::sort_by_cell(const std::vector<uint32_t>& cells) {
  const size_t count = static_cast<size_t>(count_.x) * count_.y * count_.z, part = (count + kParts - 1) / kParts;
  // Every thread looks at all photons, and counts and sorts those of a part of the cells: no two write to one place,
  // and the order is that of the photons in each cell, on however many threads.
  const auto for_each_part = [&](const auto& take) {
    parallel_for_chunks(count, part, [&](size_t begin, size_t end, size_t) {
      for (uint32_t i = 0; i < cells.size(); ++i)
        if (cells[i] - begin < end - begin) take(i, cells[i]);
    });
  };
  first_.assign(count + 1, 0);
  for_each_part([&](uint32_t, uint32_t cell) { ++first_[cell + 1]; });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  std::vector<uint32_t> order(cells.size()), next(first_.begin(), first_.end() - 1);
  for_each_part([&](uint32_t i, uint32_t cell) { order[next[cell]++] = i; });
  return order;
}

size_t RadiusMap::memory_bytes() const {
  return sizeof(*this) + first_.capacity() * sizeof(uint32_t) + photons_.memory_bytes();
}

}  // namespace vpm
