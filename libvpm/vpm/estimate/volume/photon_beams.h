// Photon beams met by eye rays [Jarosz2011]: all flights of photons that pass a segment of an eye ray closely. Each is
// spread over a kernel of one dimension, along the common perpendicular of the two lines. Beams that run nearly along
// the ray would be very bright; they are combined with the photons that collide beside it (BeamBalance).
#pragma once

#include "vpm/estimate/segment_region.h"
#include "vpm/estimate/volume/beam_radiance.h"
#include "vpm/estimate/volume/pass_to_eye.h"
#include "vpm/photon/photon_beam_map.h"

namespace vpm {

/// What is left of the power of a photon at the distance `s` (m) on its flight, given that it has come so far: 1 in a
/// grey medium; otherwise the weights of the mixture of channels. The ray begins where the flight does.
Rgb weight_along(const Medium& medium, const Ray& flight, const Rgb& power, float s);

struct PhotonBeamSettings {
  VolumeMapSettings maps;
  uint64_t flights = 0;     // > 0: the most beams, of all media together
  uint64_t seed = 1;        // of which of them
  bool long_beams = false;  // do beams go on to where their rays leave the medium?
  bool planes = false;      // are there planes, too?
};

/// Gathers the beams of the medium that the segment is in. A beam ends where its photon collides: the photon has come
/// as far as to a place on the beam with the probability of the transmittance to it, so that this needs no further
/// factor in a grey medium, whatever its density. In a chromatic one the weights of the mixture of channels are left.
/// Long beams go on beyond the collision, and have the transmittance as a factor.
///
/// Beside planes, it gathers light whose last flight began at a collision from beams alone.
class PhotonBeams final : public VolumeEstimator {
 public:
  PhotonBeams(const Scene& scene, const PhotonBeamSettings& settings);

  ScatteredLight finds() const override { return collisions_.finds(); }
  std::vector<MapInfo> maps() const override;
  Recorders recorders() override;
  void build(uint64_t emitted, RenderStatistics& statistics) override { build_beside(0.0f, emitted, statistics); }
  /// build() beside planes, one for this share of the flights; 0: there are none.
  void build_beside(float kept_planes, uint64_t emitted, RenderStatistics& statistics);
  KernelEstimate along(const EyeSegment& segment, EyeWork& work) const override;
  const BeamBalance& balance(MediumId medium) const { return by_medium_[medium].balance; }

 private:
  /// The collision that a beam's flight began at, if it did.
  struct Begin {
    Vec3 from;      // the direction before, unit
    float sigma_s;  // 1/m, the mean of its channels; 0: it did not
  };
  struct Map {
    GatherSettings settings;  // of this pass
    BeamBalance balance;
    PhotonBeamMap beams;
    std::vector<Begin> begins;  // of the beams; empty if there are no planes
  };

  KernelEstimate beams_along(const EyeSegment& segment, const Map& map, EyeWork& work) const;
  KernelEstimate gather(const EyeSegment& segment, const SegmentRegion& region, const Interval& near, const Map& map,
                        EyeWork& work) const;
  /// What passes to the eye, times what is left of beams' powers where they cross; and the beams' shares over sines.
  size_t pass_beams(const EyeSegment& segment, const SegmentRegion& region, const Map& map, const PassToEye& pass,
                    const BeamCrossings& found, Passed& passed, float* share) const;
  void share_with_planes(const Vec3& ray, const Map& map, const BeamCrossings& found, float* share) const;

  const Scene& scene_;
  PhotonBeamSettings settings_;
  BeamRecorder flights_;
  VolumeMaps<BeamMap> collisions_;
  std::vector<Map> by_medium_;
};

}  // namespace vpm
