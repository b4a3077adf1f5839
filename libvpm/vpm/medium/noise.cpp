// Lattice noise from integer hashes.
#include "vpm/medium/noise.h"

namespace vpm {
namespace {

/// Perlin's twelve edge directions of a cube, four of them twice.
float along_edge(uint32_t hash, const Vec3& d, Vec3& direction) {
  static constexpr signed char kEdges[16][3] = {
      {1, 1, 0}, {-1, 1, 0}, {1, -1, 0}, {-1, -1, 0}, {1, 0, 1}, {-1, 0, 1}, {1, 0, -1}, {-1, 0, -1},
      {0, 1, 1}, {0, -1, 1}, {0, 1, -1}, {0, -1, -1}, {1, 1, 0}, {0, -1, 1}, {-1, 1, 0}, {0, -1, -1}};
  const signed char* e = kEdges[hash >> 28];
  direction = Vec3(e[0], e[1], e[2]);
  return glm::dot(direction, d);
}

Vec3 lattice_point(const Vec3& p, Vec3i& cell) {
  const Vec3 low = glm::floor(p);
  cell = Vec3i(low);
  return p - low;
}

}  // namespace

uint32_t lattice_hash(const Vec3i& p, uint32_t seed) {
  uint32_t h = seed * 0x9e3779b9u;
  for (int a = 0; a < 3; ++a) {
    h ^= static_cast<uint32_t>(p[a]) * 0x85ebca6bu;
    h = (h ^ (h >> 15)) * 0xc2b2ae35u;
    h ^= h >> 13;
  }
  h *= 0x27d4eb2fu;
  return h ^ (h >> 16);
}

float lattice_value(const Vec3i& p, uint32_t seed) { return static_cast<float>(lattice_hash(p, seed) >> 8) * 0x1p-24f; }

NoiseSample gradient_noise(const Vec3& p, uint32_t seed) {
  Vec3i cell;
  const Vec3 f = lattice_point(p, cell);
  const Vec3 fade = f * f * f * (f * (f * 6.0f - 15.0f) + 10.0f);
  const Vec3 slope = 30.0f * f * f * (f * (f - 2.0f) + 1.0f);
  NoiseSample sum;
  for (int i = 0; i < 8; ++i) {
    const Vec3i corner(i & 1, (i >> 1) & 1, i >> 2);
    Vec3 direction;
    const float value = along_edge(lattice_hash(cell + corner, seed), f - Vec3(corner), direction);
    Vec3 weight, rise;
    for (int a = 0; a < 3; ++a) {
      weight[a] = corner[a] ? fade[a] : 1.0f - fade[a];
      rise[a] = corner[a] ? slope[a] : -slope[a];
    }
    const float w = weight.x * weight.y * weight.z;
    sum.value += w * value;
    sum.gradient += w * direction + value * Vec3(rise.x * weight.y * weight.z, weight.x * rise.y * weight.z,
                                                 weight.x * weight.y * rise.z);
  }
  return sum;
}

float value_noise(const Vec3& p, uint32_t seed) {
  Vec3i cell;
  const Vec3 f = lattice_point(p, cell);
  float sum = 0.0f;
  for (int i = 0; i < 8; ++i) {
    const Vec3i corner(i & 1, (i >> 1) & 1, i >> 2);
    const Vec3 w = glm::mix(1.0f - f, f, Vec3(corner));
    sum += w.x * w.y * w.z * lattice_value(cell + corner, seed);
  }
  return sum;
}

float fractal_noise(const Vec3& p, int octaves, uint32_t seed) {
  float sum = 0.0f;
  float scale = 1.0f;
  for (int i = 0; i < octaves; ++i, scale *= 2.0f)
    sum += gradient_noise(p * scale, seed + static_cast<uint32_t>(i)).value / scale;
  return sum;
}

float billow_noise(const Vec3& p, int octaves, uint32_t seed) {
  float sum = 0.0f;
  float scale = 1.0f;
  for (int i = 0; i < octaves; ++i, scale *= 2.0f)
    sum += std::abs(gradient_noise(p * scale, seed + static_cast<uint32_t>(i)).value) / scale;
  return sum;
}

Vec3 curl_noise(const Vec3& p, uint32_t seed) {
  const Vec3 x = gradient_noise(p, seed).gradient;
  const Vec3 y = gradient_noise(p, seed + 101).gradient;
  const Vec3 z = gradient_noise(p, seed + 202).gradient;
  return {z.y - y.z, x.z - z.x, y.x - x.y};
}

}  // namespace vpm
