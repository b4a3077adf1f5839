// Rays from a point of a medium to what borders it.
#include "vpm/estimate/volume_region.h"

#include <vector>

#include "vpm/estimate/region_share.h"

namespace vpm {
namespace {

/// A spiral of equal areas over half the sphere, turned (by rad) so that each octant has the same number of directions:
/// corners of boxes across the axes are an eighth exactly. The other half are the opposite directions, so that half of
/// a ball is a half exactly.
std::vector<Vec3> half_sphere(int count, double turn) {
  const double golden = kPiD * (3.0 - std::sqrt(5.0));  // rad, from one direction to the next
  std::vector<Vec3> directions;
  for (int i = 0; i < count; ++i) {
    const double z = (i + 0.5) / count, r = std::sqrt(1.0 - z * z), phi = golden * i + turn;
    directions.emplace_back(r * std::cos(phi), r * std::sin(phi), z);
  }
  return directions;
}
const std::vector<Vec3> kDirections = half_sphere(64, 0.98), kManyDirections = half_sphere(256, 0.68);

constexpr double kNarrow = 0.6;  // shares below this are found by many directions: what they are off counts for more

}  // namespace

RegionShare VolumeRegion::share(float radius) const {
  const bool filled = is_filled(radius);
  if (filled && !scene_.geometry.is_near(point_, radius)) return {};
  const RegionShare share = share_along(kDirections, radius, filled);
  return share.inside < kNarrow ? share_along(kManyDirections, radius, filled) : share;
}

RegionShare VolumeRegion::share_along(const std::vector<Vec3>& half_sphere, float radius, bool filled) const {
  const Medium& medium = scene_.media[medium_];
  const auto within = [&](float t) { return kernel_within(kernel_, 3, double{t} / radius); };
  KernelPair<double> lost;
  bool others = false;
  for (const Vec3& half : half_sphere)
    for (const Vec3& direction : {half, -half}) {
      const Ray ray{point_, direction};
      const std::optional<Hit> border = scene_.geometry.intersect(ray, radius);
      const float reach = border ? border->t : radius;
      if (border) lost += KernelPair<double>(1.0) - within(reach);
      if (!filled) lost += lost_along(reach, within, [&](float t) { return medium.density(ray.at(t)) > 0.0f; });
      others = others || (border && comes_again(*border, direction, radius - reach));
    }
  const double lines = 2.0 * static_cast<double>(half_sphere.size());
  return {1.0 - lost.value / lines, others, -lost.correction / lines};
}

bool VolumeRegion::holds(const Vec3& offset) const {
  const float distance = glm::length(offset);
  return distance == 0.0f || !scene_.geometry.intersect({point_, offset / distance}, distance);
}

/// Is all of the ball that lies in the medium of the region?
bool VolumeRegion::is_filled(float radius) const {
  const Medium& medium = scene_.media[medium_];
  return form_ == VolumeForm::density_at_photon || medium.homogeneous() ||
         medium.grid->is_positive({point_ - radius, point_ + radius});
}

/// May the medium come again behind its border, within `rest` (m)?
bool VolumeRegion::comes_again(const Hit& border, const Vec3& direction, float rest) const {
  return medium_beyond(scene_.shapes[border.shape], border.normal, direction, medium_) == medium_ ||
         scene_.geometry.intersect({leave_surface(border, direction), direction}, rest);
}

}  // namespace vpm
