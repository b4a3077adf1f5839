// The photon beams of media as estimators gather them: recorded, thinned, and a map for each medium; and the sum over
// beams whose places nearest to a ray or a point are found.
#pragma once

#include <optional>
#include <utility>

#include "vpm/estimate/beam_estimate.h"
#include "vpm/integrators/photon_map/volume/volume_maps.h"
#include "vpm/photon/map/photon_beam_map.h"
#include "vpm/photon/photon_beam.h"

namespace vpm {

/// What is left of the power of a photon at the distance `s` (m) on its flight, given that it has come so far: 1 in a
/// grey medium; otherwise the weights of the mixture of channels. The ray begins where the flight does. Look-ups of
/// density are counted.
Rgb weight_along(const Medium& medium, const Ray& flight, const Rgb& power, float s, WalkCounters& counters);

/// Multiplies `passed` by what beams have left of their powers at these places, which are counted from `origin`, and,
/// for the density at the photon, by the density there. A beam ends where its photon collides: the photon has come as
/// far as to a place on the beam with the probability of the transmittance to it, so that this needs no further factor
/// in a grey medium, whatever its density. In a chromatic one the weights of the mixture of channels are left. Long
/// beams go on beyond the collision, and have the transmittance as a factor. Look-ups of density are counted.
void multiply_by_left(const Medium& medium, const VolumeSettings& settings, const Vec3& origin, const BeamPlaces& found,
                      Passed& passed, WalkCounters& counters);

/// The scattering coefficient, 1/m, that sums over beams are times: the densities that it goes by are in what passes to
/// the eye, relative to the largest (at the query), or in what is left of the beams' powers (at the photon).
inline Rgb scattering_of_beams(const Medium& medium, VolumeForm form) {
  return form == VolumeForm::density_at_photon ? medium.sigma_s : medium.sigma_s * medium.max_density();
}

/// The sum of power, phase function towards the eye, share[i], what has `passed`, and kernel: `profile` of the squared
/// distance times `inverse`, 1/m^2.
template <class P, class Profile>
KernelPair<Rgbd> sum_beams(const BeamPlaces& found, const Passed& passed, const float* share, const P& phase,
                           const Vec3& towards_eye, const Profile& profile, float inverse) {
  static_assert(BeamPlaces::kMost <= PhotonBatch::kMost);  // a Passed has room for them
  LaneSums values, corrections;
  const auto add = [&](size_t lane, size_t i) {
    const Vec3 direction(found.dx[i], found.dy[i], found.dz[i]);
    const Rgb light = Rgb(found.r[i] * passed.r[i], found.g[i] * passed.g[i], found.b[i] * passed.b[i]) *
                      (phase.value(direction, towards_eye) * share[i]);
    const KernelPair<float> spread = profile(found.distance2[i] * inverse);
    values.add(lane, light * spread.value);
    corrections.add(lane, light * spread.correction);
  };
  const size_t whole_blocks = found.size / kBlock * kBlock;
  for (size_t block = 0; block < whole_blocks; block += kBlock)
    for (size_t lane = 0; lane < kBlock; ++lane) add(lane, block + lane);
  for (size_t i = whole_blocks; i < found.size; ++i) add(i - whole_blocks, i);
  return {values.total(), corrections.total()};
}

/// A Map is what `make`(number of the medium, beams, settings in this pass, the share of flights that are kept as
/// beams, scale of powers) returns, see build().
template <class Map>
class BeamMaps {
 public:
  /// `dimension` of the kernel. Beside planes: what these leave to beams.
  BeamMaps(const Scene& scene, const VolumeSettings& settings, const MediaPass& pass, int dimension,
           std::optional<PlaneUse> planes = {})
      : scene_(scene),
        settings_(settings),
        pass_(pass),
        dimension_(dimension),
        flights_(scene, pass.filter(planes != PlaneUse::alone),
                 {.long_beams = settings.length == BeamLength::long_beams, .turns = planes == PlaneUse::combined}) {}

  ScatteredLight finds() const { return {pass_.once, true}; }
  std::vector<MapInfo> maps() const {
    return {{.section = "volume", .dimension = dimension_, .flights = &flights_.beams}};
  }
  PhotonRecorder* recorder() { return &flights_; }
  const VolumeSettings& settings() const { return settings_; }
  const Map& operator[](MediumId medium) const { return by_medium_[medium]; }

  template <class Make>
  void build(uint64_t emitted, RenderStatistics& statistics, Make&& make) {
    const auto scale = static_cast<float>(1.0 / static_cast<double>(emitted));
    Rng rng(pass_.seed, rng_stream(RngUse::flight, static_cast<uint64_t>(pass_.maps.number)), 0);
    for (const std::vector<PhotonBeam>& flights : flights_.beams) statistics.flights += flights.size();
    const float kept = thin(flights_.beams, settings_.flights, rng);
    statistics.last_volume_radius = 0.0f;  // the report has that of beams, not that of collisions
    for (size_t m = 0; m < scene_.media.size(); ++m) {
      const float first = first_radius(settings_, scene_, scene_.media[m]);
      const GatherSettings of_pass = gather_in_pass(settings_, first, dimension_, pass_.maps);
      const std::vector<PhotonBeam> beams = std::exchange(flights_.beams[m], {});
      statistics.beams += beams.size();
      statistics.last_volume_radius = std::max(statistics.last_volume_radius, of_pass.radius);
      by_medium_.push_back(make(static_cast<MediumId>(m), beams, of_pass, kept, scale));
      statistics.photon_map_bytes += by_medium_.back().memory_bytes();
    }
  }

 private:
  const Scene& scene_;
  VolumeSettings settings_;
  MediaPass pass_;
  int dimension_;
  BeamRecorder flights_;
  std::vector<Map> by_medium_;
};

}  // namespace vpm
