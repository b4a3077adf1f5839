// Building the surface map, and gathering from it.
#include "vpm/integrators/photon_map/surface/surface_map.h"

#include <algorithm>

#include "vpm/base/counters.h"
#include "vpm/estimate/surface_region.h"
#include "vpm/integrators/photon_map/check.h"

namespace vpm {

template KernelEstimate surface_irradiance(const Vec3&, const Vec3&, const PhotonMap&);
template KernelEstimate surface_irradiance(const Vec3&, const Vec3&, const CountedMap&);
template KernelEstimate surface_irradiance(const Vec3&, const Vec3&, const BoundedMap<SurfaceRegion>&);
template KernelEstimate shaded_irradiance(const Hit&, const Vec3&, const CountedMap&);
template KernelEstimate scattered_radiance(const Material&, const Hit&, const Vec3&, const PhotonMap&);
template KernelEstimate scattered_radiance(const Material&, const Hit&, const Vec3&, const CountedMap&);
template KernelEstimate scattered_radiance(const Material&, const Hit&, const Vec3&, const BoundedMap<SurfaceRegion>&);

KernelEstimate gather_from(const PhotonMap& map, const Scene& scene, const SurfaceView& view, EyeWork& work) {
  count(work.counters.surface_queries);
  if (map.settings.boundary == BoundaryRule::none)
    return scattered_radiance(view.material, view.hit, -view.travel, CountedMap{map, work.gather()});
  const SurfaceRegion region(scene, view.hit, -view.travel, map.settings);
  return scattered_radiance(view.material, view.hit, -view.travel, BoundedMap{map, region, work.gather()});
}

namespace {

/// Are there surfaces for which the powers of photons alone count? The bodies of lamps, which are black, are none.
bool has_diffuse(const Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const Material& material) { return is_diffuse(material) && is_rough(material); });
}

}  // namespace

void SurfaceMap::build(RenderStatistics& statistics) {
  statistics.surface_photons = hits_.photons.size();
  const GatherSettings gather = gather_in_pass(gather_, first_radius(gather_, scene_), 2, pass_);
  map_ = make_map(hits_.photons, gather, hits_.emitted_count, pass_, statistics);
  if (has_diffuse(scene_)) statistics.photon_map_bytes += map_.prepare_sums_by_nodes();
  statistics.last_surface_radius = map_.settings.radius;
}

void check_surface_map(const RenderSettings& s) {
  refuse_count_in_blocks(s, s.surface, "integrator.surface.type", "write \"radius\"");
  refuse_correction_in_cubes(s, s.surface, "integrator.surface.boundary");
}

}  // namespace vpm
