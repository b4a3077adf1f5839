// Recorders of photons at collisions and on non-specular surfaces. And the photons of a pass as plain lists: for
// studies of photons, and for comparing photon maps with brute force.
#pragma once

#include <concepts>
#include <cstdint>

#include "vpm/photon/photon.h"
#include "vpm/photon/recorder.h"
#include "vpm/photon/thin_places.h"
#include "vpm/photon/trace.h"

namespace vpm {

/// Which of the arriving photons a recorder keeps, decided by where they come from: one bit for each of the sixteen
/// cases.
class PhotonFilter {
 public:
  /// Keeps the photons for which keeps(direct, specular, from_rough) is true; see ArrivingPhoton.
  template <std::predicate<bool, bool, bool> Keeps>
  constexpr explicit PhotonFilter(Keeps&& keeps) {
    for (uint32_t answer = 0; answer < 8; ++answer)
      kept_ |= static_cast<uint32_t>(keeps((answer & 1) != 0, (answer & 2) != 0, (answer & 4) != 0)) * 0x101u << answer;
  }
  /// Of these, the photons whose flight did not begin at a collision (Turn).
  constexpr PhotonFilter straight() const {
    PhotonFilter filter = *this;
    filter.kept_ &= 0xffu;
    return filter;
  }
  bool operator()(const ArrivingPhoton& photon) const {
    const uint32_t answer = uint32_t{photon.direct()} | uint32_t{photon.specular()} << 1 |
                            uint32_t{photon.from_rough} << 2 | (photon.turn ? 8u : 0u);
    return (kept_ >> answer & 1) != 0;
  }

 private:
  uint32_t kept_ = 0;
};

/// `any_photon` keeps every photon; `indirect_photon` keeps those that have been scattered, reflected or refracted.
inline constexpr PhotonFilter any_photon([](bool, bool, bool) { return true; });
inline constexpr PhotonFilter indirect_photon([](bool direct, bool, bool) { return !direct; });
/// Keeps photons whose last non-specular scattering was at a surface (ArrivingPhoton::from_rough).
inline constexpr PhotonFilter photon_from_rough([](bool, bool, bool from_rough) { return from_rough; });
/// Keeps photons that are not `from_rough`. Photons straight from lights are kept only if `direct`. Photons that
/// mirrors and smooth glass, but nothing else, have scattered are kept only if `specular`.
PhotonFilter caustic_photons(bool direct, bool specular);

/// Where a stored photon comes from.
struct PhotonHistory {
  uint64_t number = 0;                        // of the photon among those emitted in the pass
  uint32_t place = 0;                         // the medium's number or the shape's, where it is stored
  uint32_t scatterings = 0, reflections = 0;  // before it came there: ArrivingPhoton
  float density = 1.0f;                       // what its power was divided by: stored_power()
  bool along_flight = false;                  // did it fly past there, in place of colliding?
};

/// Records photons at their collisions in scattering media, before the choice between absorption and scattering. Their
/// power is the power that collides; under VolumeForm::density_at_query it is divided by the density there
/// (stored_power()).
///
/// Where a grid's density is below the floor, photons collide too seldom for that. There it also records photons along
/// their flights: as many as are missing to the collisions that a medium of the floor's density would have. Each has
/// the power of a collision there, over the floor. So the two estimates of fluence, by collisions and by the length of
/// flights [Spanier1969], are combined by the balance heuristic [Veach1997, sec. 9.2]: powers are bounded, and their
/// mean is what it is without a floor. Flights must be drawn from the medium's own transmittance.
class CollisionRecorder : public PhotonRecorder {
 public:
  CollisionRecorder(const Scene& scene, VolumeForm form, const ThinParts& thin, PhotonFilter filter);

  std::unique_ptr<PhotonRecorder> part() const override;
  void join(PhotonRecorder& part) override;
  size_t stored() const override;
  RecordNeeds needs() const override { return {.flights = fills_, .hits = false}; }
  bool reads_density() const override { return form_ == VolumeForm::density_at_query; }
  void keep_histories() override { keeps_histories_ = true; }
  void flew(const Track& track, const ArrivingPhoton& photon, Rng& rng) override;
  void collided(const ArrivingPhoton& photon) override;

