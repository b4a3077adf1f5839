// Photon beams: the flights of photons, as records, and keeping some of many, so that they stand for all.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "vpm/base/rng.h"
#include "vpm/photon/records.h"

namespace vpm {

/// A flight of a photon through one medium [Jarosz2011].
struct PhotonBeam {
  Vec3 origin{0.0f};     // m
  float length = 0.0f;   // m, > 0: to the collision, or to where the flight, or its ray, leaves the medium
  Vec3 direction{0.0f};  // in which the photon travels, unit
  Rgb power{0.0f};       // of the photon at the origin, W
  // If it is recorded that the flight began at a collision, not at a light or a surface:
  PackedDirection turned_from{};  // the direction before it
  float scattering_rate = 0.0f;   // the scattering coefficient there, the mean of its channels, 1/m; otherwise 0
};
static_assert(sizeof(PhotonBeam) <= 48);

/// Records the flights of photons through scattering media. They do not count towards TraceSettings::stored. A flight
/// that crosses boundaries between media is one record in each.
class BeamRecorder final : public PhotonRecorder {
 public:
  /// What is recorded besides flights: that they would have gone on without a collision; the collisions that they
  /// began at.
  struct More {
    bool long_beams = false, turns = false;
  };
  BeamRecorder(const Scene& scene, PhotonFilter filter, const More& more);

  std::unique_ptr<PhotonRecorder> part() const override {
    return std::make_unique<BeamRecorder>(scene_, filter_, more_);
  }
  void join(PhotonRecorder& part) override;
  RecordNeeds needs() const override { return {.collisions = false, .hits = false}; }
  bool reads_density() const override { return more_.turns; }
  void flew(const Track& track, const ArrivingPhoton& photon, Rng&) override;

  std::vector<std::vector<PhotonBeam>> beams;  // by medium; powers not yet divided by the photons emitted

 private:
  const Scene& scene_;
  PhotonFilter filter_;
  More more_;
};

/// Keeps no more than `most` records, those of all media together; 0: all. Of each of as many equal stretches of the
/// list of all one is drawn, and takes the power of the stretch: sums over records stay what they are in the mean. At
/// equal distances they would all be of one part of a lamp, where points of low discrepancy have the places on it in
/// turn. Returns the share that is kept.
template <class Record>
float thin(std::vector<std::vector<Record>>& by_medium, uint64_t most, Rng& rng) {
  uint64_t all = 0;
  for (const std::vector<Record>& records : by_medium) all += records.size();
  if (most == 0 || all <= most) return 1.0f;
  const double step = static_cast<double>(all) / static_cast<double>(most);
  double begun = 0.0;      // stretches
  const auto draw = [&] {  // rounding may take a draw beyond the last record
    return begun < static_cast<double>(most)
               ? std::min(all - 1, static_cast<uint64_t>(step * (begun++ + rng.uniform_double())))
               : all;
  };
  uint64_t next = draw(), number = 0;
  for (std::vector<Record>& records : by_medium) {
    size_t kept = 0;
    for (const Record& record : records) {
      float stretches = 0.0f;  // that have drawn this one: two may share it
      for (; number == next; next = draw()) ++stretches;
      ++number;
      if (stretches == 0.0f) continue;
      records[kept] = record;
      records[kept++].power *= stretches * static_cast<float>(step);
    }
    records.resize(kept);
  }
  return static_cast<float>(1.0 / step);
}

}  // namespace vpm
