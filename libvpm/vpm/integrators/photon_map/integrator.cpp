// How photon maps make passes.
#include "vpm/integrators/photon_map/integrator.h"

#include <fmt/format.h>
#include <memory>
#include <mutex>
#include <optional>

#include "vpm/integrators/integrator.h"
#include "vpm/integrators/photon_map/eye_path.h"
#include "vpm/integrators/photon_map/photon_pass.h"
#include "vpm/integrators/photon_map/plan.h"
#include "vpm/integrators/photon_map/volume/estimator_info.h"

namespace vpm {
namespace {

/// The images of lamps, looked for before the first pass that is made.
class FoundOnce {
 public:
  const LampImages& of(const Scene& scene, const RenderSettings& settings) {
    std::call_once(once_, [&] { images_.emplace(scene, settings.seed, settings.max_events); });
    return *images_;
  }

 private:
  std::once_flag once_;
  std::optional<LampImages> images_;
};

PassMaker passes_of_photon_maps(const Scene& scene, const RenderSettings& settings) {
  const auto lamps = std::make_shared<FoundOnce>();
  const auto make = [&scene, &settings, lamps](int pass, const RenderResult& so_far, const PassProgress& progress) {
    const LampImages& images = lamps->of(scene, settings);
    return render_photon_pass_after(so_far.discs, scene, settings, {pass, progress, {}, &images});
  };
  return {make, tile_count(scene.camera), block_count(settings), settings.radii == RadiusSchedule::per_pixel};
}

RaysOfPass rays_of_photon_maps(const Scene& scene, const RenderSettings& settings, int pass) {
  const auto estimators = std::make_shared<const Estimators>(plan_estimators(scene, settings, pass));
  RaysOfPass rays{[estimators, &scene, events = settings.max_events](std::span<EyeRay> of) {
                    eye_radiance({scene, *estimators, events}, of);
                  },
                  {},
                  {},
                  settings.square};
  prepare_pass(scene, settings, *estimators, {.pass = pass}, rays.statistics);
  return rays;
}

/// Photons in media are gathered along rays, as points or as beams. "corrected" corrects balls alone.
std::vector<Way> ways_of_photon_maps(const Scene& scene, const AutomaticSettings& automatic, const Way& given) {
  const bool open = automatic.has("integrator.type") || automatic.has("integrator.volume.type");
  if (!open || given.settings.volume.boundary == BoundaryRule::corrected ||
      plan_estimators(scene, given.settings, 0).volume.empty())
    return {given};
  std::vector<Way> ways;
  for (const std::string_view type : {"beam", "photon-beams"}) {
    Way& way = ways.emplace_back(given);
    way.settings.volume.choose(type);
    way.name += fmt::format(" by {}", type);
  }
  return ways;
}

/// As one over the area of discs, or over the width of flights.
double power_of_noise_of_photon_maps(const RenderSettings& settings) {
  return settings.volume.info().flights ? 1.0 : 2.0;
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
    .ways = ways_of_photon_maps,
    .power_of_noise = power_of_noise_of_photon_maps,
};

}  // namespace vpm
