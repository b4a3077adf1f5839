// What the eye pass reads: one pass's maps and methods.
#pragma once

#include <memory>
#include <vector>

#include "vpm/base/count.h"
#include "vpm/estimate/beam_estimate.h"
#include "vpm/estimate/irradiance_points.h"
#include "vpm/estimate/photon_map.h"
#include "vpm/render/photon_pass.h"

namespace vpm {

/// Immutable while rays run.
struct EyeContext {
  const Scene& scene;
  const RenderSettings& settings;
  Stages stages;
  std::vector<PhotonMap> volume;  // by medium, under Stages::volume_map without beams; otherwise none
  std::vector<BeamMap> beams;     // by medium, under Stages::beams; otherwise none
  PhotonMap surface;              // under Stages::surface_map; otherwise empty, as below
  PhotonMap caustics;             // under Stages::final_gather
  PhotonMap from_rough;           // by count, under Stages::guided_gather: photons that rough surfaces scattered last
  IrradiancePoints irradiance;    // of the surface map, under Stages::irradiance_points
  std::unique_ptr<TransmittanceEstimator> transmittance;
};

/// The column of the medium over an interval of a ray, m.
inline double counted_column(const Medium& medium, const Ray& ray, const Interval& interval, WalkCounters& counters) {
  const Column crossed = column(medium, ray, interval);
  count(counters.lookups, crossed.lookups);
  return crossed.value;
}

}  // namespace vpm
