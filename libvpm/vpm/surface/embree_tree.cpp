// Calls Embree, and is called by it.
#include "vpm/surface/embree_tree.h"

#include <algorithm>
#include <cassert>
#include <stdexcept>

#include "vpm/base/cancel.h"
#include "vpm/surface/distance.h"
#include "vpm/surface/embree.h"
#include "vpm/surface/locate.h"

namespace vpm {

static_assert(sizeof(Vec3) == 3 * sizeof(float) && sizeof(glm::uvec3) == 3 * sizeof(uint32_t),
              "Embree's buffer layout");

namespace {

/// Embree's callbacks for a shape of our own.
template <class S>
void own_bounds(const RTCBoundsFunctionArguments* args) {
  const auto& s = *static_cast<const S*>(args->geometryUserPtr);
  const Box box = bounds_of(s);
  const Vec3 margin = 0x1p-22f * (glm::abs(s.center) + s.radius);  // rounding must not cut the shape
  const Vec3 lo = box.lo - margin, hi = box.hi + margin;
  *args->bounds_o = RTCBounds{lo.x, lo.y, lo.z, 0.0f, hi.x, hi.y, hi.z, 0.0f};
}

/// A search as Embree hands it to its callbacks.
struct EmbreeQuery : EmbreeContext {
  Query& query;

  explicit EmbreeQuery(Query& a_query) : EmbreeContext{}, query(a_query) { init_context(*this); }
};
Query& query_of(EmbreeContext* context) { return static_cast<EmbreeQuery*>(context)->query; }

/// Embree's callback for a triangle that it found. Its distance becomes the limit, which is no further than Embree was
/// looking already.
void meet_triangle(const RTCFilterFunctionNArguments* args) {
  assert(args->N == 1);
  Query& query = query_of(args->context);
  const unsigned shape = RTCHitN_geomID(args->hit, 1, 0), triangle = RTCHitN_primID(args->hit, 1, 0);
  const auto& mesh = *static_cast<const MeshShape*>(args->geometryUserPtr);
  if (!query.leaves_out(shape) && query.take(crossing(mesh, triangle, query.ray), shape, triangle))
    RTCRayN_tfar(args->ray, 1, 0) = query.limit;
  else
    args->valid[0] = 0;
}

template <class S>
void own_intersect(const RTCIntersectFunctionNArguments* args) {
  assert(args->N == 1);
  if (args->valid[0] == 0) return;
  Query& query = query_of(args->context);
  if (query.leaves_out(args->geomID)) return;
  if (query.take(crossing(*static_cast<const S*>(args->geometryUserPtr), query.ray), args->geomID, 0))
    reinterpret_cast<RTCRayHit*>(args->rayhit)->ray.tfar = query.limit;
}

/// A search for a shape near a point, as Embree hands it to is_within_reach().
struct Search {
  const std::deque<ShapeData>& shapes;
  Vec3 point;
  float radius;  // m
  bool found = false;
};

/// Looks at one primitive whose box Embree found near the point; ends the search where it is near itself.
bool is_within_reach(RTCPointQueryFunctionArguments* args) {
  auto& search = *static_cast<Search*>(args->userPtr);
  if (search.found) return false;
  const ShapeData& shape = search.shapes[args->geomID];
  double distance = kInfinity;
  if (const auto* mesh = std::get_if<MeshShape>(&shape)) {
    const glm::uvec3& v = mesh->triangles[args->primID];
    distance = distance_to_triangle(search.point, mesh->positions[v.x], mesh->positions[v.y], mesh->positions[v.z]);
  }
  if (const auto* sphere = std::get_if<SphereShape>(&shape)) distance = distance_to(*sphere, search.point);
  if (const auto* disc = std::get_if<DiscShape>(&shape)) distance = distance_to(*disc, search.point);
  search.found = distance <= search.radius;
  if (search.found) args->query->radius = 0.0f;
  return search.found;
}

/// Embree calls these from C code, through which no exception may pass.
void on_error(void* error, RTCError code, const char* message) {
  *static_cast<std::string*>(error) =
      "Embree: " + std::string(message ? message : "") + ", error " + std::to_string(code);
}
bool on_memory(void* bytes, ssize_t change, bool) {
  *static_cast<std::atomic<int64_t>*>(bytes) += change;
  return true;
}

}  // namespace

EmbreeTree::EmbreeTree(const std::deque<ShapeData>& shapes) : shapes_(shapes), device_(rtcNewDevice(nullptr)) {
  if (!device_) throw std::runtime_error("Embree: no device, error " + std::to_string(rtcGetDeviceError(nullptr)));
  rtcSetDeviceErrorFunction(device_, on_error, &error_);
  rtcSetDeviceMemoryMonitorFunction(device_, on_memory, &bytes_);
  scene_ = rtcNewScene(device_);
  rtcSetSceneFlags(scene_, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | kEmbreeFilters));
  check();
}

