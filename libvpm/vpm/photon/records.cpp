// What is kept of collisions and of hits.
#include "vpm/photon/records.h"

#include <algorithm>

#include "vpm/base/counters.h"

namespace vpm {
namespace {

Photon as_photon(const ArrivingPhoton& arriving, const Rgb& power) {
  return {arriving.state.ray.origin, PackedDirection(arriving.state.ray.direction), power};
}

PhotonHistory history_of(const ArrivingPhoton& arriving, uint32_t place) {
  return {arriving.number, place, arriving.scatterings, arriving.reflections};
}

}  // namespace

PhotonFilter caustic_photons(bool direct, bool specular) {
  return PhotonFilter([&](bool is_direct, bool is_specular, bool from_rough) {
    if (from_rough) return false;
    return is_direct ? direct : !is_specular || specular;
  });
}

CollisionRecorder::CollisionRecorder(const Scene& scene, VolumeForm form, const ThinParts& thin, PhotonFilter filter)
    : photons(scene.media.size()),
      histories(scene.media.size()),
      scene_(scene),
      form_(form),
      thin_(thin),
      filter_(filter),
      fills_(form == VolumeForm::density_at_query && thin.density_floor > 0.0f &&
             std::any_of(scene.media.begin(), scene.media.end(),
                         [](const Medium& medium) { return medium.grid && medium.scatters(); })) {}

std::unique_ptr<PhotonRecorder> CollisionRecorder::part() const {
  auto part = std::make_unique<CollisionRecorder>(scene_, form_, thin_, filter_);
  part->keeps_histories_ = keeps_histories_;
  return part;
}

void CollisionRecorder::join(PhotonRecorder& part) {
  auto& other = static_cast<CollisionRecorder&>(part);
  for (size_t m = 0; m < photons.size(); ++m) {
    join_lists(photons[m], other.photons[m]);
    join_lists(histories[m], other.histories[m]);
  }
  floored += other.floored;
}

size_t CollisionRecorder::stored() const {
  size_t all = 0;
  for (const std::vector<Photon>& map : photons) all += map.size();
  return all;
}

void CollisionRecorder::flew(const Track& track, const ArrivingPhoton& photon, Rng& rng) {
  if (!filter_(photon)) return;
  const Medium& medium = scene_.media[track.medium];
  visit_thin_places(medium, track, thin_, rng, [&](double t) {
    const double integral =
        is_grey(medium.sigma_t) ? 0.0 : density_integral(medium, track.ray, {0.0f, static_cast<float>(t)}).value;
    count(floored);
    photons[track.medium].push_back({track.ray.at(static_cast<float>(t)), PackedDirection(track.ray.direction),
                                     power_along(medium, track, integral, thin_)});
    if (!keeps_histories_) return;
    PhotonHistory& history = histories[track.medium].emplace_back(history_of(photon, uint32_t(track.medium)));
    history.density = floor_in(medium, thin_.density_floor);
    history.along_flight = true;
  });
}

void CollisionRecorder::collided(const ArrivingPhoton& photon) {
  const Medium& medium = scene_.media[photon.state.medium];
  if (!medium.scatters() || !filter_(photon)) return;
  const float density = relative_density(medium, photon.event.density);
  const float floor = floor_in(medium, thin_.density_floor);
  if (form_ == VolumeForm::density_at_query && density < floor) count(floored);
  photons[photon.state.medium].push_back(
      as_photon(photon, stored_power(photon.state.throughput, form_, density, floor)));
  if (!keeps_histories_) return;
  PhotonHistory& history =
      histories[photon.state.medium].emplace_back(history_of(photon, uint32_t(photon.state.medium)));
  if (form_ == VolumeForm::density_at_query) history.density = std::max(density, floor);
}

HitRecorder::HitRecorder(const Scene& scene, PhotonFilter filter, HitUse use)
    : scene_(scene), filter_(filter), use_(use) {}

std::unique_ptr<PhotonRecorder> HitRecorder::part() const {
  auto part = std::make_unique<HitRecorder>(scene_, filter_, use_);
  part->keeps_histories_ = keeps_histories_;
  return part;
}

void HitRecorder::join(PhotonRecorder& part) {
  auto& other = static_cast<HitRecorder&>(part);
  join_lists(photons, other.photons);
  join_lists(histories, other.histories);
  emitted_count += other.emitted_count;
}

void HitRecorder::hit(const ArrivingPhoton& photon) {
  if (leaves_out(photon.number) || !is_rough(scene_.material_of(photon.event.hit)) || !filter_(photon)) return;
  photons.push_back(as_photon(photon, photon.state.throughput));
  if (keeps_histories_) histories.push_back(history_of(photon, photon.event.hit.shape));
}

void CachePointRecorder::join(PhotonRecorder& part) {
  join_lists(points, static_cast<CachePointRecorder&>(part).points);
}

void CachePointRecorder::hit(const ArrivingPhoton& photon) {
  const Hit& hit = photon.event.hit;
  const Material& material = scene_.material_of(hit);
  if (!finds_cache_points(photon.number) || !is_diffuse(material) || !is_rough(material))
    return;  // black ones are not rough
  const float side = glm::dot(hit.normal, photon.state.ray.direction) < 0.0f ? 1.0f : -1.0f;
  points.push_back({hit.position, PackedDirection(side * hit.normal), PackedDirection(side * hit.shading_normal)});
}

PhotonLists list_photons(const Scene& scene, const DistanceStrategy& strategy, const ListSettings& settings) {
  const auto keeps = [](bool direct) { return direct ? any_photon : indirect_photon; };
  CollisionRecorder collisions(scene, settings.volume_form, {settings.density_floor, true},
                               keeps(settings.direct_collisions));
  HitRecorder hits(scene, keeps(settings.direct_hits), HitUse::surface_map);
  Progress silent("photons", 0, false);
  PhotonLists lists;
  lists.ledger = trace_photons(scene, strategy, settings, {&collisions, &hits}, silent);
  count(lists.ledger.floored, collisions.floored);
  lists.volume = std::move(collisions.photons);
  lists.surface = std::move(hits.photons);
  return lists;
}

}  // namespace vpm
