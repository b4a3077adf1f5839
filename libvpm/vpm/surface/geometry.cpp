// The shapes of a scene: each looked at for each ray where they are few, found by Embree where they are many.
#include "vpm/surface/geometry.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <deque>
#include <span>
#include <stdexcept>
#include <string>
#include <variant>

#include "vpm/surface/check_shapes.h"
#include "vpm/surface/disc.h"
#include "vpm/surface/distance.h"
#include "vpm/surface/embree.h"
#include "vpm/surface/few_triangles.h"
#include "vpm/surface/locate.h"
#include "vpm/surface/mesh.h"
#include "vpm/surface/query.h"
#include "vpm/surface/sphere.h"

namespace vpm {

static_assert(sizeof(Vec3) == 3 * sizeof(float) && sizeof(glm::uvec3) == 3 * sizeof(uint32_t),
              "Embree's buffer layout");

namespace {

constexpr uint32_t bit(Layer layer) { return static_cast<uint32_t>(layer); }
constexpr uint32_t kAllLayers = ~0u, kOpaque = bit(Layer::surface) | bit(Layer::dividing_surface);
using ShapeData = std::variant<MeshShape, SphereShape, DiscShape>;

Box bounds_of(const SphereShape& s) { return {s.centre - s.radius, s.centre + s.radius}; }
Box bounds_of(const DiscShape& d) { return disc_bounds(d); }

/// Embree's callbacks for a shape of our own.
template <class S>
void own_bounds(const RTCBoundsFunctionArguments* args) {
  const auto& s = *static_cast<const S*>(args->geometryUserPtr);
  const Box box = bounds_of(s);
  const Vec3 margin = 0x1p-22f * (glm::abs(s.centre) + s.radius);  // rounding must not cut the shape
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

std::span<const Hit> hits_of(const Encounter& met) { return {met.hits.data(), static_cast<size_t>(met.count)}; }

/// How far along the ray others may coincide with a hit, m: as far as leave_surface() takes the ray past it, and the
/// rounding of distances.
float coincidence(const Hit& hit, const Vec3& direction) {
  const float skipped = glm::distance(leave_surface(hit, direction), hit.position);
  return skipped / std::max(1e-6f, std::abs(glm::dot(hit.normal, direction))) + 0x1p-20f * hit.t;
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

}  // namespace

struct Geometry::Impl {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::deque<ShapeData> shapes;  // a deque, because Embree keeps pointers to its elements
  std::vector<double> areas;     // m^2
  std::vector<Box> bounds;
  std::vector<Layer> layers;
  float size = 0.0f;                        // m: of the box around all shapes, and its distance from the origin
  FewTriangles few;                         // all, if the scene is small
  std::vector<uint32_t> spheres_and_discs;  // likewise
  bool is_small = false;                    // all shapes are looked at for each ray
  bool committed = false;
  std::atomic<int64_t> bytes{0};
  std::string error;

  Impl() : device(rtcNewDevice(nullptr)) {
    if (!device) throw std::runtime_error("Embree: no device, error " + std::to_string(rtcGetDeviceError(nullptr)));
    rtcSetDeviceErrorFunction(device, on_error, this);
    rtcSetDeviceMemoryMonitorFunction(device, on_memory, this);
    scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | kEmbreeFilters));
    check();
  }
  ~Impl() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  /// Embree calls this from C code, through which no exception may pass: check() throws later.
  static void on_error(void* self, RTCError code, const char* message) {
    static_cast<Impl*>(self)->error =
        "Embree: " + std::string(message ? message : "") + ", error " + std::to_string(code);
  }
  static bool on_memory(void* self, ssize_t change, bool) {
    static_cast<Impl*>(self)->bytes += change;
    return true;
  }
  void check() const {
    if (!error.empty()) throw std::runtime_error(error);
  }

  /// How far beyond a hit one that coincides with it is looked for, m.
  float margin() const { return 0x1p-18f * size; }

