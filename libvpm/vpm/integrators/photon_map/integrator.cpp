// How photon maps make passes.
#include "vpm/integrators/photon_map/integrator.h"

#include <memory>

#include "vpm/integrators/integrator.h"
#include "vpm/integrators/photon_map/eye_path.h"
#include "vpm/integrators/photon_map/photon_pass.h"

namespace vpm {
namespace {

PassMaker passes_of_photon_maps(const Scene& scene, const RenderSettings& settings) {
  const auto make = [&scene, &settings](int pass, const RenderResult& so_far, const PassProgress& progress) {
    return render_photon_pass_after(so_far.discs, scene, settings, {pass, progress});
  };
  return {make, tile_count(scene.camera), block_count(settings), settings.radii == RadiusSchedule::per_pixel};
}

RaysOfPass rays_of_photon_maps(const Scene& scene, const RenderSettings& settings, int pass, uint64_t) {
  const auto estimators = std::make_shared<const Estimators>(plan_estimators(scene, settings, pass));
  RaysOfPass rays{[estimators, &scene, events = settings.max_events](std::span<EyeRay> of) {
                    eye_radiance({scene, *estimators, events}, of);
                  },
                  {}};
  prepare_pass(scene, settings, *estimators, {.pass = pass}, rays.statistics);
  return rays;
}

}  // namespace

extern const IntegratorInfo kPhotonMaps;
const IntegratorInfo kPhotonMaps{
    .describe = describe_photon_maps,
    .check = check_photon_maps,
    .passes = passes_of_photon_maps,
    .rays = rays_of_photon_maps,
    .gathers = [](const Scene& scene,
                  const RenderSettings& settings) { return !plan_estimators(scene, settings, 0).maps().empty(); },
    .stages = stages_of_photon_maps,
    .warnings = warnings_of_photon_maps,
};

}  // namespace vpm
