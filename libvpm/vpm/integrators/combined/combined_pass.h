// One pass of the combined estimator: light sub-paths, their maps, and sub-paths from the eye.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "vpm/film/image_pass.h"
#include "vpm/integrators/combined/combined.h"
#include "vpm/integrators/combined/technique_layers.h"

namespace vpm {

/// Pass number `pass`, from 0, with its light sub-paths traced and sorted: RenderSettings::photons of them.
/// Immutable while rays run; the scene must live as long.
class CombinedPass {
 public:
  CombinedPass(const Scene& scene, const RenderSettings& settings, int pass);

  /// combined_radiance() along a ray of the camera, or along several.
  KernelEstimate radiance(const Ray& ray, EyeWork& work) const;
  void radiance(std::span<EyeRay> rays, TechniqueParts* parts = nullptr) const;
  /// Adds the share of light tracing to a picture of the others.
  void add_light_tracing(Image& image) const;
  /// What light tracing finds is added to the layers of the other techniques, where these are kept.
  void add_light_tracing(TechniqueLayers& layers) const;
  const RenderStatistics& statistics() const { return statistics_; }

 private:
  /// The vertices and flights, and what light tracing finds.
  LightSubPaths trace(const LightTracing& tracing);

  CombinedContext context() const {
    return {scene_, *strategy_, *transmittance_, counts_, kernels_, *light_, static_cast<double>(paths_), max_events_};
  }

  const Scene& scene_;
  uint64_t paths_;
  int max_events_;
  std::unique_ptr<DistanceStrategy> strategy_;
  std::unique_ptr<TransmittanceEstimator> transmittance_;  // exact
  MergeKernels kernels_;
  TechniqueCounts counts_;
  RenderStatistics statistics_;
  std::vector<Splat> splats_;
  std::optional<SortedLight> light_;
};

/// m, of the first pass: one for merges in all media, the least that any of them has by default.
float first_radius_of_merges(const AskedGather& volume, const Scene& scene);

/// The settings of a pass with no more than so many light sub-paths.
RenderSettings with_light_paths(const RenderSettings& settings, uint64_t most);

/// Do techniques of the combined estimator merge, so that kernels make a bias?
bool merges(const TechniqueSet& techniques);

/// Renders such a pass.
Pass render_combined_pass(const Scene& scene, const RenderSettings& settings, int pass,
                          const PassProgress& progress = {});

}  // namespace vpm
