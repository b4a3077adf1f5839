// Photons uniform in the unit cube, and places to look for them.
#include "benchmarks/photons.h"

#include <algorithm>

#include "vpm/base/rng.h"

namespace vpm::bench {
namespace {

std::vector<Vec3> random_points(size_t count, uint64_t stream) {
  Rng rng(1, rng_stream(RngUse::probe, stream), 0);
  std::vector<Vec3> points(count);
  for (Vec3& p : points) p = Vec3(rng.uniform(), rng.uniform(), rng.uniform());
  return points;
}

/// Ten bits of each coordinate, interleaved.
uint32_t morton_code(const Vec3& p) {
  uint32_t code = 0;
  for (int bit = 9; bit >= 0; --bit)
    for (int axis = 0; axis < 3; ++axis) code = code << 1 | (static_cast<uint32_t>(p[axis] * 1024.0f) >> bit & 1u);
  return code;
}

}  // namespace

std::vector<Photon> random_photons(size_t count) {
  std::vector<Photon> photons(count);
  const std::vector<Vec3> points = random_points(count, 0);
  for (size_t i = 0; i < count; ++i) photons[i] = {points[i], PackedDirection(Vec3(0.0f, 1.0f, 0.0f)), Rgb(1.0f)};
  return photons;
}

float neighbour_radius(size_t photons) {
  return static_cast<float>(std::cbrt(kNeighbours * 3.0 / (4.0 * kPiD * static_cast<double>(photons))));
}

std::vector<Vec3> random_queries(size_t count) { return random_points(count, 1); }

std::vector<Vec3> morton_sorted(std::vector<Vec3> points) {
  std::sort(points.begin(), points.end(), [](const Vec3& a, const Vec3& b) { return morton_code(a) < morton_code(b); });
  return points;
}

}  // namespace vpm::bench
