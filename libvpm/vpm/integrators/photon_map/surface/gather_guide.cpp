// Filling and drawing from the histogram.
#include "vpm/integrators/photon_map/surface/gather_guide.h"

#include <algorithm>
#include <numeric>

#include "vpm/base/warp.h"
#include "vpm/estimate/surface_estimate.h"
#include "vpm/surface/incidence.h"

namespace vpm {
namespace {

constexpr float kMostByPhotons = 0.5f;  // of the rays, however many photons are near
constexpr float kFewPhotons = 16.0f;    // so many are worth half of that share

}  // namespace

GatherGuide::GatherGuide(const SurfaceView& view, const PhotonMap& from_rough, GatherWork work) : view_(view) {
  const Hit& hit = view.hit;
  const float side = glm::dot(hit.normal, view.travel) < 0.0f ? 1.0f : -1.0f;
  normals_ = {side * hit.shading_normal, -side * hit.shading_normal};
  const Arrives arrives{side * hit.normal, plane_thickness(from_rough.settings), scatters_through(view.material)};
  const auto& map = std::get<NearestMap>(from_rough.index);
  const Neighbours& near = nearest(Gathering{map, from_rough.settings, work}, hit.position, arrives);
  work.counters.used += near.size();
  for (size_t i = 0; i < near.size(); ++i) {
    const PhotonTable::Payload& photon = map.photons().payload(near.photons()[i]);
    const Vec3 travel = photon.travel.unpack();
    const Rgb scattered = scatter_value(view.material, hit, travel, -view.travel).value;
    up_to_[cell_of(-travel)] += glm::dot(Rgbd(scattered), Rgbd(photon.power.unpack()));
  }
  std::partial_sum(up_to_.begin(), up_to_.end(), up_to_.begin());
  const auto count = static_cast<float>(near.size());
  if (up_to_.back() > 0.0) share_ = kMostByPhotons * count / (count + kFewPhotons);
}

Scatter GatherGuide::sample(Rng& rng) const {
  return share_ > 0.0f && rng.uniform() < share_ ? sample_by_photons(rng) : sample_by_material(rng);
}

Scatter GatherGuide::sample_by_material(Rng& rng) const {
  const float choice = rng.uniform();
  Scatter scatter = sample_scatter(view_.material, view_.hit, view_.travel, choice, rng.uniform2());
  if (share_ == 0.0f || is_black(scatter.weight)) return scatter;
  const float mixed = density(scatter.direction, scatter.pdf);
  scatter.weight *= scatter.pdf / mixed;
  scatter.pdf = mixed;
  return scatter;
}

Scatter GatherGuide::sample_by_photons(Rng& rng) const {
  const auto drawn = std::upper_bound(up_to_.begin(), up_to_.end(), rng.uniform() * up_to_.back());
  const auto cell = static_cast<int>(drawn - up_to_.begin());
  const int side = cell / kOfSide, ring = cell % kOfSide / kSectors, sector = cell % kSectors;
  const Vec2 u = (Vec2(ring, sector) + rng.uniform2()) / Vec2(kRings, kSectors);
  const Vec3 direction = on_side(cosine_hemisphere(normals_[side], u), normals_[side]);
  const ScatterValue scattered = scatter_value(view_.material, view_.hit, view_.travel, direction);
  if (is_black(scattered.value)) return {direction};
  const float mixed = density(direction, scattered.pdf);
  return {direction, scattered.value / mixed, side == 1, scattered.radiance_scale, mixed};
}

int GatherGuide::cell_of(const Vec3& direction) const {
  const int side = glm::dot(direction, normals_[0]) < 0.0f ? 1 : 0;
  Vec3 s, t;
  make_frame(normals_[side], s, t);
  const Vec2 disc(glm::dot(direction, s), glm::dot(direction, t));  // as cosine_hemisphere() maps it
  const float turns = turns_of(disc.y, disc.x);
  const int ring = std::min(kRings - 1, static_cast<int>(glm::dot(disc, disc) * kRings));
  const int sector = std::min(kSectors - 1, static_cast<int>((turns - std::floor(turns)) * kSectors));
  return (side * kRings + ring) * kSectors + sector;
}

float GatherGuide::density(const Vec3& direction, float of_material) const {
  const int cell = cell_of(direction);
  const double added = up_to_[cell] - (cell > 0 ? up_to_[cell - 1] : 0.0);
  const float cosine = std::abs(glm::dot(direction, normals_[0]));
  const float of_photons = static_cast<float>(added / up_to_.back()) * kOfSide * cosine / kPi;
  return (1.0f - share_) * of_material + share_ * of_photons;
}

}  // namespace vpm
