// Building the grid of the fixed-radius map: a counting sort by cell.
#include "photon/radius_map.h"

#include <algorithm>
#include <cassert>

namespace vpm {
namespace {

/// Cells of edge `size` that cover `extent`, each at least 1.
Vec3d cells_for(const Vec3& extent, double size) { return glm::floor(Vec3d(extent) / size) + 1.0; }

/// The edge of the cells: half a radius, or more where that would make over two cells a photon.
double cell_size(const Vec3& extent, float radius, size_t photons) {
  const double most = 2.0 * static_cast<double>(photons) + 64.0;
  double size = 0.5 * radius;
  for (Vec3d n = cells_for(extent, size); n.x * n.y * n.z > most; n = cells_for(extent, size))
    size *= std::max(1.01, 0.9 * std::cbrt(n.x * n.y * n.z / most));
  return size;
}

}  // namespace

RadiusMap::RadiusMap(const std::vector<Photon>& photons, float radius, float scale) {
  assert(radius > 0.0f);
  for (const Photon& p : photons) bounds_.add(p.position);
  if (photons.empty()) return;
  const double size = cell_size(bounds_.extent(), radius, photons.size());
  per_cell_ = static_cast<float>(1.0 / size);
  count_ = Vec3i(cells_for(bounds_.extent(), size));
  const auto cell_of = [&](const Vec3& p) {
    return (static_cast<size_t>(cell_along(2, p.z)) * count_.y + cell_along(1, p.y)) * count_.x + cell_along(0, p.x);
  };
  first_.assign(static_cast<size_t>(count_.x) * count_.y * count_.z + 1, 0);
  for (const Photon& p : photons) ++first_[cell_of(p.position) + 1];
  for (size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
  photons_ = PhotonTable(photons.size());
  std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
  for (const Photon& p : photons) photons_.set(next[cell_of(p.position)]++, p, scale);
}

size_t RadiusMap::memory_bytes() const {
  return sizeof(*this) + first_.capacity() * sizeof(uint32_t) + photons_.memory_bytes();
}

}  // namespace vpm
