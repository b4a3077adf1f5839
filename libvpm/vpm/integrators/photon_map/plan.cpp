// Settings become estimators.
#include "vpm/integrators/photon_map/plan.h"

#include <cassert>
#include <stdexcept>

#include "vpm/integrators/photon_map/surface/final_gather.h"
#include "vpm/integrators/photon_map/surface/pixel_radii.h"
#include "vpm/integrators/photon_map/surface/surface_map.h"
#include "vpm/integrators/photon_map/volume/estimators.h"
#include "vpm/integrators/photon_map/volume/marched.h"

namespace vpm {
namespace {

using SharedTransmittance = std::shared_ptr<const TransmittanceEstimator>;

PassOfMaps pass_of_maps(const RenderSettings& settings, int pass) {
  return {.number = pass,
          .shrinks = settings.radii != RadiusSchedule::constant,
          .photons_in_cube = settings.photons.in_cube};
}

/// The radii of the pixels' discs in a pass, m.
std::vector<float> radii_of_pixels(const Scene& scene, const RenderSettings& settings, const PixelDiscs& discs) {
  const float first = first_radius(settings.surface, scene);
  std::vector<float> radii(static_cast<size_t>(scene.camera.width) * static_cast<size_t>(scene.camera.height), first);
  assert(discs.empty() || discs.size() == radii.size());
  for (size_t i = 0; i < discs.size(); ++i) radii[i] = disc_radius(discs[i], first);
  return radii;
}

std::vector<std::unique_ptr<VolumeEstimator>> estimators_of_media(const Scene& scene, const RenderSettings& settings,
                                                                  const PassOfMaps& pass,
                                                                  const SharedTransmittance& transmittance) {
  const DirectLight once = settings.single_scattering.type;
  VolumePlan plan{scene,
                  settings.volume,
                  {.maps = pass, .once = once == DirectLight::photons, .seed = settings.seed},
                  transmittance,
                  settings.max_optical_step};
  // Photons that fly by another law than the medium's transmittance do not weigh 1/density where it is thin.
  if (!strategy_info(settings.distance.strategy).analog) plan.settings.density_floor = 0.0f;
  std::vector<std::unique_ptr<VolumeEstimator>> estimators;
  std::optional<VolumeMaps<PhotonMap>> around_points;
  if (auto whole = settings.volume.info().make(plan))
    estimators.push_back(std::move(whole));
  else
    around_points.emplace(scene, plan.settings, plan.pass, 3);
  if (once == DirectLight::equiangular)
    estimators.push_back(std::make_unique<SingleEquiangular>(scene, transmittance, settings.single_scattering.samples));
  std::optional<ScatteredOnce> lights;
  if (once == DirectLight::shadow_rays) lights.emplace(scene, transmittance);
  if (around_points || lights)
    estimators.push_back(
        std::make_unique<MarchedLight>(std::move(around_points), std::move(lights), settings.max_optical_step));
  check_apart(estimators);
  return estimators;
}

std::unique_ptr<SurfaceEstimator> surface_estimator(const Scene& scene, const RenderSettings& settings,
                                                    const PassOfMaps& pass, const PixelDiscs& discs,
                                                    const SharedTransmittance& transmittance) {
  std::optional<SurfaceShadowRays> direct;
  assert(settings.direct.type != DirectLight::equiangular);
  if (settings.direct.type == DirectLight::shadow_rays) direct.emplace(scene, transmittance, settings.direct.samples);
  if (settings.gathers_finally()) return std::make_unique<FinalGather>(scene, settings, pass, std::move(direct));
  const AskedGather& gather = settings.surface;
  if (settings.radii == RadiusSchedule::per_pixel)
    return std::make_unique<PixelRadii>(scene, gather, pass, radii_of_pixels(scene, settings, discs),
                                        std::move(direct));
  if (direct) return std::make_unique<Progressive>(scene, gather, pass, std::move(*direct));
  return std::make_unique<Visualise>(scene, gather, pass);
}

}  // namespace

std::vector<Estimator*> Estimators::all() const {
  std::vector<Estimator*> list;
  for (const auto& estimator : volume) list.push_back(estimator.get());
  if (surface) list.push_back(surface.get());
  return list;
}

std::vector<MapInfo> Estimators::maps() const {
  std::vector<MapInfo> list;
  for (const Estimator* estimator : all())
    for (const MapInfo& map : estimator->maps()) list.push_back(map);
  return list;
}

Recorders Estimators::recorders() const {
  Recorders list;
  for (Estimator* estimator : all())
    for (PhotonRecorder* recorder : estimator->recorders()) list.push_back(recorder);
  return list;
}

Estimators plan_estimators(const Scene& scene, const RenderSettings& settings, int pass, const PixelDiscs& discs,
                           const MediaBounds* around) {
  if (settings.integrator != Integrator::photon) return {};
  const SceneFacts facts = facts_of(scene);
  const SharedTransmittance transmittance = make_transmittance_estimator(settings.transmittance);
  PassOfMaps maps = pass_of_maps(settings, pass);
  maps.around = around;
  Estimators estimators;
  if (facts.scattering_media) estimators.volume = estimators_of_media(scene, settings, maps, transmittance);
  if (facts.rough_surfaces) estimators.surface = surface_estimator(scene, settings, maps, discs, transmittance);
  return estimators;
}

Estimators plan_surface_estimators(const Scene& scene, const RenderSettings& settings, int pass) {
  Estimators estimators = plan_estimators(scene, settings, pass);
  estimators.volume.clear();
  return estimators;
}

void check_apart(const std::vector<std::unique_ptr<VolumeEstimator>>& estimators) {
  for (size_t i = 0; i < estimators.size(); ++i)
    for (size_t j = 0; j < i; ++j)
      if (estimators[i]->finds().overlaps(estimators[j]->finds()))
        throw std::logic_error("two estimators of media are planned that find the same light");
}

bool casts_shadow_rays(const SceneFacts& facts, const RenderSettings& settings) {
  return (facts.scattering_media &&
          (settings.single_scattering.type != DirectLight::photons || settings.volume.info().planes)) ||
         (facts.rough_surfaces && settings.direct.type != DirectLight::photons);
}

std::vector<std::string> maps_of_unseen_bias(const Scene& scene, const RenderSettings& settings) {
  const Estimators planned = plan_estimators(scene, settings, 0);
  std::vector<std::string> sections;
  for (const MapInfo& map : planned.maps())
    if (!map.shows_bias) sections.emplace_back(map.section);
  return sections;
}

}  // namespace vpm