  std::vector<std::vector<Photon>> photons;           // by medium; powers not yet divided by the photons emitted
  std::vector<std::vector<PhotonHistory>> histories;  // of these, where they are kept
  uint64_t floored = 0;                               // of these: photons where the density is below the floor

 private:
  const Scene& scene_;
  VolumeForm form_;
  ThinParts thin_;
  PhotonFilter filter_;
  bool fills_;  // up to the floor, along flights
  bool keeps_histories_ = false;
};

/// If irradiance is cached, one in kCachePointStep photons finds the cache points [Christensen1999].
inline constexpr uint64_t kCachePointStep = 4;
inline bool finds_cache_points(uint64_t number) { return number % kCachePointStep == kCachePointStep - 1; }

/// What a recorder of photons on surfaces is for. Photons of the surface map count as stored, those of other maps do
/// not. If irradiance is cached, the surface map leaves out the photons that find the cache points.
enum class HitUse { surface_map, surface_map_without_cache_points, other_map };

/// Records photons on non-specular surfaces.
class HitRecorder : public PhotonRecorder {
 public:
  HitRecorder(const Scene& scene, PhotonFilter filter, HitUse use);

  std::unique_ptr<PhotonRecorder> part() const override;
  void join(PhotonRecorder& part) override;
  size_t stored() const override { return use_ == HitUse::other_map ? 0 : photons.size(); }
  RecordNeeds needs() const override { return {.flights = false, .collisions = false}; }
  void keep_histories() override { keeps_histories_ = true; }
  void emitted(uint64_t number) override { emitted_count += leaves_out(number) ? 0 : 1; }
  void hit(const ArrivingPhoton& photon) override;

  std::vector<Photon> photons;           // powers in W, not yet divided by `emitted_count`
  std::vector<PhotonHistory> histories;  // of these, where they are kept
  uint64_t emitted_count = 0;            // emitted photons, without those that the map leaves out

 private:
  bool leaves_out(uint64_t number) const {
    return use_ == HitUse::surface_map_without_cache_points && finds_cache_points(number);
  }

  const Scene& scene_;
  PhotonFilter filter_;
  HitUse use_;
  bool keeps_histories_ = false;
};

/// A point on a Lambertian surface, found by a photon. Its normals are on the side on which the photon arrived.
struct CachePoint {
  Vec3 position{0.0f};             // m
  PackedDirection normal;          // geometric
  PackedDirection shading_normal;  // for shading
};

/// Records the points on Lambertian surfaces that one in kCachePointStep photons meets.
class CachePointRecorder : public PhotonRecorder {
 public:
  explicit CachePointRecorder(const Scene& scene) : scene_(scene) {}

  std::unique_ptr<PhotonRecorder> part() const override { return std::make_unique<CachePointRecorder>(scene_); }
  void join(PhotonRecorder& part) override;
  RecordNeeds needs() const override { return {.flights = false, .collisions = false}; }
  void hit(const ArrivingPhoton& photon) override;

  std::vector<CachePoint> points;

 private:
  const Scene& scene_;
};

/// How photons are traced, and which of them are listed.
struct ListSettings : TraceSettings {
  VolumeForm volume_form = VolumeForm::density_at_query;
  float density_floor = 0.0f;                         // density at the query: see CollisionRecorder
  bool direct_collisions = true, direct_hits = true;  // also list photons that have not scattered yet
};

/// The listed photons. Their powers are not yet divided by `ledger.emitted_count`.
struct PhotonLists {
  std::vector<std::vector<Photon>> volume;  // photons that collided, by medium
  std::vector<Photon> surface;              // photons on non-specular surfaces
  Ledger ledger;
};

PhotonLists list_photons(const Scene& scene, const DistanceStrategy& strategy, const ListSettings& settings);

}  // namespace vpm
