// What each integrator reads is shared by the copies of its function.
#include "vpm/tune/rays_of_pass.h"

#include <memory>
#include <utility>

#include "vpm/integrators/combined/combined_pass.h"
#include "vpm/integrators/path/path_tracer.h"
#include "vpm/integrators/photon_map/eye_path.h"
#include "vpm/integrators/photon_map/photon_pass.h"
#include "vpm/integrators/photon_map/plan.h"

namespace vpm {
namespace {

RaysOfPass rays_of_path_pass(const Scene& scene, const RenderSettings& settings, int pass) {
  const auto context = std::make_shared<const PathContext>(make_path_context(scene, settings, pass));
  const auto radiance = [context, &scene](const Ray& ray, EyeWork& work) -> KernelEstimate {
    return {path_radiance(*context, ray, medium_of_ray(scene, scene.camera_medium, ray), work.rng, work.counters)};
  };
  return {ray_by_ray(radiance), {}};
}

RaysOfPass rays_of_photon_pass(const Scene& scene, const RenderSettings& settings, int pass) {
  const auto estimators = std::make_shared<const Estimators>(plan_estimators(scene, settings, pass));
  RaysOfPass rays{[estimators, &scene, events = settings.max_events](std::span<EyeRay> of) {
                    eye_radiance({scene, *estimators, events}, of);
                  },
                  {}};
  prepare_pass(scene, settings, *estimators, {.pass = pass}, rays.statistics);
  return rays;
}

RaysOfPass rays_of_combined_pass(const Scene& scene, const RenderSettings& settings, int pass,
                                 uint64_t paths_of_shares) {
  const auto ready = std::make_shared<const CombinedPass>(scene, settings, pass, SoughtLight::all, paths_of_shares);
  RaysOfPass rays{[ready](std::span<EyeRay> of) { ready->radiance(of); },
                  Image(scene.camera.width, scene.camera.height), ready->statistics()};
  ready->add_light_tracing(rays.light_tracing);
  return rays;
}

}  // namespace

RaysOfPass rays_of_pass(const Scene& scene, const RenderSettings& settings, int pass, uint64_t paths_of_shares) {
  switch (settings.integrator) {
    case Integrator::path:
      return rays_of_path_pass(scene, settings, pass);
    case Integrator::combined:
      return rays_of_combined_pass(scene, settings, pass, paths_of_shares);
    case Integrator::photon:
      return rays_of_photon_pass(scene, settings, pass);
  }
  __builtin_unreachable();
}

}  // namespace vpm
