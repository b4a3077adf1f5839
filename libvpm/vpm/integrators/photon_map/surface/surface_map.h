// The photon map of surfaces, as estimators gather from it, and the two estimators that need little more.
#pragma once

#include "vpm/estimate/photon_map.h"
#include "vpm/integrators/photon_map/estimator.h"
#include "vpm/integrators/photon_map/surface/surface_shadow_rays.h"
#include "vpm/photon/records.h"

namespace vpm {

/// The surface radiance estimate [Jarosz2008, eq. 7.5, corrected] at a hit, gathered as the settings of the map say,
/// with or without the correction at borders.
KernelEstimate gather_from(const PhotonMap& map, const Scene& scene, const SurfaceView& view, EyeWork& work);

struct RenderSettings;

/// What the surface map asks of other settings.
void check_surface_map(const RenderSettings& settings);

/// Records, sorts and gathers the photons on non-specular surfaces.
class SurfaceMap {
 public:
  /// A map of the photons that the filter takes.
  SurfaceMap(const Scene& scene, const AskedGather& gather, const PassOfMaps& pass, PhotonFilter filter,
             HitUse use = HitUse::surface_map)
      : scene_(scene), gather_(gather), pass_(pass), hits_(scene, filter, use) {}

  /// The map whose settings are in the table [integrator.surface] of the scene file.
  MapInfo info() const {
    return {.section = "surface",
            .dimension = 2,
            .surfaces = &hits_.photons,
            .emitted = hits_.emitted_count,
            .surface_histories = &hits_.histories};
  }
  PhotonRecorder* recorder() { return &hits_; }
  void build(RenderStatistics& statistics);
  KernelEstimate gather(const SurfaceView& view, EyeWork& work) const { return gather_from(map_, scene_, view, work); }
  /// Of the kernels of gather(): SurfaceEstimator::kernel_variance().
  float kernel_variance() const { return variance_of(map_.settings, 2); }
  const PhotonMap& map() const { return map_; }

 private:
  const Scene& scene_;
  AskedGather gather_;
  PassOfMaps pass_;
  HitRecorder hits_;
  PhotonMap map_;
};

/// All light of surfaces from their photon map, seen straight: what the map holds is what is seen.
class Visualise final : public SurfaceEstimator {
 public:
  Visualise(const Scene& scene, const AskedGather& gather, const PassOfMaps& pass)
      : map_(scene, gather, pass, any_photon) {}

  std::vector<MapInfo> maps() const override { return {map_.info()}; }
  Recorders recorders() override { return {map_.recorder()}; }
  void build(uint64_t, RenderStatistics& statistics) override { map_.build(statistics); }
  KernelEstimate found_by_photons(const SurfaceView& view, EyeWork& work) const override {
    return map_.gather(view, work);
  }
  float kernel_variance() const override { return map_.kernel_variance(); }

 private:
  SurfaceMap map_;
};

/// Direct light of surfaces by shadow rays, all other from their photon map, whose radius shrinks from pass to pass.
class Progressive final : public SurfaceEstimator {
 public:
  Progressive(const Scene& scene, const AskedGather& gather, const PassOfMaps& pass, SurfaceShadowRays direct)
      : map_(scene, gather, pass, indirect_photon), direct_(std::move(direct)) {}

  std::vector<MapInfo> maps() const override { return {map_.info()}; }
  Recorders recorders() override { return {map_.recorder()}; }
  void build(uint64_t, RenderStatistics& statistics) override { map_.build(statistics); }
  KernelEstimate found_by_rays(const SurfaceView& view, EyeWork& work) const override {
    return direct_.sent(view, work);
  }
  KernelEstimate found_by_photons(const SurfaceView& view, EyeWork& work) const override {
    return map_.gather(view, work);
  }
  float kernel_variance() const override { return map_.kernel_variance(); }

 private:
  SurfaceMap map_;
  SurfaceShadowRays direct_;
};

}  // namespace vpm
