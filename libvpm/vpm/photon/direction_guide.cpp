// Tracks of importons by cube and direction, and drawing directions from them.
#include "vpm/photon/direction_guide.h"

#include <algorithm>
#include <cassert>

#include "vpm/base/warp.h"

namespace vpm {

size_t DirectionCells::of(const Vec3& direction) {
  const Vec2 u = uniform_sphere_numbers(direction);
  const auto row = std::min(static_cast<size_t>(u.x * kRows), size_t{kRows - 1});
  const auto column = std::min(static_cast<size_t>(u.y * kColumns), size_t{kColumns - 1});
  return row * kColumns + column;
}

Vec3 DirectionCells::sample(size_t cell, const Vec2& u) {
  const Vec2 corner(static_cast<float>(cell / kColumns), static_cast<float>(cell % kColumns));
  return uniform_sphere((corner + u) / Vec2(kRows, kColumns));
}

float DirectionDensity::pdf(const Vec3& direction) const {
  const size_t cell = DirectionCells::of(direction);
  const float probability = cumulative_[cell] - (cell > 0 ? cumulative_[cell - 1] : 0.0f);
  return probability * (static_cast<float>(DirectionCells::kCount) / (4.0f * kPi));
}

Vec3 DirectionDensity::sample(Rng& rng) const {
  const float* end = cumulative_ + DirectionCells::kCount;
  const auto cell = std::upper_bound(cumulative_, end, rng.uniform_double()) - cumulative_;
  return DirectionCells::sample(static_cast<size_t>(cell), rng.uniform2());
}

DirectionGuide::DirectionGuide(const Box& box, int resolution)
    : grid_(box, resolution), values_(grid_.count() * DirectionCells::kCount, 0.0f) {}

void DirectionGuide::add_track(const Ray& ray, float length, float weight) {
  const size_t cell = DirectionCells::of(-ray.direction);
  grid_.visit(ray, length, [&](size_t cube, float entered, float left) {
    values_[cube * DirectionCells::kCount + cell] += weight * std::max(0.0f, left - entered) / grid_.edge();
    return true;
  });
}

void DirectionGuide::merge(const DirectionGuide& other) {
  assert(values_.size() == other.values_.size());
  for (size_t i = 0; i < values_.size(); ++i) values_[i] += other.values_[i];
}

void DirectionGuide::finish() {
  grid_.average(values_, DirectionCells::kCount);
  for (auto cube = values_.begin(); cube != values_.end(); cube += DirectionCells::kCount) {
    double sum = 0.0;
    for (size_t i = 0; i < DirectionCells::kCount; ++i) sum += cube[i];
    if (!(sum > 0.0)) continue;
    double below = 0.0;
    for (size_t i = 0; i < DirectionCells::kCount; ++i) cube[i] = static_cast<float>((below += cube[i]) / sum);
  }
}

}  // namespace vpm