  void lay_out();
  void look_at_all(Query& query, uint32_t layers_seen) const;
  void look_along(Query& query, uint32_t layers_seen) const;  // by Embree's tree
  template <class S>
  uint32_t add_own(const S& shape, double area, Layer layer);
  uint32_t attach(RTCGeometry geometry, double area, const Box& box, Layer layer) {
    const auto number = static_cast<uint32_t>(areas.size());
    layers.push_back(layer);
    size = std::max(size, glm::length(box.lo) + glm::length(box.hi));
    rtcSetGeometryMask(geometry, bit(layer));
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, number);
    rtcReleaseGeometry(geometry);
    check();
    areas.push_back(area);
    bounds.push_back(box);
    return number;
  }
};

Geometry::Geometry() : impl_(std::make_unique<Impl>()) {}
Geometry::~Geometry() = default;
Geometry::Geometry(Geometry&&) noexcept = default;
Geometry& Geometry::operator=(Geometry&&) noexcept = default;

uint32_t Geometry::add(const TriangleMesh& mesh, Layer layer) {
  assert(!impl_->committed);
  const std::vector<glm::uvec3> proper = checked_triangles(mesh);
  RTCGeometry geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* positions = static_cast<Vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               sizeof(Vec3), mesh.positions.size()));
  auto* triangles = static_cast<glm::uvec3*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), proper.size()));
  impl_->check();
  std::copy(mesh.positions.begin(), mesh.positions.end(), positions);
  std::copy(proper.begin(), proper.end(), triangles);
  double area = 0.0;
  Box box;
  MeshShape shape{positions, triangles, {}, mesh.normals, mesh.uvs};
  shape.planes.reserve(proper.size());
  for (const glm::uvec3& v : proper) {
    const Vec3d across = area_vector(positions[v.x], positions[v.y], positions[v.z]);
    const double twice_area = glm::length(across);
    const Vec3d normal = across / twice_area;
    shape.planes.push_back({normal, glm::dot(normal, Vec3d(positions[v.x]))});
    area += 0.5 * twice_area;
    for (int corner = 0; corner < 3; ++corner) box.add(positions[v[corner]]);
  }
  for (Vec3& normal : shape.normals) normal = Vec3(glm::normalize(Vec3d(normal)));
  impl_->bytes += static_cast<int64_t>(shape.planes.size() * sizeof(TrianglePlane) +
                                       shape.normals.size() * sizeof(Vec3) + shape.uvs.size() * sizeof(Vec2));
  impl_->shapes.emplace_back(std::move(shape));
  rtcSetGeometryUserData(geometry, &std::get<MeshShape>(impl_->shapes.back()));
  return impl_->attach(geometry, area, box, layer);
}

template <class S>
uint32_t Geometry::Impl::add_own(const S& shape, double area, Layer layer) {
  assert(!committed);
  shapes.emplace_back(shape);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, 1);
  rtcSetGeometryUserData(geometry, &std::get<S>(shapes.back()));
  rtcSetGeometryBoundsFunction(geometry, own_bounds<S>, nullptr);
  rtcSetGeometryIntersectFunction(geometry, own_intersect<S>);
  return attach(geometry, area, bounds_of(shape), layer);
}

uint32_t Geometry::add(const SphereShape& sphere, Layer layer) {
  check_round("sphere", sphere.centre, sphere.radius);
  return impl_->add_own(sphere, 4.0 * kPiD * double{sphere.radius} * sphere.radius, layer);
}

uint32_t Geometry::add(const DiscShape& disc, Layer layer) {
  check_round("disc", disc.centre, disc.radius);
  assert(std::abs(glm::length(disc.normal) - 1.0f) < 1e-5f);
  return impl_->add_own(disc, kPiD * double{disc.radius} * disc.radius, layer);
}

/// Decides how rays are to look for shapes.
void Geometry::Impl::lay_out() {
  constexpr size_t kTrianglesForOne = 8;  // a sphere or disc takes as long
  size_t all = 0;
  for (uint32_t shape = 0; shape < shapes.size(); ++shape) {
    const auto* mesh = std::get_if<MeshShape>(&shapes[shape]);
    all += mesh ? mesh->planes.size() : kTrianglesForOne;
  }
  is_small = all <= FewTriangles::kMost;
  if (!is_small) return;
  for (uint32_t shape = 0; shape < shapes.size(); ++shape) {
    if (const auto* mesh = std::get_if<MeshShape>(&shapes[shape]))
      few.add(*mesh, shape, bit(layers[shape]));
    else
      spheres_and_discs.push_back(shape);
  }
  bytes += static_cast<int64_t>(few.memory_bytes());
}

