// Sums over photons around points of the ray's own medium, and even steps among photons.
#include "vpm/integrators/photon_map/volume/points_along_ray.h"
#include "vpm/integrators/photon_map/volume/estimators.h"
#include "vpm/integrators/photon_map/volume/points_of_segment.h"
#include "vpm/photon/stored_power.h"

namespace vpm {

void PointsAtQuery::build(uint64_t emitted, RenderStatistics& statistics) {
  maps_.build(emitted, statistics,
              [&](std::vector<Photon>& photons, const GatherSettings& gather, float, uint64_t of, RenderStatistics& s) {
                return make_map(photons, gather, of, maps_.settings().pass, s);
              });
}

MarchedSource::Reach PointsAtQuery::reach(const EyeSegment& segment) const {
  const Box& around = maps_.around(segment.number);
  if (around.empty()) return {{0.0f, 0.0f}, kInfinity, std::nullopt};
  const PhotonMap& map = maps_[segment.number];
  Reach reach{{0.0f, 0.0f}, kInfinity, PointsOfSegment(segment, map, around, VolumeForm::density_at_query)};
  if (reach.points->seen_one_by_one()) return reach;
  reach.interval = reach.points->reach();
  reach.step = step_among(map.settings.radius, reach.interval);
  return reach;
}

KernelEstimate PointsAtQuery::evenly(const EyeSegment& segment, const Reach& reach, EyeWork& work) const {
  if (!reach.points || !reach.points->seen_one_by_one()) return {};
  return source_factor(*segment.medium()) * reach.points->march_evenly(work);
}

KernelEstimate PointsAtQuery::at(const EyeSegment& segment, const Reach& reach, const Vec3& point,
                                 EyeWork& work) const {
  return source_factor(*segment.medium()) * reach.points->sum(point, work);
}

void PointsAtPhoton::build(uint64_t emitted, RenderStatistics& statistics) {
  maps_.build(emitted, statistics,
              [&](std::vector<Photon>& photons, const GatherSettings& gather, float, uint64_t of, RenderStatistics& s) {
                return make_map(photons, gather, of, maps_.settings().pass, s);
              });
}

KernelEstimate PointsAtPhoton::along(const EyeSegment& segment, EyeWork& work) const {
  if (!segment.medium()) return {};
  const Box& around = maps_.around(segment.number);
  if (around.empty()) return {};
  const PointsOfSegment points(segment, maps_[segment.number], around, maps_.settings().form);
  const Rgb factor = segment.throughput * source_factor(*segment.medium());
  return points.over_share(factor * points.march_evenly(work), work);
}

namespace {

void describe_count(VolumeSettings& settings, Description& description) {
  Members<AskedGather>(settings, description)
      .add("count", &AskedGather::count, Integers{2, 1'000'000}, "how many are nearest");
}

void make_points(const VolumePlan& plan, VolumeEstimators& made) {
  if (plan.maps.form == VolumeForm::density_at_photon)
    made.whole.push_back(std::make_unique<PointsAtPhoton>(plan.scene, plan.maps));
  else
    made.marched.push_back(std::make_unique<PointsAtQuery>(plan.scene, plan.maps));
}

}  // namespace

extern const VolumeEstimatorInfo kPointsInRadius{
    .name = "radius", .summary = "photons within the radius of points of a march", .make = make_points};

extern const VolumeEstimatorInfo kNearestPoints{.name = "nearest",
                                                .summary = "the nearest few photons to these points",
                                                .mode = GatherMode::nearest,
                                                .describe = describe_count,
                                                .make = make_points};

}  // namespace vpm
