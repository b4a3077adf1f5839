// Faces of several shapes in one place: which of them a ray meets there, whichever rounding finds first.
#include <algorithm>
#include <span>

#include "vpm/surface/geometry_impl.h"

namespace vpm {
namespace {

constexpr uint32_t kOpaque = bit(Layer::surface) | bit(Layer::dividing_surface);

std::span<const Hit> hits_of(const Encounter& met) { return {met.hits.data(), static_cast<size_t>(met.count)}; }

/// How far along the ray others may coincide with a hit, m: as far as leave_surface() takes the ray past it, and the
/// rounding of distances.
float coincidence(const Hit& hit, const Vec3& direction) {
  const float skipped = glm::distance(leave_surface(hit, direction), hit.position);
  return skipped / std::max(1e-6f, std::abs(glm::dot(hit.normal, direction))) + 0x1p-20f * hit.t;
}

}  // namespace

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

}  // namespace vpm
