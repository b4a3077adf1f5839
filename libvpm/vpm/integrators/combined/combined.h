// The combined estimator: sub-paths from the eye meet those from the lights in every way there is, and each way has
// that share in a path that its density has among those of all. Each path counts once, if a technique in use finds it.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "vpm/estimate/eye_work.h"
#include "vpm/integrators/combined/light_sub_paths.h"
#include "vpm/integrators/combined/merge_map.h"
#include "vpm/photon/map/photon_beam_map.h"

namespace vpm {

/// The kernels that merge sub-paths in one pass. Radii are in m, > 0.
struct MergeKernels {
  KernelKind surface_kernel = KernelKind::epanechnikov, volume_kernel = KernelKind::epanechnikov;
  float surface = 0.0f;
  float beams = 0.0f, points_2d = 0.0f, points_3d = 0.0f;
};

/// The beams of a medium, with their flights, in the order of the map.
struct LightBeams {
  PhotonBeamMap map;
  std::vector<FlightTerms> flights;
};

/// The light sub-paths of one pass, sorted for eye sub-paths.
class SortedLight {
 public:
  SortedLight(const Scene& scene, const TechniqueCounts& counts, const MergeKernels& kernels, LightSubPaths paths);

  /// Those that may be connected to.
  const std::vector<PathVertex>& vertices() const { return paths_.vertices; }
  /// Of how many sub-paths these are, with sub-paths that have none.
  uint64_t connectable_paths() const { return paths_.connectable; }
  const LightBeams& beams(MediumId medium) const { return beams_[medium]; }
  /// Photons on surfaces, but those straight from lights that are sampled, and in a medium.
  const MergeMap& on_surfaces() const { return on_surfaces_; }
  const MergeMap& in_medium(MediumId medium) const { return in_media_[medium]; }
  /// behind_scale() in a medium.
  double scale_in(MediumId medium) const { return scales_[medium]; }
  size_t beam_count() const;
  size_t photons_in_media() const;
  /// Of what grows with the number of light sub-paths: those that may be connected to are few.
  size_t memory_bytes() const;

 private:
  LightSubPaths paths_;
  MergeMap on_surfaces_;
  std::vector<MergeMap> in_media_;  // by medium
  std::vector<double> scales_;      // likewise
  std::vector<LightBeams> beams_;   // likewise
};

/// What eye sub-paths read. Immutable while they run.
struct CombinedContext {
  const Scene& scene;
  const DistanceStrategy& strategy;
  const TransmittanceEstimator& transmittance;  // exact
  const TechniqueCounts& counts;
  const MergeKernels& kernels;
  const SortedLight& light;
  double light_paths = 1.0;  // how many there are
  int max_events = 100'000;  // of one eye sub-path
};

/// What each technique finds, W/(m^2 sr): with its shares, and without, so that a path which a technique finds in
/// several ways, at several vertices, counts for each of them.
struct TechniqueParts {
  std::array<Rgb, kTechniques.size()> weighted{}, unweighted{};

  void add(Technique technique, const Rgb& found, double share) {
    add_both(technique, found * static_cast<float>(share), found);
  }
  void add_both(Technique technique, const Rgb& with_shares, const Rgb& without) {
    const auto number = static_cast<size_t>(technique);
    weighted[number] += with_shares;
    unweighted[number] += without;
  }
};

/// One sample of the radiance along a camera ray, W/(m^2 sr), without the share of light tracing. Adds to `parts`, too,
/// where that is not null.
KernelEstimate combined_radiance(const CombinedContext& context, const Ray& camera_ray, EyeWork& work,
                                 TechniqueParts* parts = nullptr);
/// The same for up to kEyeRays rays from the camera that lie side by side, with parts for each where that is not null.
/// Photons and beams are taken to all of them together, in homogeneous media.
void combined_radiance(const CombinedContext& context, std::span<EyeRay> rays, TechniqueParts* parts);

}  // namespace vpm
