// Lattice noise from integer hashes, and the formulas of the procedural density fields.
#include "vpm/medium/grid/procedural.h"

#include <algorithm>
#include <array>

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

namespace {

/// 0 below lo, 1 above hi, a smooth cubic between; lo > hi turns it round.
float smooth_step(float lo, float hi, float x) {
  const float t = std::clamp((x - lo) / (hi - lo), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

/// 1 inside the unit cube, falling to exactly 0 at its faces over the margin.
float inside_cube(const Vec3& p, float margin) {
  const Vec3 d = glm::min(p, 1.0f - p);
  return smooth_step(0.0f, margin, std::min(d.x, std::min(d.y, d.z)));
}

/// A puff of cloud or smoke.
struct Ball {
  Vec3 center;
  float radius;
};

/// How deep p lies below the surface of a heap of balls, creases between them rounded off; negative outside.
template <size_t N>
float depth_in_balls(const std::array<Ball, N>& balls, const Vec3& p, float rounding) {
  float depth = -1.0f;
  for (const Ball& ball : balls) {
    const float d = ball.radius - glm::length(p - ball.center);
    const float blend = std::max(0.0f, rounding - std::abs(depth - d)) / rounding;
    depth = std::max(depth, d) + 0.25f * rounding * blend * blend;
  }
  return depth;
}

/// A number in [-1, 1) for a ball.
float draw(int ball, int what, uint32_t seed) { return 2.0f * lattice_value(Vec3i(ball, what, 0), seed) - 1.0f; }

// Smoke
// ----------------------------------------------------------------------------------------------------

constexpr Vec3 kSmokeSize(0.7f, 1.0f, 0.7f);  // m

/// Radius of the plume at a height, m.
float smoke_radius(float height) { return 0.028f + 0.17f * height; }

/// Puffs that rise one above the other, three at a level, and grow.
std::array<Ball, 60> smoke_balls() {
  std::array<Ball, 60> balls;
  float height = 0.02f;
  for (int i = 0; i < static_cast<int>(balls.size()); ++i) {
    const float radius = smoke_radius(height);
    const float off = 0.55f * radius * smooth_step(0.0f, 0.1f, height);
    const Vec3 side(draw(i, 0, 11), 0.5f * draw(i, 1, 11), draw(i, 2, 11));
    balls[static_cast<size_t>(i)] = {Vec3(0.0f, height, 0.0f) + off * side, radius * (0.72f + 0.2f * draw(i, 3, 11))};
    height += 0.27f * radius;
  }
  return balls;
}

/// A turbulent plume: its axis sways, its surface is stirred by curls and covered with billows, all in proportion to
/// its width; higher up it is thinner and frays.
float smoke(const Vec3& unit) {
  static const std::array<Ball, 60> balls = smoke_balls();
  const Vec3 p = (unit - Vec3(0.5f, 0.0f, 0.5f)) * kSmokeSize;
  const float radius = smoke_radius(p.y);
  if (p.x * p.x + p.z * p.z > 6.0f * radius * radius) return 0.0f;
  const float grown = radius / smoke_radius(1.0f);
  const float sway = 0.3f * radius * smooth_step(0.0f, 0.4f, p.y);
  Vec3 q = p + sway * Vec3(gradient_noise(Vec3(0.3f, 2.6f * p.y, 0.7f), 21).value, 0.0f,
                           gradient_noise(Vec3(0.6f, 2.6f * p.y, 0.2f), 22).value);
  q += grown * (0.026f * curl_noise(6.0f * q, 31) + 0.009f * curl_noise(17.0f * q, 41));
  const float billows = billow_noise(11.0f * q, 5, 51);
  const float wisps = fractal_noise(14.0f * q, 4, 61);
  const float frayed = smooth_step(0.35f, 1.0f, p.y);
  const float depth =
      depth_in_balls(balls, q, 0.3f * radius) / radius + 0.7f * billows - 0.2f - 0.55f * frayed * (0.35f + wisps);
  const float ends = smooth_step(0.0f, 0.03f, p.y) * smooth_step(0.98f, 0.7f, p.y + 0.1f * wisps);
  const float texture = std::clamp(0.75f + 0.6f * wisps, 0.1f, 1.0f) * (1.0f - 0.5f * smooth_step(0.1f, 1.0f, p.y));
  return smooth_step(0.0f, 0.45f + 0.25f * frayed, depth) * ends * texture * inside_cube(unit, 0.02f);
}

// Cloud
// ----------------------------------------------------------------------------------------------------

constexpr Vec3 kCloudSize(1000.0f, 600.0f, 800.0f);  // m
constexpr float kCloudBase = 0.1f;                   // height of its flat base, in units of the box's height

/// A heap of balls, the large ones low and in the middle; in units of the box's height, from the middle of its base.
std::array<Ball, 22> cloud_balls() {
  std::array<Ball, 22> balls;
  for (int i = 0; i < static_cast<int>(balls.size()); ++i) {
    const float out = static_cast<float>(i) / static_cast<float>(balls.size());  // 0: the middle
    const float x = 0.62f * std::sqrt(out) * draw(i, 0, 71);
    const float z = 0.45f * std::sqrt(out) * draw(i, 1, 71);
    const float room = std::max(0.0f, 1.0f - 1.6f * (x * x + 1.4f * z * z));  // the heap is highest in the middle
    const float y = kCloudBase + 0.06f + 0.25f * room * (1.0f + draw(i, 2, 71));
    balls[static_cast<size_t>(i)] = {Vec3(x, y, z), 0.255f - 0.12f * out + 0.015f * draw(i, 3, 71)};
  }
  return balls;
}

float cloud(const Vec3& unit) {
  static const std::array<Ball, 22> balls = cloud_balls();
  constexpr float kRounding = 0.06f;
  const Vec3 p = (unit - Vec3(0.5f, 0.0f, 0.5f)) * kCloudSize / kCloudSize.y;
  if (depth_in_balls(balls, p, kRounding) < -0.25f) return 0.0f;
  const Vec3 q = p + 0.03f * curl_noise(4.0f * p, 81) + 0.012f * curl_noise(11.0f * p, 91);
  const float billows = billow_noise(6.5f * q, 5, 111);
  const float above_base = (p.y - kCloudBase + 0.03f * fractal_noise(5.0f * p, 3, 121)) / 0.12f;
  const float depth = depth_in_balls(balls, q, kRounding) + 0.13f * billows - 0.035f;
  const float body = smooth_step(0.0f, 0.09f, depth) * smooth_step(0.0f, 1.0f, above_base);
  const float texture = std::clamp(0.78f + 0.5f * fractal_noise(9.0f * q, 4, 131), 0.3f, 1.0f);
  return body * texture * inside_cube(unit, 0.02f);
}

// Fire
// ----------------------------------------------------------------------------------------------------

constexpr Vec3 kFireSize(0.7f, 1.2f, 0.7f);  // m

/// A place of the fire, m from the middle of its base, as it would be in still air: stirred more the higher it is.
Vec3 in_still_air(const Vec3& unit) {
  const Vec3 p = (unit - Vec3(0.5f, 0.0f, 0.5f)) * kFireSize;
  const float stirred = smooth_step(0.0f, 0.4f, p.y);
  const Vec3 swirl = 0.028f * curl_noise(5.5f * p, 151) + 0.008f * curl_noise(16.0f * p, 161);
  return p + stirred * swirl;
}

/// 1 in the middle of the flame, 0 outside of it.
float flame(const Vec3& unit) {
  constexpr float kHeight = 0.42f;  // m
  const Vec3 p = in_still_air(unit);
  const float tongues = fractal_noise(Vec3(12.0f, 6.0f, 12.0f) * p, 4, 171);
  const float left = 1.0f - p.y / (kHeight * (1.0f + 0.3f * tongues));  // of its height
  if (left <= 0.0f) return 0.0f;
  const float radius = 0.1f * std::sqrt(left) * (0.6f + 0.9f * left * (1.0f - left) + 0.4f * (1.0f - left));
  const float depth = 1.0f - std::sqrt(p.x * p.x + p.z * p.z) / radius + 0.45f * tongues;
  return smooth_step(0.0f, 0.8f, depth) * smooth_step(0.005f, 0.05f, p.y) * inside_cube(unit, 0.02f);
}

/// Smoke above the flame, and a little soot within it, which is what glows.
float fire_density(const Vec3& unit) {
  const Vec3 p = in_still_air(unit);
  const float radius = 0.05f + 0.17f * p.y, height = p.y;
  const float wisps = fractal_noise(13.0f * p, 4, 181), billows = billow_noise(10.0f * p, 5, 191);
  const float depth = 1.0f - std::sqrt(p.x * p.x + p.z * p.z) / radius + 0.9f * billows - 0.3f + 0.3f * wisps;
  const float ends = smooth_step(0.22f, 0.5f, height) * smooth_step(1.17f, 0.75f, height + 0.1f * wisps);
  const float smoke = smooth_step(0.0f, 0.5f, depth) * ends * (1.0f - 0.4f * smooth_step(0.5f, 1.1f, height));
  return std::max(0.9f * smoke * inside_cube(unit, 0.02f), 0.3f * smooth_step(0.0f, 0.3f, flame(unit)));
}

/// Kelvin: 1100 to 2000 in the flame, no more than 600 in the smoke.
float fire_temperature(const Vec3& unit) {
  const float inside = flame(unit);
  return inside > 0.0f ? 1100.0f + 900.0f * inside : 600.0f * fire_density(unit);
}

// Shapes with known answers
// ----------------------------------------------------------------------------------------------------

constexpr Vec3 kUnitSize(1.0f);  // m

float constant(const Vec3&) { return 1.0f; }

float ramp(const Vec3& unit) { return std::clamp(unit.x, 0.0f, 1.0f); }

float checker(const Vec3& unit) {
  const Vec3i cell = glm::clamp(Vec3i(glm::floor(4.0f * unit)), 0, 3);
  return (cell.x + cell.y + cell.z) % 2 == 0 ? 1.0f : 0.0f;
}

float gaussian(const Vec3& unit) {
  const Vec3 d = 8.0f * (unit - 0.5f);  // in standard deviations
  return static_cast<float>(std::exp(-0.5 * static_cast<double>(glm::dot(d, d))));
}

float random(const Vec3& unit) { return value_noise(8.0f * unit, 141); }

constexpr std::array<ProceduralField, 10> kFields = {{
    {"smoke", "a turbulent plume of smoke that rises and widens", kSmokeSize, smoke},
    {"cloud", "a cumulus cloud with a flat base", kCloudSize, cloud},
    {"fire", "a flame of soot and the smoke above it: density, temperature, flame", kFireSize, fire_density},
    {"fire", "kelvin", kFireSize, fire_temperature, "temperature"},
    {"fire", "0 to 1", kFireSize, flame, "flame"},
    {"constant", "1 everywhere", kUnitSize, constant},
    {"ramp", "0 to 1 along x", kUnitSize, ramp},
    {"checker", "4 x 4 x 4 cubes of 1 and 0 by turns", kUnitSize, checker},
    {"gaussian", "a round blob, 1 in the middle, standard deviation 1/8", kUnitSize, gaussian},
    {"random", "random numbers in [0, 1) on a lattice of 1/8, trilinear between", kUnitSize, random},
}};

}  // namespace

std::span<const ProceduralField> procedural_fields() { return kFields; }

const ProceduralField* find_procedural_field(std::string_view name) {
  const auto field =
      std::find_if(kFields.begin(), kFields.end(), [name](const ProceduralField& f) { return f.name == name; });
  return field == kFields.end() ? nullptr : &*field;
}

}  // namespace vpm
