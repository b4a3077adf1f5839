// Tracks of importons through cubes.
#include "vpm/photon/importance_map.h"

#include <algorithm>
#include <cassert>

namespace vpm {
namespace {

constexpr float kInside = 1e-3f;      // of a cube's edge: so far within it a place is surely its own
constexpr float kLeastShare = 1e-4f;  // of the mean importance: what a cube has at least

}  // namespace

ImportanceMap::ImportanceMap(const Box& box, int resolution) : grid_(box, resolution), values_(grid_.count(), 0.0f) {}

void ImportanceMap::add_track(const Ray& ray, float length, float weight) {
  grid_.visit(ray, length, [&](size_t cube, float entered, float left) {
    values_[cube] += weight * std::max(0.0f, left - entered) / grid_.edge();
    return true;
  });
}

void ImportanceMap::merge(const ImportanceMap& other) {
  assert(values_.size() == other.values_.size());
  for (size_t i = 0; i < values_.size(); ++i) values_[i] += other.values_[i];
}

void ImportanceMap::finish() {
  grid_.average(values_, 1);
  double sum = 0.0;
  for (const float value : values_) sum += value;
  const float mean = static_cast<float>(sum / static_cast<double>(values_.size()));
  const float least = mean > 0.0f ? kLeastShare * mean : 1.0f;
  for (float& value : values_) value = std::max(value, least);
}

float ImportanceMap::first_above(const Ray& ray, float level) const {
  float found = kInfinity;
  grid_.visit(ray, kInfinity, [&](size_t cube, float entered, float) {
    if (entered > 0.0f && values_[cube] > level) found = entered + kInside * grid_.edge();
    return found == kInfinity;
  });
  return found;
}

}  // namespace vpm