void Geometry::Impl::look_at_all(Query& query, uint32_t layers_seen) const {
  few.visit(query.ray, layers_seen, [&](const MeshShape& mesh, uint32_t shape, uint32_t triangle) {
    if (!query.leaves_out(shape)) query.take(crossing(mesh, triangle, query.ray), shape, triangle);
  });
  for (const uint32_t shape : spheres_and_discs) {
    if ((bit(layers[shape]) & layers_seen) == 0 || query.leaves_out(shape)) continue;
    if (const auto* sphere = std::get_if<SphereShape>(&shapes[shape]))
      query.take(crossing(*sphere, query.ray), shape, 0);
    if (const auto* disc = std::get_if<DiscShape>(&shapes[shape])) query.take(crossing(*disc, query.ray), shape, 0);
  }
}

void Geometry::Impl::look_along(Query& query, uint32_t layers_seen) const {
  RTCRayHit found{};
  found.ray.org_x = query.ray.origin.x;
  found.ray.org_y = query.ray.origin.y;
  found.ray.org_z = query.ray.origin.z;
  found.ray.dir_x = query.ray.direction.x;
  found.ray.dir_y = query.ray.direction.y;
  found.ray.dir_z = query.ray.direction.z;
  found.ray.tnear = kMinT;
  found.ray.tfar = query.limit;
  found.ray.mask = layers_seen;
  found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  EmbreeQuery context(query);
  embree_intersect(scene, context, meet_triangle, found);
}

void Geometry::commit() {
  rtcCommitScene(impl_->scene);
  impl_->check();
  impl_->lay_out();
  impl_->committed = true;
}

std::optional<Hit> Geometry::intersect(const Ray& ray, float t_max) const {
  return first(ray, t_max, kAllLayers, {}).hit;
}

std::optional<Hit> Geometry::intersect_surface(const Ray& ray, float t_max) const {
  return first(ray, t_max, kAllLayers & ~bit(Layer::boundary), {}).hit;
}

bool Geometry::is_near(const Vec3& point, float radius) const {
  assert(impl_->committed && is_finite(point));
  RTCPointQuery query{point.x, point.y, point.z, 0.0f, radius};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  Search search{impl_->shapes, point, radius};
  rtcPointQuery(impl_->scene, &query, &context, is_within_reach, &search);
  return search.found;
}

Encounter Geometry::encounter(const Ray& ray, float t_max) const {
  Encounter found;
  // Another shape may be found behind by its own rounding: the search reaches further than the hits so far do.
  const float margin = impl_->margin();
  float beyond = kInfinity;
  for (First next = first(ray, t_max, kAllLayers, {}); next.hit;
       next = first(ray, std::min(t_max, beyond + margin), kAllLayers, hits_of(found))) {
    const Hit& hit = *next.hit;
    if (found.count > 0 && hit.t - coincidence(hit, ray.direction) > beyond) break;
    found.hits[found.count++] = hit;
    if (impl_->layers[hit.shape] != Layer::boundary) {
      if (const std::optional<Hit> behind = in_contact(ray, t_max, next)) found.hits[found.count - 1] = *behind;
      found.surface = true;
      std::swap(found.hits[0], found.hits[found.count - 1]);
      break;
    }
    const float reach = hit.t + coincidence(hit, ray.direction);
    beyond = found.count == 1 ? reach : std::max(beyond, reach);
    if (found.count == Encounter::kMost || next.others > beyond + margin) break;
  }
  return found;
}

/// The opaque surface that coincides with a dielectric; nothing where there is none, or where the hit is of another
/// kind.
std::optional<Hit> Geometry::in_contact(const Ray& ray, float t_max, const First& dielectric) const {
  if ((bit(impl_->layers[dielectric.hit->shape]) & kOpaque) != 0) return std::nullopt;
  const float reach = dielectric.hit->t + coincidence(*dielectric.hit, ray.direction);
  const float margin = impl_->margin();
  if (dielectric.others > reach + margin) return std::nullopt;
  const std::optional<Hit> hit = first(ray, std::min(t_max, reach + margin), kOpaque, {}).hit;
  return hit && hit->t - coincidence(*hit, ray.direction) <= reach ? hit : std::nullopt;
}

