// The open sets of estimators of the light that media and non-specular surfaces send towards the eye, by one virtual
// call for each segment of an eye ray, or for each surface that one ends on. What both have in common: they are made
// for one pass, say which photons they want, sort them, and then answer rays without changing any more.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "vpm/estimate/eye_segment.h"
#include "vpm/estimate/eye_work.h"
#include "vpm/estimate/statistics.h"
#include "vpm/photon/photon.h"
#include "vpm/photon/trace.h"
#include "vpm/scene/scene.h"

namespace vpm {

struct PhotonBeam;
struct PhotonHistory;

/// A photon map that an estimator gathers from in a pass.
struct MapInfo {
  std::string_view section;                                 // of the scene file, that holds its settings
  int dimension = 3;                                        // of its kernel
  bool shows_bias = true;                                   // its estimates have the correction of their kernels
  const std::vector<std::vector<Photon>>* media = nullptr;  // its photons before build(), by medium ...
  const std::vector<Photon>* surfaces = nullptr;            // ... or on surfaces; W, of `emitted` photons
  uint64_t emitted = 0;                                     // for this map alone; 0: as many as in the ledger
  /// What is gathered besides, before build(), by medium.
  const std::vector<std::vector<PhotonBeam>>* flights = nullptr;
  /// Of the photons, where their recorders keep these.
  const std::vector<std::vector<PhotonHistory>>* media_histories = nullptr;
  const std::vector<PhotonHistory>* surface_histories = nullptr;
};

/// The photon tracing of a pass, once it is over.
struct TracedPass {
  const DistanceStrategy& strategy;
  const TraceSettings& settings;
  uint64_t emitted;  // photons
};

class Estimator {
 public:
  virtual ~Estimator() = default;
  /// The maps that it gathers from, if any.
  virtual std::vector<MapInfo> maps() const { return {}; }
  /// What photon tracing is to deposit into before build().
  virtual Recorders recorders() { return {}; }
  /// Traces photons of its own, after the others and before build(), where it wants any, and counts that.
  virtual void trace_more(const TracedPass&, RenderStatistics&) {}
  /// Sorts what was deposited, of so many emitted photons, and counts that; once.
  virtual void build(uint64_t /*emitted*/, RenderStatistics&) {}
};

/// A non-specular surface as met by a path that travels along `travel` in `medium`.
struct SurfaceView {
  const Hit& hit;
  const Material& material;
  Vec3 travel{0.0f};  // unit
  MediumId medium = kVacuum;
};

/// Estimates the radiance that leaves a surface in the direction -`travel`, W/(m^2 sr), without its own emission.
class SurfaceEstimator : public Estimator {
 public:
  /// The part that is each ray's own: what rays from the surface find, and photons in discs of the pixel's own radius.
  virtual KernelEstimate found_by_rays(const SurfaceView&, EyeWork&) const { return {}; }
  /// The part that photons around the place bring, which neighbouring rays may share.
  virtual KernelEstimate found_by_photons(const SurfaceView&, EyeWork&) const { return {}; }
  /// All of it.
  KernelEstimate sent(const SurfaceView& view, EyeWork& work) const {
    const KernelEstimate by_rays = found_by_rays(view, work);
    return found_by_photons(view, work) + by_rays;
  }
  /// The variance of the kernels of found_by_photons() along an axis, m^2; 0 where they have no one variance.
  virtual float kernel_variance() const { return 0.0f; }
  /// The number of photons found in the disc of each pixel, over its samples; empty where pixels have no discs of their
  /// own.
  virtual std::vector<uint64_t> take_found() { return {}; }
};

/// A part of the light that media scatter.
struct ScatteredLight {
  bool once = false;  // light that comes straight from a light source
  bool more = false;  // all other light

  bool overlaps(const ScatteredLight& other) const { return (once && other.once) || (more && other.more); }
};

/// A segment of one of several rays that lie side by side, and what is found along it.
struct BundledSegment {
  const EyeSegment* segment;
  EyeWork* work;
  KernelEstimate light{};  // W/(m^2 sr)
};
using SegmentBundle = std::span<BundledSegment>;

class VolumeEstimator : public Estimator {
 public:
  /// The light that it estimates; all other it leaves to others.
  virtual ScatteredLight finds() const = 0;
  /// Estimates that light, scattered into the segment, as it is seen at the segment's start and times its throughput,
  /// W/(m^2 sr).
  virtual KernelEstimate along(const EyeSegment& segment, EyeWork& work) const = 0;
  /// The variance of its kernels along an axis across the ray, m^2. 0 where they have no one variance, or where rays
  /// find the light: neighbouring rays share none of it then.
  virtual float kernel_variance(MediumId) const { return 0.0f; }
  /// Adds along() to the light of each of up to kEyeRays segments, in one homogeneous medium, of rays that come
  /// straight from `apex`. An override may treat them jointly, if the result is the same up to rounding.
  virtual void along_bundle([[maybe_unused]] const Vec3& apex, SegmentBundle bundle) const {
    for (BundledSegment& of : bundle) of.light += along(*of.segment, *of.work);
  }
};

}  // namespace vpm
