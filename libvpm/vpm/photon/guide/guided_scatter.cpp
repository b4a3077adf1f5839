// Tracks of importons by cube and direction, drawing directions from them, and the mixture of two densities, in media
// and at surfaces.
#include "vpm/photon/guide/guided_scatter.h"

#include <algorithm>
#include <cassert>

#include "vpm/base/warp.h"
#include "vpm/surface/shading.h"

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

namespace {

/// The share of directions that are drawn from the guide. A photon that goes elsewhere grows by 1 / (1 - share) each
/// time it scatters: of half of them these powers' spread would cost more than the guide gains.
constexpr float kGuided = 0.1f;

/// What a photon's power is multiplied by whose direction has these two densities, 1/sr: the first is what it would be
/// drawn with if it was not guided.
float mixture_weight(float own, float guided) {
  return own > 0.0f ? own / ((1.0f - kGuided) * own + kGuided * guided) : 0.0f;
}

/// The guide's density over the directions that leave a surface. Where light does not pass through, directions into it
/// are replaced by their mirror images.
class LeavingDensity {
 public:
  LeavingDensity(const DirectionDensity& known, const Material& material, const Hit& hit, const Vec3& travel)
      : known_(known), through_(scatters_through(material)), normal_(hit.shading_normal) {
    if (glm::dot(normal_, travel) > 0.0f) normal_ = -normal_;
  }
  Vec3 sample(Rng& rng) const {
    const Vec3 direction = known_.sample(rng);
    return through_ || glm::dot(direction, normal_) > 0.0f ? direction : mirror_image(direction);
  }
  float pdf(const Vec3& direction) const {
    return through_ ? known_.pdf(direction) : known_.pdf(direction) + known_.pdf(mirror_image(direction));
  }

 private:
  Vec3 mirror_image(const Vec3& d) const { return d - 2.0f * glm::dot(d, normal_) * normal_; }

  const DirectionDensity& known_;
  bool through_;
  Vec3 normal_;  // on the side that the path comes from
};

}  // namespace

bool scatter_in_medium(const DirectionGuide& guide, const MediumProperties& here, PathState& state, Rng& rng) {
  const Vec3 travel = state.ray.direction;
  if (!scatter_in_medium(here, state, rng)) return false;
  const DirectionDensity known = guide.at(state.ray.origin);
  if (!known) return true;
  Vec3& direction = state.ray.direction;
  if (rng.uniform() < kGuided) direction = known.sample(rng);
  state.throughput *= mixture_weight(phase_value(here.phase, travel, direction), known.pdf(direction));
  return true;
}

bool scatter_at_surface(const DirectionGuide& guide, const Scene& scene, const Hit& hit, PathState& state, Rng& rng,
                        Scatter& scatter) {
  const Material material = material_at(scene, hit);
  const DirectionDensity known = guide.at(hit.position);
  if (!known || !is_rough(material)) return scatter_at_surface(scene, hit, state, rng, scatter);
  const Vec3 travel = state.ray.direction;
  const LeavingDensity leaving(known, material, hit, travel);
  if (rng.uniform() < kGuided) {
    scatter = scatter_into(material, hit, travel, leaving.sample(rng));
  } else {
    const float choice = rng.uniform();
    scatter = sample_scatter(material, hit, travel, choice, rng.uniform2());
  }
  const float weight = mixture_weight(scatter.pdf, leaving.pdf(scatter.direction));
  const bool alive = go_on_from(scene, hit, scatter, state, rng);
  state.throughput *= weight;
  scatter.weight *= weight;
  return alive;
}

}  // namespace vpm
