// What photons and paths from the eye make of a scattering, which differ by a factor.
#include "vpm/path/follow.h"

namespace vpm {
namespace {

/// Draws the outcome; `scatter` becomes that of a surface.
bool draw_outcome(const Scene& scene, const Event& event, PathState& state, Rng& rng, Scatter& scatter) {
  if (event.kind == EventKind::collision)
    return scatter_in_medium(scene.media[state.medium].properties(state.ray.origin), state, rng);
  return scatter_at_surface(scene, event.hit, state, rng, scatter);
}

}  // namespace

bool scatter_photon(const Scene& scene, const Event& event, PathState& state, Rng& rng) {
  Scatter scatter;
  if (!draw_outcome(scene, event, state, rng, scatter)) return false;
  state.throughput *= scatter.flux_scale;
  return true;
}

bool scatter_eye_path(const Scene& scene, const Event& event, PathState& state, Rng& rng) {
  Scatter scatter;
  if (!draw_outcome(scene, event, state, rng, scatter)) return false;
  state.throughput *= scatter.radiance_scale;
  return true;
}

}  // namespace vpm
