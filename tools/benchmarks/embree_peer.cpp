// Embree's point queries.
#include "benchmarks/photons.h"
#include "vpm/surface/embree.h"

namespace vpm::bench {
namespace {

/// What a query sums up, with the photons it looks at.
struct SumWithin {
  const std::vector<Photon>& photons;
  double sum = 0.0;
};

bool add_point(RTCPointQueryFunctionArguments* arguments) {
  auto& within = *static_cast<SumWithin*>(arguments->userPtr);
  const RTCPointQuery& query = *arguments->query;
  const Vec3 offset = within.photons[arguments->primID].position - Vec3(query.x, query.y, query.z);
  const float distance2 = glm::dot(offset, offset), radius2 = query.radius * query.radius;
  if (distance2 < radius2) within.sum += radius2 - distance2;
  return false;  // the radius stays
}

void bound_point(const RTCBoundsFunctionArguments* arguments) {
  const auto& photons = *static_cast<const std::vector<Photon>*>(arguments->geometryUserPtr);
  const Vec3& p = photons[arguments->primID].position;
  *arguments->bounds_o = {p.x, p.y, p.z, 0.0f, p.x, p.y, p.z, 0.0f};
}

class EmbreeIndex final : public PointIndex {
 public:
  explicit EmbreeIndex(const std::vector<Photon>& photons)
      : photons_(photons), device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(photons.size()));
    rtcSetGeometryUserData(geometry, const_cast<std::vector<Photon>*>(&photons));
    rtcSetGeometryBoundsFunction(geometry, bound_point, nullptr);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~EmbreeIndex() override {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeIndex(const EmbreeIndex&) = delete;
  EmbreeIndex& operator=(const EmbreeIndex&) = delete;

  double sum_near(std::span<const Vec3> queries, float radius) const override {
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    double sum = 0.0;
    for (const Vec3& q : queries) {
      RTCPointQuery query{q.x, q.y, q.z, 0.0f, radius};
      SumWithin within{photons_};
      rtcPointQuery(scene_, &query, &context, add_point, &within);
      sum += within.sum;
    }
    return sum;
  }

 private:
  const std::vector<Photon>& photons_;
  RTCDevice device_;
  RTCScene scene_;
};

}  // namespace

std::unique_ptr<PointIndex> make_embree_index(const std::vector<Photon>& photons) {
  return std::make_unique<EmbreeIndex>(photons);
}

}  // namespace vpm::bench
