// Marching: sums light at points along the eye ray, whatever its source. Each point is drawn in proportion to the
// density that the eye sees there [Jarosz2008, eq. 7.9, corrected].
#pragma once

#include <memory>

#include "vpm/integrators/photon_map/estimator.h"
#include "vpm/integrators/photon_map/volume/points_of_segment.h"

namespace vpm {

/// A source of light at points. There is one virtual call for each point: it costs some nanoseconds, the light of a
/// point a microsecond at least.
class MarchedSource : public Estimator {
 public:
  /// The part of a segment outside which the source has no light, and the longest step in it, m.
  struct Reach {
    Interval interval;
    float step = kInfinity;
    std::optional<PointsOfSegment> points;  // of sources that sum over photons; may reach past the segment's ends
  };
  virtual ScatteredLight finds() const = 0;
  virtual Reach reach(const EyeSegment& segment) const = 0;
  /// The light that the source finds by a march of its own, over the throughput, W/(m^2 sr).
  virtual KernelEstimate evenly(const EyeSegment&, const Reach&, EyeWork&) const { return {}; }
  /// The source of radiance towards the eye at a point within the reach, divided by the relative density there (see
  /// relative_density()), W/(m^3 sr). Past the segment's ends the density is that at the mirrored place.
  virtual KernelEstimate at(const EyeSegment& segment, const Reach& reach, const Vec3& point, EyeWork& work) const = 0;
};

/// Several sources, asked at the same points.
class MarchedLight final : public VolumeEstimator {
 public:
  static constexpr size_t kMostSources = 4;
  /// At least one source. `max_optical_step` is the largest optical thickness of a step, > 0.
  MarchedLight(std::vector<std::unique_ptr<MarchedSource>> sources, float max_optical_step);

  ScatteredLight finds() const override;
  std::vector<MapInfo> maps() const override;
  Recorders recorders() override;
  void build(uint64_t emitted, RenderStatistics& statistics) override;
  KernelEstimate along(const EyeSegment& segment, EyeWork& work) const override;

 private:
  class March;

  std::vector<std::unique_ptr<MarchedSource>> sources_;
  float max_optical_step_;
};

}  // namespace vpm
