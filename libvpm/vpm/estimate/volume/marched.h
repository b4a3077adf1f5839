// Marching: light at points along the eye ray, wherever it comes from, each point drawn in proportion to the density
// that the eye sees there [Jarosz2008, eq. 7.9, corrected].
#pragma once

#include <memory>

#include "vpm/estimate/volume/estimator.h"

namespace vpm {

/// Where light at points comes from. One virtual call for each point: it costs some nanoseconds, the light of a point a
/// microsecond at the least.
class MarchedSource : public Estimator {
 public:
  /// A part of a segment, and the longest step there, m; beyond it the source has nothing.
  struct Reach {
    Interval interval;
    float step = kInfinity;
  };
  virtual ScatteredLight finds() const = 0;
  virtual Reach reach(const EyeSegment& segment) const = 0;
  /// The source of radiance towards the eye at a point of the segment, over the relative density there (see
  /// relative_density()), W/(m^3 sr).
  virtual Rgb at(const EyeSegment& segment, const Vec3& point, EyeWork& work) const = 0;
};

/// Several sources, asked at the same points.
class MarchedLight final : public VolumeEstimator {
 public:
  static constexpr size_t kMostSources = 4;
  /// At least one source. `max_optical_step`: the optical thickness of a step at the most, > 0.
  MarchedLight(std::vector<std::unique_ptr<MarchedSource>> sources, float max_optical_step);

  ScatteredLight finds() const override;
  std::vector<MapInfo> maps() const override;
  Recorders recorders() override;
  void build(uint64_t emitted, RenderStatistics& statistics) override;
  Rgb along(const EyeSegment& segment, EyeWork& work) const override;

 private:
  class March;

  std::vector<std::unique_ptr<MarchedSource>> sources_;
  float max_optical_step_;
};

}  // namespace vpm
