// The volumetric radiance estimate [Jarosz2008, eq. 7.10, corrected] at points along an eye ray.
#pragma once

#include "vpm/integrators/photon_map/volume/marched.h"
#include "vpm/integrators/photon_map/volume/volume_maps.h"

namespace vpm {

/// At points of a march, with the density at the query. Photons around a point, by radius or by count.
class PointsAtQuery final : public MarchedSource {
 public:
  /// The gather is around points.
  PointsAtQuery(const Scene& scene, const VolumeMapSettings& settings) : maps_(scene, settings, 3) {}

  ScatteredLight finds() const override { return maps_.finds(); }
  std::vector<MapInfo> maps() const override { return maps_.maps(); }
  Recorders recorders() override { return maps_.recorders(); }
  void build(uint64_t emitted, RenderStatistics& statistics) override;
  Reach reach(const EyeSegment& segment) const override;
  KernelEstimate evenly(const EyeSegment& segment, const Reach& reach, EyeWork& work) const override;
  KernelEstimate at(const EyeSegment& segment, const Reach& reach, const Vec3& point, EyeWork& work) const override;

 private:
  VolumeMaps<PhotonMap> maps_;
};

/// With the density at the photon, among the photons of the medium that the ray is in, also where its density is 0.
/// Marches evenly among the photons.
class PointsAtPhoton final : public VolumeEstimator {
 public:
  /// The gather is around points.
  PointsAtPhoton(const Scene& scene, const VolumeMapSettings& settings) : maps_(scene, settings, 3) {}

  ScatteredLight finds() const override { return maps_.finds(); }
  std::vector<MapInfo> maps() const override { return maps_.maps(); }
  Recorders recorders() override { return maps_.recorders(); }
  void build(uint64_t emitted, RenderStatistics& statistics) override;
  KernelEstimate along(const EyeSegment& segment, EyeWork& work) const override;

 private:
  VolumeMaps<PhotonMap> maps_;
};

}  // namespace vpm
