// The photons of media that an estimator gathers, one map for each medium.
#pragma once

#include "vpm/estimate/photon_map.h"
#include "vpm/integrators/photon_map/estimator.h"
#include "vpm/photon/records.h"

namespace vpm {

/// The settings of an estimator that gathers photons of media.
struct VolumeMapSettings {
  AskedGather gather;
  VolumeForm form = VolumeForm::density_at_query;
  float density_floor = 0.0f;  // in [0, 1], see stored_power()
  bool once = true;            // also gather photons that come straight from lights
  PassOfMaps pass;
  bool turned = true;  // also gather photons whose flights began at collisions (Turn)

  PhotonFilter filter() const {
    const PhotonFilter of_light = once ? any_photon : indirect_photon;
    return turned ? of_light : of_light.straight();
  }
};

/// A Map is what `make`(photons, settings in this pass, radius over that of the first pass, emitted, statistics)
/// returns, see build().
template <class Map>
class VolumeMaps {
 public:
  /// `dimension` of the kernel.
  VolumeMaps(const Scene& scene, const VolumeMapSettings& settings, int dimension)
      : scene_(scene),
        settings_(settings),
        dimension_(dimension),
        // The region of a ball that is corrected has no places without density.
        collisions_(scene, settings.form, {settings.density_floor, !settings.gather.corrects_each_ball()},
                    settings.filter()) {}

  ScatteredLight finds() const { return {settings_.once, true}; }
  std::vector<MapInfo> maps() const { return {{"volume", dimension_, true, &collisions_.photons}}; }
  Recorders recorders() { return {&collisions_}; }
  const VolumeMapSettings& settings() const { return settings_; }
  const Map& operator[](size_t medium) const { return by_medium_[medium]; }
  size_t size() const { return by_medium_.size(); }
  /// The box around the photons of the pass in a medium, of which its map may hold a block.
  const Box& around(size_t medium) const {
    return settings_.pass.around ? (*settings_.pass.around)[medium] : by_medium_[medium].bounds();
  }

  template <class Make>
  void build(uint64_t emitted, RenderStatistics& statistics, Make&& make) {
    count(statistics.ledger.floored, collisions_.floored);
    for (size_t m = 0; m < scene_.media.size(); ++m) {
      std::vector<Photon>& photons = collisions_.photons[m];
      const float first = first_radius(settings_.gather, scene_, scene_.media[m]);
      const GatherSettings gather = gather_in_pass(settings_.gather, first, dimension_, settings_.pass);
      statistics.volume_photons += photons.size();
      statistics.last_volume_radius = std::max(statistics.last_volume_radius, gather.radius);
      by_medium_.push_back(make(photons, gather, gather.radius / first, emitted, statistics));
    }
  }

 private:
  const Scene& scene_;
  VolumeMapSettings settings_;
  int dimension_;
  CollisionRecorder collisions_;
  std::vector<Map> by_medium_;
};

/// The length of steps among photons that are gathered within `radius`, m: that radius, so that few are passed by.
/// Where it would make too many steps in a segment (thin media that extend very far), steps are longer; the result is
/// then noisier, but no less right.
inline float step_among(float radius, const Interval& interval) {
  constexpr float kMostSteps = 10'000.0f;  // in one segment of a ray
  return std::max(radius, interval.length() / kMostSteps);
}

}  // namespace vpm
