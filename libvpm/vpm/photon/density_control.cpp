// Photons sorted by cube and octant; the surplus of each group shared out.
#include "vpm/photon/density_control.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace vpm {
namespace {

/// Photons of equal keys fly into the same octant in the same cube.
struct Entry {
  std::array<int64_t, 4> key{};
  size_t photon = 0;
};

Entry entry_of(const Photon& photon, size_t number, float edge) {
  Entry entry;
  const Vec3 travel = photon.travel.unpack();
  for (size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<int>(a);
    entry.key[a] = static_cast<int64_t>(std::floor(double{photon.position[axis]} / edge));
    entry.key[3] = 2 * entry.key[3] + (travel[axis] < 0.0f);
  }
  entry.photon = number;
  return entry;
}

}  // namespace

uint64_t control_density(std::vector<Photon>& photons, float edge, uint32_t most) {
  assert(edge > 0.0f && most >= 1);
  std::vector<Entry> entries;
  entries.reserve(photons.size());
  for (size_t i = 0; i < photons.size(); ++i) entries.push_back(entry_of(photons[i], i, edge));
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.key != b.key ? a.key < b.key : a.photon < b.photon; });
  std::vector<bool> kept(photons.size(), true);
  for (size_t begin = 0, end = 0; begin < entries.size(); begin = end) {
    while (end < entries.size() && entries[end].key == entries[begin].key) ++end;
    if (end - begin <= most) continue;
    Rgbd surplus(0.0);
    for (size_t i = begin + most; i < end; ++i) {
      surplus += Rgbd(photons[entries[i].photon].power);
      kept[entries[i].photon] = false;
    }
    for (size_t i = begin; i < begin + most; ++i)
      photons[entries[i].photon].power += Rgb(surplus / static_cast<double>(most));
  }
  size_t count = 0;
  for (size_t i = 0; i < photons.size(); ++i)
    if (kept[i]) photons[count++] = photons[i];
  const uint64_t gone = photons.size() - count;
  photons.resize(count);
  return gone;
}

}  // namespace vpm
