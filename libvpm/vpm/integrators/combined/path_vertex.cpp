// Scattering at vertices.
#include "vpm/integrators/combined/path_vertex.h"

#include "vpm/base/counters.h"
#include "vpm/surface/shading.h"

namespace vpm {

Scattered scattered_into(const Scene& scene, const PathVertex& vertex, const Vec3& direction, SubPath way) {
  if (!vertex.on_surface) {
    const MediumProperties there = scene.media[vertex.medium].properties(vertex.point);
    const double phase = phase_value(there.phase, vertex.travel, direction);
    return {there.albedo() * static_cast<float>(phase), {phase, phase}};
  }
  const ScatterValue there = scatter_value(vertex.material, vertex.hit, vertex.travel, direction);
  if (is_black(there.value)) return {};
  const ScatterValue back = scatter_value(vertex.material, vertex.hit, -direction, -vertex.travel);
  const float scale = way == SubPath::eye ? there.radiance_scale
                                          : shading_irradiance_scale(vertex.hit, vertex.travel) /
                                                shading_irradiance_scale(vertex.hit, direction);
  return {there.value * scale, {there.pdf, back.pdf}};
}

std::optional<Densities> scatter(const Scene& scene, const PathVertex& vertex, SubPath way, PathState& state,
                                 Rng& rng) {
  if (!vertex.on_surface) {
    const MediumProperties there = scene.media[vertex.medium].properties(vertex.point);
    if (!scatter_in_medium(there, state, rng)) return std::nullopt;
    const double phase = phase_value(there.phase, vertex.travel, state.ray.direction);
    return Densities{phase, phase};
  }
  Scatter drawn;
  if (!scatter_at_surface(scene, vertex.hit, state, rng, drawn)) return std::nullopt;
  state.throughput *= way == SubPath::eye ? drawn.radiance_scale : drawn.flux_scale;
  if (vertex.specular) return Densities{1.0, drawn.radiance_scale};
  return Densities{drawn.pdf, scatter_value(vertex.material, vertex.hit, -state.ray.direction, -vertex.travel).pdf};
}

double integral_along(const Medium& medium, const Track& track, WalkCounters& counters) {
  if (track.integral != kNotKnown) return track.integral;
  const DensityIntegral integral = density_integral(medium, track.ray, track.interval);
  count(counters.lookups, integral.lookups);
  return integral.value;
}

PathState leave(const Scene& scene, const PathVertex& vertex, const Vec3& direction) {
  if (!vertex.on_surface) return {{vertex.point, direction}, vertex.medium};
  const bool goes_on = glm::dot(vertex.hit.normal, direction) * glm::dot(vertex.hit.normal, vertex.travel) > 0.0f;
  const Shape& shape = scene.shapes[vertex.hit.shape];
  const MediumId medium = goes_on ? medium_beyond(shape, vertex.hit.normal, direction, vertex.medium) : vertex.medium;
  return {{leave_surface(vertex.hit, direction), direction}, medium};
}

}  // namespace vpm
