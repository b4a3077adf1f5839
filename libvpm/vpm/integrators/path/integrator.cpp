// The reference path tracer as an integrator.
#include "vpm/integrators/integrator.h"

#include <memory>

#include "vpm/integrators/path/path_tracer.h"
#include "vpm/integrators/stages.h"
#include "vpm/integrators/words.h"

namespace vpm {
namespace {

void describe_paths(RenderSettings& s, Description& d) {
  describe(s.distance, names_of(distance_strategies()), "regular", d.in("integrator.distance"));
  describe(s.transmittance, d.in("integrator.transmittance"));
}

PassMaker passes_of_paths(const Scene& scene, const RenderSettings& settings) {
  const auto make = [&scene, &settings](int pass, const RenderResult&, const PassProgress& progress) {
    return render_path_pass(scene, settings, pass, progress);
  };
  return {make, tile_count(scene.camera)};
}

RaysOfPass rays_of_paths(const Scene& scene, const RenderSettings& settings, int pass) {
  const auto context = std::make_shared<const PathContext>(make_path_context(scene, settings, pass));
  const auto radiance = [context, &scene](const Ray& ray, EyeWork& work) -> KernelEstimate {
    return {path_radiance(*context, ray, medium_of_ray(scene, scene.camera_medium, ray), work.rng, work.counters)};
  };
  return {ray_by_ray(radiance), {}};
}

std::vector<std::string> stages_of_paths(const Scene& scene, const RenderSettings& settings, const SceneFacts&) {
  return {"runs path tracing" + distances_text(settings) + transmittance_text(settings),
          "skips photon tracing and maps: the integrator is the path tracer", channels_text(scene)};
}

}  // namespace

extern const IntegratorInfo kPathTracer;
const IntegratorInfo kPathTracer{
    .describe = describe_paths,
    .passes = passes_of_paths,
    .rays = rays_of_paths,
    .stages = stages_of_paths,
};

}  // namespace vpm
