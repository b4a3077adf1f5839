// The mixture of two densities, in media and at surfaces.
#include "vpm/photon/guided_scatter.h"

#include "vpm/surface/shading.h"

namespace vpm {
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

bool scatter_in_medium(const DirectionGuide& guide, const Medium& medium, PathState& state, Rng& rng) {
  const Vec3 travel = state.ray.direction;
  if (!scatter_in_medium(medium, state, rng)) return false;
  const DirectionDensity known = guide.at(state.ray.origin);
  if (!known) return true;
  Vec3& direction = state.ray.direction;
  if (rng.uniform() < kGuided) direction = known.sample(rng);
  state.throughput *= mixture_weight(phase_value(medium.phase, travel, direction), known.pdf(direction));
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
