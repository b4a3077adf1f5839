// Tracks of importons through cubes, and the importons.
#include "photon/importance_map.h"

#include <algorithm>
#include <cassert>

#include "base/parallel.h"
#include "path/walk.h"

namespace vpm {
namespace {

constexpr int kResolution = 32;       // cubes along the scene's longest edge
constexpr size_t kChunk = 4096;       // importons traced one after another
constexpr float kInside = 1e-3f;      // of a cube's edge: so far within it a place is surely its own
constexpr float kLeastShare = 1e-4f;  // of the mean importance: what a cube has at least

}  // namespace

ImportanceMap::ImportanceMap(const Box& box, int resolution) : box_(box) {
  const Vec3 extent = box.extent();
  edge_ = max_channel(extent) / static_cast<float>(resolution);
  size_ = glm::max(Vec3i(1), Vec3i(glm::ceil(extent / edge_ - 1e-3f)));
  values_.resize(number(size_ - 1) + 1, 0.0f);
}

Vec3i ImportanceMap::cube_at(const Vec3& p) const {
  const Vec3 place = glm::clamp((p - box_.lo) / edge_, Vec3(0.0f), Vec3(size_ - 1));
  return Vec3i(place);
}

template <class Visit>
void ImportanceMap::visit_cubes(const Ray& ray, float length, Visit&& visit) const {
  Interval inside{0.0f, length};
  for (int a = 0; a < 3; ++a) {
    const float lo = box_.lo[a], hi = box_.lo[a] + edge_ * static_cast<float>(size_[a]);
    if (ray.direction[a] == 0.0f) {
      if (ray.origin[a] < lo || ray.origin[a] > hi) return;
      continue;
    }
    const float t_lo = (lo - ray.origin[a]) / ray.direction[a], t_hi = (hi - ray.origin[a]) / ray.direction[a];
    inside.t0 = std::max(inside.t0, std::min(t_lo, t_hi));
    inside.t1 = std::min(inside.t1, std::max(t_lo, t_hi));
  }
  if (inside.empty()) return;
  Vec3i cube = cube_at(ray.at(inside.t0));
  Vec3 next(kInfinity);  // where the ray leaves the cube along each axis, m
  for (int a = 0; a < 3; ++a)
    if (ray.direction[a] != 0.0f)
      next[a] = (box_.lo[a] + edge_ * static_cast<float>(cube[a] + (ray.direction[a] > 0.0f)) - ray.origin[a]) /
                ray.direction[a];
  for (float t = inside.t0; t < inside.t1;) {
    const int axis = next.x < next.y ? (next.x < next.z ? 0 : 2) : (next.y < next.z ? 1 : 2);
    const float left = std::min(next[axis], inside.t1);
    if (!visit(number(cube), t, left)) return;
    t = std::max(t, left);
    cube[axis] += ray.direction[axis] > 0.0f ? 1 : -1;
    if (cube[axis] < 0 || cube[axis] >= size_[axis]) return;
    next[axis] += edge_ / std::abs(ray.direction[axis]);
  }
}

void ImportanceMap::add_track(const Ray& ray, float length, float weight) {
  visit_cubes(ray, length, [&](size_t cube, float entered, float left) {
    values_[cube] += weight * std::max(0.0f, left - entered) / edge_;
    return true;
  });
}

void ImportanceMap::merge(const ImportanceMap& other) {
  assert(values_.size() == other.values_.size());
  for (size_t i = 0; i < values_.size(); ++i) values_[i] += other.values_[i];
}

void ImportanceMap::average_along(int axis) {
  const std::vector<float> before = values_;
  Vec3i cube;
  for (cube.z = 0; cube.z < size_.z; ++cube.z)
    for (cube.y = 0; cube.y < size_.y; ++cube.y)
      for (cube.x = 0; cube.x < size_.x; ++cube.x) {
        float sum = 0.0f;
        for (int step = -1; step <= 1; ++step) {
          Vec3i neighbour = cube;
          neighbour[axis] = std::clamp(cube[axis] + step, 0, size_[axis] - 1);
          sum += (step == 0 ? 2.0f : 1.0f) * before[number(neighbour)];
        }
        values_[number(cube)] = 0.25f * sum;
      }
}

void ImportanceMap::finish() {
  for (int axis = 0; axis < 3; ++axis) average_along(axis);
  double sum = 0.0;
  for (const float value : values_) sum += value;
  const float mean = static_cast<float>(sum / static_cast<double>(values_.size()));
  const float least = mean > 0.0f ? kLeastShare * mean : 1.0f;
  for (float& value : values_) value = std::max(value, least);
}

float ImportanceMap::first_above(const Ray& ray, float level) const {
  float found = kInfinity;
  visit_cubes(ray, kInfinity, [&](size_t cube, float entered, float) {
    if (entered > 0.0f && values_[cube] > level) found = entered + kInside * edge_;
    return found == kInfinity;
  });
  return found;
}

namespace {

/// Follows one importon and adds its tracks.
void trace_importon(const Scene& scene, const DistanceStrategy& strategy, Rng& rng, int max_events,
                    ImportanceMap& map) {
  const Camera& camera = scene.camera;
  const Vec2 film = rng.uniform2() * Vec2(camera.width, camera.height);
  const Ray seen = camera.ray(film);
  PathState state{seen, medium_of_ray(scene, scene.camera_medium, seen), Rgb(1.0f)};
  WalkCounters counters;
  for (int events = 0; events < max_events; ++events) {
    const Ray from = state.ray;
    const float weight = mean_channel(state.power);
    const Event event = next_event(scene, strategy, state, rng, counters);
    if (!is_finite(state.power)) return;
    const bool escaped = event.kind == EventKind::escape;
    const float length = escaped ? kInfinity : glm::distance(from.origin, state.ray.origin);
    if (length > 0.0f) map.add_track(from, length, weight);
    const double now = mean_channel(state.power);
    if (escaped || !(now > 0.0) || !survive_roulette(now, state, rng)) return;
    if (event.kind == EventKind::collision) {
      if (!scatter_in_medium(scene.media[state.medium], state, rng)) return;
    } else {
      Scatter scatter;
      if (!scatter_at_surface(scene, event.hit, state, rng, scatter)) return;
      state.power *= scatter.radiance_scale;
    }
  }
}

}  // namespace

ImportanceMap trace_importons(const Scene& scene, const DistanceStrategy& strategy, uint64_t seed, uint64_t pass,
                              uint64_t count, int max_events) {
  Box box = scene.bounds;
  box.add(scene.camera.position);
  ImportanceMap all(box, kResolution);
  std::vector<ImportanceMap> parts(chunk_count(count, kChunk), all);
  parallel_for_chunks(count, kChunk, [&](size_t begin, size_t end, size_t chunk) {
    for (size_t i = begin; i < end; ++i) {
      Rng rng(seed, rng_stream(RngUse::importon, pass), i);
      trace_importon(scene, strategy, rng, max_events, parts[chunk]);
    }
  });
  for (const ImportanceMap& part : parts) all.merge(part);
  all.finish();
  return all;
}

}  // namespace vpm
