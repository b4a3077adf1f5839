// Rays along a surface and down to it.
#include "vpm/estimate/surface_region.h"

#include <array>

#include "vpm/estimate/region_share.h"

namespace vpm {
namespace {

/// How high above the surface it is looked along, of the distance. Twice what a surface bends away at the middle of the
/// way where its radius of curvature is twice the distance, or half as much again.
constexpr float kLift = 0.1f;
/// The least cosine between normals of places of one region.
constexpr float kFacing = 0.7071f;
/// How far off a surface, of its distance from the point, photons are still taken for the surface's own: far less than
/// the lift, and more than rounding.
constexpr float kOwn = 1e-3f;
/// The most surfaces looked at, one below the other: more within reach of the plane hide those below them.
constexpr int kLayers = 4;

constexpr int kSpokes = 32, kFirstSpokes = 8;

/// Unit vectors around a circle, the first kFirstSpokes of them evenly, too.
std::array<Vec2, kSpokes> circle() {
  std::array<Vec2, kSpokes> spokes;
  constexpr int kBetween = kSpokes / kFirstSpokes;
  for (int i = 0; i < kSpokes; ++i) {
    const double phi = 2.0 * kPiD * ((i % kFirstSpokes) * kBetween + i / kFirstSpokes + 0.5) / kSpokes;
    spokes[i] = Vec2(std::cos(phi), std::sin(phi));
  }
  return spokes;
}
const std::array<Vec2, kSpokes> kSpoke = circle();

}  // namespace

SurfaceRegion::SurfaceRegion(const Scene& scene, const Hit& hit, const Vec3& towards, const GatherSettings& gather)
    : scene_(scene), point_(hit.position), kernel_(gather.kernel) {
  near_ = {glm::dot(hit.normal, towards) > 0.0f ? hit.normal : -hit.normal, plane_thickness(gather)};
  start_ = leave_surface(hit, near_.normal);
  if (const std::optional<Hit> above = scene.geometry.intersect_surface({start_, near_.normal}, kInfinity))
    free_ = above->t;
}

/// How high above the surface it is looked along to places so far off, m.
float SurfaceRegion::lift(float distance) const { return std::min(kLift * distance, 0.5f * free_); }

RegionShare SurfaceRegion::share(float radius) const {
  Vec3 s, t;
  make_frame(near_.normal, s, t);
  const auto within = [&](float way) { return kernel_within(kernel_, 2, double{way} / radius); };
  KernelPair<double> lost;
  for (int i = 0; i < kSpokes; ++i) {
    const Vec3 direction = kSpoke[i].x * s + kSpoke[i].y * t;
    lost += lost_along(radius, within, [&](float way) { return covers(way * direction); });
    if (i + 1 == kFirstSpokes && lost.value == 0.0) return {};
  }
  return {1.0 - lost.value / kSpokes, true, -lost.correction / kSpokes};
}

/// Does a place of a surface at this offset, or a photon there, belong to the region? Looks down to it, and along the
/// surface to it.
bool SurfaceRegion::holds(const Vec3& offset) const {
  const float distance = glm::length(offset), up = lift(distance);
  if (distance == 0.0f) return true;
  const Ray down{point_ + offset + up * near_.normal, -near_.normal};
  const std::optional<Hit> hit = scene_.geometry.intersect_surface(down, 2.0f * up);
  if (!hit || !counts(*hit)) return false;
  const float rounding = glm::distance(leave_surface(*hit, near_.normal), hit->position);
  return std::abs(hit->t - up) <= kOwn * distance + rounding && sees(offset);
}

/// Has the region a place over or under that point of the plane? Surfaces there are asked as photons on them are.
bool SurfaceRegion::covers(const Vec3& across) const {
  // No place near the plane lies farther off it.
  const float reach = (near_.thickness + kSlope * glm::length(across)) / (1.0f - kSlope);
  Ray down{point_ + across + reach * near_.normal, -near_.normal};
  float left = 2.0f * reach;
  for (int layer = 0; layer < kLayers; ++layer) {
    const std::optional<Hit> hit = scene_.geometry.intersect_surface(down, left);
    if (!hit) return false;
    const Vec3 offset = hit->position - point_;
    if (near_.near_plane(offset) && holds(offset)) return true;
    left -= hit->t;
    down.origin = leave_surface(*hit, down.direction);
  }
  return false;
}

/// Does nothing stand between the point and the place, as seen along the surface?
bool SurfaceRegion::sees(const Vec3& offset) const {
  const Vec3 up = lift(glm::length(offset)) * near_.normal;
  const Vec3 way = point_ + offset + up - (start_ + up);
  const float distance = glm::length(way);
  return !(distance > 0.0f) || !scene_.geometry.intersect_surface({start_ + up, way / distance}, distance);
}

/// Does the surface there store photons, and face the way the point's does?
bool SurfaceRegion::counts(const Hit& hit) const {
  return std::abs(glm::dot(hit.normal, near_.normal)) >= kFacing && is_rough(scene_.material_of(hit));
}

}  // namespace vpm
