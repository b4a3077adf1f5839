// Recorders of photons where they collide and where they meet rough surfaces.
#pragma once

#include <concepts>
#include <cstdint>

#include "vpm/photon/photon.h"
#include "vpm/photon/recorder.h"

namespace vpm {

/// Which photons a recorder keeps of those that arrive, by where they come from: one bit for each of the eight answers.
class PhotonFilter {
 public:
  /// Those for which keeps(direct, specular, from_rough) holds, see ArrivingPhoton.
  template <std::predicate<bool, bool, bool> Keeps>
  constexpr explicit PhotonFilter(Keeps&& keeps) {
    for (uint32_t answer = 0; answer < 8; ++answer)
      kept_ |= static_cast<uint32_t>(keeps((answer & 1) != 0, (answer & 2) != 0, (answer & 4) != 0)) << answer;
  }
  bool operator()(const ArrivingPhoton& photon) const {
    const uint32_t answer = uint32_t{photon.direct} | uint32_t{photon.specular} << 1 | uint32_t{photon.from_rough} << 2;
    return (kept_ >> answer & 1) != 0;
  }

 private:
  uint32_t kept_ = 0;
};

/// Keeps every photon, and those that something has scattered, reflected or refracted.
inline constexpr PhotonFilter any_photon([](bool, bool, bool) { return true; });
inline constexpr PhotonFilter indirect_photon([](bool direct, bool, bool) { return !direct; });
/// Keeps photons that a rough surface scattered last.
inline constexpr PhotonFilter photon_from_rough([](bool, bool, bool from_rough) { return from_rough; });
/// Keeps photons that no rough surface scattered last; those straight from lights only if `direct`, those that nothing
/// but mirrors and glass has scattered only if `specular`.
PhotonFilter caustic_photons(bool direct, bool specular);

/// Photons at their collisions in media that scatter, before the choice between absorption and scattering. Their power
/// is the flux that collides, over the density there under VolumeForm::density_at_query (stored_power()).
class CollisionRecorder : public PhotonRecorder {
 public:
  /// `density_floor`, in [0, 1]: see stored_power().
  CollisionRecorder(const Scene& scene, VolumeForm form, float density_floor, PhotonFilter filter);

  std::unique_ptr<PhotonRecorder> part() const override;
  void join(PhotonRecorder& part) override;
  size_t stored() const override;
  RecordNeeds needs() const override { return {.flights = false, .hits = false}; }
  bool reads_density() const override { return form_ == VolumeForm::density_at_query; }
  void collided(const ArrivingPhoton& photon) override;

  std::vector<std::vector<Photon>> photons;  // by medium; powers not yet divided by the photons emitted
  uint64_t floored = 0;                      // of these: photons whose density was below the floor

 private:
  const Scene& scene_;
  VolumeForm form_;
  float density_floor_;
  PhotonFilter filter_;
};

/// Where sites are kept, one of so many photons finds them [Christensen1999].
inline constexpr uint64_t kSiteStep = 4;
inline bool finds_sites(uint64_t number) { return number % kSiteStep == kSiteStep - 1; }

/// What a recorder of photons on surfaces is for. The surface map counts as stored, and leaves out those that find
/// sites where there are any.
enum class HitUse { surface_map, surface_map_beside_sites, other_map };

/// Photons on rough surfaces.
class HitRecorder : public PhotonRecorder {
 public:
  HitRecorder(const Scene& scene, PhotonFilter filter, HitUse use);

  std::unique_ptr<PhotonRecorder> part() const override;
  void join(PhotonRecorder& part) override;
  size_t stored() const override { return use_ == HitUse::other_map ? 0 : photons.size(); }
  RecordNeeds needs() const override { return {.flights = false, .collisions = false}; }
  void emitted(uint64_t number) override { emitted_count += leaves_out(number) ? 0 : 1; }
  void hit(const ArrivingPhoton& photon) override;

  std::vector<Photon> photons;  // powers in W, not yet divided by `emitted_count`
  uint64_t emitted_count = 0;   // of photons that could be among these

 private:
  bool leaves_out(uint64_t number) const { return use_ == HitUse::surface_map_beside_sites && finds_sites(number); }

  const Scene& scene_;
  PhotonFilter filter_;
  HitUse use_;
};

/// A place on a diffuse surface that a photon found, seen from the side on which it arrived.
struct SurfaceSite {
  Vec3 position{0.0f};             // m
  PackedDirection normal;          // geometric, to that side
  PackedDirection shading_normal;  // the same, for shading
};

/// The places on diffuse surfaces that one of kSiteStep photons meets.
class SiteRecorder : public PhotonRecorder {
 public:
  explicit SiteRecorder(const Scene& scene) : scene_(scene) {}

  std::unique_ptr<PhotonRecorder> part() const override { return std::make_unique<SiteRecorder>(scene_); }
  void join(PhotonRecorder& part) override;
  RecordNeeds needs() const override { return {.flights = false, .collisions = false}; }
  void hit(const ArrivingPhoton& photon) override;

  std::vector<SurfaceSite> sites;

 private:
  const Scene& scene_;
};

}  // namespace vpm
