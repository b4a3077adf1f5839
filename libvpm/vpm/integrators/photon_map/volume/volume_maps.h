// The photons of media that an estimator gathers, one map for each medium.
#pragma once

#include "vpm/estimate/photon_map.h"
#include "vpm/integrators/photon_map/estimator.h"
#include "vpm/integrators/photon_map/volume/volume_settings.h"
#include "vpm/photon/records.h"

namespace vpm {

/// A pass of estimators that gather photons of media.
struct MediaPass {
  PassOfMaps maps;
  bool once = true;   // are photons that come straight from lights gathered, too?
  uint64_t seed = 1;  // of which flights become beams and planes

  /// The photons that are gathered; `turned`: also those whose flights began at collisions (Turn).
  PhotonFilter filter(bool turned) const {
    const PhotonFilter of_light = once ? any_photon : indirect_photon;
    return turned ? of_light : of_light.straight();
  }
};

/// A Map is what `make`(photons, settings in this pass, radius over that of the first pass, emitted, statistics)
/// returns, see build().
template <class Map>
class VolumeMaps {
 public:
  /// `dimension` of the kernel; `turned`: see MediaPass::filter().
  VolumeMaps(const Scene& scene, const VolumeSettings& settings, const MediaPass& pass, int dimension,
             bool turned = true)
      : scene_(scene),
        settings_(settings),
        pass_(pass),
        dimension_(dimension),
        // The region of a ball that is corrected has no places without density.
        collisions_(scene, settings.form, {settings.density_floor, !settings.corrects_each_ball()},
                    pass.filter(turned)) {}

  ScatteredLight finds() const { return {pass_.once, true}; }
  std::vector<MapInfo> maps() const {
    return {{.section = "volume",
             .dimension = dimension_,
             .media = &collisions_.photons,
             .media_histories = &collisions_.histories}};
  }
  Recorders recorders() { return {&collisions_}; }
  const VolumeSettings& settings() const { return settings_; }
  const PassOfMaps& pass() const { return pass_.maps; }
  const Map& operator[](size_t medium) const { return by_medium_[medium]; }
  size_t size() const { return by_medium_.size(); }
  /// The box around the photons of the pass in a medium, of which its map may hold a block.
  const Box& around(size_t medium) const {
    return pass_.maps.around ? (*pass_.maps.around)[medium] : by_medium_[medium].bounds();
  }

  template <class Make>
  void build(uint64_t emitted, RenderStatistics& statistics, Make&& make) {
    count(statistics.ledger.floored, collisions_.floored);
    for (size_t m = 0; m < scene_.media.size(); ++m) {
      std::vector<Photon>& photons = collisions_.photons[m];
      const float first = first_radius(settings_, scene_, scene_.media[m]);
      const GatherSettings gather = gather_in_pass(settings_, first, dimension_, pass_.maps);
      statistics.volume_photons += photons.size();
      statistics.last_volume_radius = std::max(statistics.last_volume_radius, gather.radius);
      by_medium_.push_back(make(photons, gather, gather.radius / first, emitted, statistics));
    }
  }

 private:
  const Scene& scene_;
  VolumeSettings settings_;
  MediaPass pass_;
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