Encounter Geometry::division(const Ray& ray) const {
  constexpr uint32_t kBetweenMedia = bit(Layer::dividing_surface) | bit(Layer::interface) | bit(Layer::boundary);
  return faces(ray, kBetweenMedia);
}

Encounter Geometry::faces(const Ray& ray) const { return faces(ray, kAllLayers); }

Encounter Geometry::faces(const Ray& ray, uint32_t layers) const {
  Encounter found;
  float beyond = kInfinity;
  while (found.count < Encounter::kMost) {
    const First next = first(ray, beyond, layers, hits_of(found));
    if (!next.hit) break;
    const float reach = next.hit->t + coincidence(*next.hit, ray.direction);
    beyond = found ? std::max(beyond, reach) : reach;
    found.hits[found.count++] = *next.hit;
    if (next.others > beyond) break;
  }
  return found;
}

Geometry::First Geometry::first(const Ray& ray, float t_max, uint32_t layers, std::span<const Hit> without) const {
  assert(impl_->committed);
  assert(is_finite(ray.origin) && is_finite(ray.direction));
  if (!(t_max > kMinT)) return {};
  Query query(ray, t_max, impl_->size, without);
  if (impl_->is_small)
    impl_->look_at_all(query, layers);
  else
    impl_->look_along(query, layers);
  First met;
  met.others = std::min(query.others, query.limit);
  if (std::isinf(query.t)) return met;
  Hit& hit = met.hit.emplace();
  hit.t = query.t;
  hit.shape = query.shape;
  const ShapeData& shape = impl_->shapes[hit.shape];
  if (const auto* mesh = std::get_if<MeshShape>(&shape)) locate(*mesh, query.triangle, ray, query.nearest, hit);
  if (const auto* sphere = std::get_if<SphereShape>(&shape)) locate(*sphere, ray, query.nearest, hit);
  if (const auto* disc = std::get_if<DiscShape>(&shape)) locate(*disc, ray, query.nearest, hit);
  return met;
}

Box Geometry::bounds() const {
  Box all;
  for (const Box& box : impl_->bounds) all.add(box);
  return all;
}

const Box& Geometry::bounds(uint32_t shape) const { return impl_->bounds[shape]; }

Vec2 Geometry::uv(const Hit& hit) const {
  assert(has_uvs(hit.shape));
  const auto* mesh = std::get_if<MeshShape>(&impl_->shapes[hit.shape]);
  return mesh ? interpolated(mesh->uvs, mesh->triangles[hit.triangle], hit.barycentric) : sphere_uv(hit.normal);
}

bool Geometry::has_uvs(uint32_t shape) const {
  const auto* mesh = std::get_if<MeshShape>(&impl_->shapes[shape]);
  return mesh ? !mesh->uvs.empty() : std::holds_alternative<SphereShape>(impl_->shapes[shape]);
}

std::optional<SphereShape> Geometry::sphere(uint32_t shape) const {
  const auto* sphere = std::get_if<SphereShape>(&impl_->shapes[shape]);
  return sphere ? std::optional(*sphere) : std::nullopt;
}

size_t Geometry::triangle_count(uint32_t shape) const {
  const auto* mesh = std::get_if<MeshShape>(&impl_->shapes[shape]);
  return mesh ? mesh->planes.size() : 0;
}

Hit Geometry::point_of_triangle(uint32_t shape, uint32_t triangle, const Vec2& barycentric) const {
  assert(triangle < triangle_count(shape));
  Hit hit;
  hit.shape = shape;
  locate(std::get<MeshShape>(impl_->shapes[shape]), triangle, barycentric, hit);
  return hit;
}

double Geometry::area(uint32_t shape) const {
  assert(shape < impl_->areas.size());
  return impl_->areas[shape];
}

size_t Geometry::memory_bytes() const { return static_cast<size_t>(impl_->bytes.load()); }

}  // namespace vpm