EmbreeTree::~EmbreeTree() {
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

void EmbreeTree::check() const {
  if (!error_.empty()) throw std::runtime_error(error_);
}

void EmbreeTree::attach(RTCGeometryTy* geometry, Layer layer) {
  rtcSetGeometryMask(geometry, static_cast<uint32_t>(layer));
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene_, geometry, static_cast<unsigned>(shapes_.size() - 1));
  rtcReleaseGeometry(geometry);
  check();
}

void EmbreeTree::add(MeshShape& shape, std::span<const Vec3> positions, std::span<const glm::uvec3> triangles,
                     Layer layer) {
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  const auto copied = [&]<class T>(RTCBufferType type, RTCFormat format, std::span<const T> from) {
    auto* to = static_cast<T*>(rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), from.size()));
    check();
    return std::copy(from.begin(), from.end(), to) - from.size();
  };
  shape.positions = copied(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, positions);
  shape.triangles = copied(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, triangles);
  rtcSetGeometryUserData(geometry, &shape);
  attach(geometry, layer);
}

template <class S>
void EmbreeTree::add_own(const S& shape, Layer layer) {
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, 1);
  rtcSetGeometryUserData(geometry, const_cast<S*>(&shape));
  rtcSetGeometryBoundsFunction(geometry, own_bounds<S>, nullptr);
  rtcSetGeometryIntersectFunction(geometry, own_intersect<S>);
  attach(geometry, layer);
}

void EmbreeTree::add(const SphereShape& shape, Layer layer) { add_own(shape, layer); }
void EmbreeTree::add(const DiscShape& shape, Layer layer) { add_own(shape, layer); }

void EmbreeTree::commit() {
  const auto go_on = [](void* flags, double) { return !is_cancelled(static_cast<const CancelFlags*>(flags)); };
  rtcSetSceneProgressMonitorFunction(scene_, go_on, const_cast<CancelFlags*>(cancel_flags));
  rtcCommitScene(scene_);
  rtcSetSceneProgressMonitorFunction(scene_, nullptr, nullptr);
  cancellation_point();
  check();
}

void EmbreeTree::look_along(Query& query, uint32_t layers) const {
  RTCRayHit found{};
  found.ray.org_x = query.ray.origin.x;
  found.ray.org_y = query.ray.origin.y;
  found.ray.org_z = query.ray.origin.z;
  found.ray.dir_x = query.ray.direction.x;
  found.ray.dir_y = query.ray.direction.y;
  found.ray.dir_z = query.ray.direction.z;
  found.ray.tnear = kMinT;
  found.ray.tfar = query.limit;
  found.ray.mask = layers;
  found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  EmbreeQuery context(query);
  embree_intersect(scene_, context, meet_triangle, found);
}

bool EmbreeTree::is_near(const Vec3& point, float radius) const {
  RTCPointQuery query{point.x, point.y, point.z, 0.0f, radius};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  Search search{shapes_, point, radius};
  rtcPointQuery(scene_, &query, &context, is_within_reach, &search);
  return search.found;
}

}  // namespace vpm
