// Rays from a point of a medium to what borders it.
#include "estimate/volume_region.h"

#include <array>

#include "estimate/lost_along.h"

namespace vpm {
namespace {

constexpr int kPairs = 64;  // of opposite directions, so that half of a ball is a half exactly

/// A spiral of equal areas over half the sphere, turned so that each octant has the same number of directions: corners
/// of boxes across the axes are an eighth exactly. The other half are the opposite directions.
std::array<Vec3, kPairs> half_sphere() {
  const double golden = kPiD * (3.0 - std::sqrt(5.0));  // rad, from one direction to the next
  constexpr double kTurn = 0.98;                        // rad
  std::array<Vec3, kPairs> directions;
  for (int i = 0; i < kPairs; ++i) {
    const double z = (i + 0.5) / kPairs, r = std::sqrt(1.0 - z * z), phi = golden * i + kTurn;
    directions[i] = Vec3(r * std::cos(phi), r * std::sin(phi), z);
  }
  return directions;
}
const std::array<Vec3, kPairs> kDirections = half_sphere();

}  // namespace

RegionShare VolumeRegion::share(float radius) const {
  const bool filled = is_filled(radius);
  if (filled && !scene_.geometry.is_near(point_, radius)) return {};
  const Medium& medium = scene_.media[medium_];
  const auto within = [&](float t) { return kernel_within_3d(kernel_, double{t} / radius); };
  double lost = 0.0;
  bool others = false;
  for (int i = 0; i < 2 * kPairs; ++i) {
    const Vec3 direction = i < kPairs ? kDirections[i] : -kDirections[i - kPairs];
    const Ray ray{point_, direction};
    const std::optional<Hit> border = scene_.geometry.intersect(ray, radius);
    const float reach = border ? border->t : radius;
    if (border) lost += 1.0 - within(reach);
    if (!filled) lost += lost_along(reach, within, [&](float t) { return medium.density(ray.at(t)) > 0.0f; });
    others = others || (border && comes_again(*border, direction, radius - reach));
  }
  return {1.0 - lost / (2.0 * kPairs), others};
}

bool VolumeRegion::holds(const Vec3& offset) const {
  const float distance = glm::length(offset);
  return distance == 0.0f || !scene_.geometry.intersect({point_, offset / distance}, distance);
}

/// Is the density positive all over the ball?
bool VolumeRegion::is_filled(float radius) const {
  const Medium& medium = scene_.media[medium_];
  return medium.homogeneous() || medium.grid->is_positive({point_ - radius, point_ + radius});
}

/// May the medium come again behind its border, within `rest` (m)?
bool VolumeRegion::comes_again(const Hit& border, const Vec3& direction, float rest) const {
  return medium_beyond(scene_.shapes[border.shape], border.normal, direction, medium_) == medium_ ||
         scene_.geometry.intersect({leave_surface(border, direction), direction}, rest);
}

}  // namespace vpm
