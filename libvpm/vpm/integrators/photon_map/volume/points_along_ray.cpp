// Even steps among photons; and the estimators that sum over photons around points.
#include "vpm/integrators/photon_map/volume/points_along_ray.h"
#include "vpm/integrators/photon_map/check.h"
#include "vpm/integrators/photon_map/volume/estimators.h"
#include "vpm/photon/stored_power.h"

namespace vpm {

KernelEstimate PointsAtPhoton::along(const EyeSegment& segment, EyeWork& work) const {
  if (!segment.around()) return {};
  const Box& around = maps_.around(segment.medium);
  if (around.empty()) return {};
  const PointsOfSegment points(segment, maps_[segment.medium], around, maps_.settings().form);
  const Rgb factor = segment.throughput * source_factor(*segment.around());
  return points.over_share(factor * points.march_evenly(work), work);
}

namespace {

void describe_count(VolumeSettings& settings, Description& description) {
  Members<AskedGather>(settings, description)
      .add("count", &AskedGather::count, Integers{2, 1'000'000}, "how many are nearest");
}

void check_points(const RenderSettings& s, const SceneFacts&) {
  refuse_count_in_blocks(s, s.volume, "integrator.volume.type", "write \"radius\"");
  refuse_correction_in_cubes(s, s.volume, "integrator.volume.boundary");
}

std::unique_ptr<VolumeEstimator> make_points(const VolumePlan& plan) {
  if (plan.settings.form == VolumeForm::density_at_query) return nullptr;
  return std::make_unique<PointsAtPhoton>(plan.scene, plan.settings, plan.pass);
}

}  // namespace

extern const VolumeEstimatorInfo kPointsInRadius{.name = "radius",
                                                 .summary = "photons within the radius of points of a march",
                                                 .check = check_points,
                                                 .make = make_points};

extern const VolumeEstimatorInfo kNearestPoints{.name = "nearest",
                                                .summary = "the nearest few photons to these points",
                                                .mode = GatherMode::nearest,
                                                .describe = describe_count,
                                                .check = check_points,
                                                .make = make_points};

}  // namespace vpm
