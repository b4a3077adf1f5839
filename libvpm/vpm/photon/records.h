// Recorders of photons where they collide and where they meet rough surfaces.
#pragma once

#include <functional>

#include "vpm/photon/photon.h"
#include "vpm/photon/recorder.h"

namespace vpm {

/// Which photons a recorder keeps of those that arrive.
using PhotonFilter = std::function<bool(const ArrivingPhoton&)>;

/// Keeps every photon, and those that something has scattered, reflected or refracted.
inline bool any_photon(const ArrivingPhoton&) { return true; }
inline bool indirect_photon(const ArrivingPhoton& photon) { return !photon.direct; }
/// Keeps photons that a rough surface scattered last.
inline bool photon_from_rough(const ArrivingPhoton& photon) { return photon.from_rough; }
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
  void hit(const ArrivingPhoton& photon) override;

  std::vector<SurfaceSite> sites;

 private:
  const Scene& scene_;
};

}  // namespace vpm
