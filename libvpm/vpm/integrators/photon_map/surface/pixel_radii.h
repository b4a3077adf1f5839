// Estimates the light of surfaces from their photon map. Each pixel has a radius of its own, which shrinks as the pixel
// finds photons [Hachisuka2009].
#pragma once

#include <optional>

#include "vpm/integrators/photon_map/surface/surface_map.h"
#include "vpm/integrators/photon_map/surface/surface_shadow_rays.h"

namespace vpm {

struct RenderSettings;

/// What radii of pixels' own ask of other settings: they are those of gathers by radius, straight from the map of
/// single photons.
void check_pixel_radii(const RenderSettings& settings);

class PixelRadii final : public SurfaceEstimator {
 public:
  /// `radii` are those of the pixels in this pass, m. The map is gathered by radius, without correction at borders.
  /// Without `direct`, it also holds the light that comes straight from lights.
  PixelRadii(const Scene& scene, const AskedGather& gather, const PassOfMaps& pass, std::vector<float> radii,
             std::optional<SurfaceShadowRays> direct);

  std::vector<MapInfo> maps() const override { return {map_.info()}; }
  Recorders recorders() override { return {map_.recorder()}; }
  void build(uint64_t emitted, RenderStatistics& statistics) override;
  KernelEstimate found_by_rays(const SurfaceView& view, EyeWork& work) const override;
  std::vector<uint64_t> take_found() override { return std::move(found_); }

 private:
  std::vector<float> radii_;
  std::optional<SurfaceShadowRays> direct_;
  SurfaceMap map_;
  mutable std::vector<uint64_t> found_;  // by pixel, each written by the one thread that renders that pixel
};

}  // namespace vpm
