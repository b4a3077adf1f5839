// One pass over the pixels, in tiles, whatever estimates a ray's radiance.
#pragma once

#include <atomic>
#include <functional>

#include "vpm/base/count.h"
#include "vpm/estimate/eye_work.h"
#include "vpm/render/pass.h"
#include "vpm/render/settings.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// The units of work of a pass's image.
uint64_t tile_count(const Camera& camera);

/// Estimates the radiance along a camera ray, W/(m^2 sr), and its correction. Called from many threads, for each pixel
/// from one.
using RayRadiance = std::function<KernelEstimate(const Ray& ray, EyeWork& work)>;

/// The mean of sample(0), sample(1), ... sample(samples - 1). Those that are not finite are counted and left out as
/// black.
template <class Sample>
KernelEstimate mean_of_samples(int samples, EyeCounters& counters, Sample&& sample) {
  KernelPair<Rgbd> sum;
  for (int s = 0; s < samples; ++s) {
    const KernelEstimate estimate = sample(s);
    count(counters.rays);
    if (is_finite(estimate.value) && is_finite(estimate.correction))
      sum += {Rgbd(estimate.value), Rgbd(estimate.correction)};
    else
      ++counters.non_finite;
  }
  const auto n = static_cast<double>(samples);
  return {Rgb(sum.value / n), Rgb(sum.correction / n)};
}

/// Renders the pixels of pass number `pass`: the mean of the settings' samples per pixel, by mean_of_samples(). Once
/// `stop` is set it returns as soon as it can, and its image must not be used.
Pass render_image(const Scene& scene, const RenderSettings& settings, int pass, const RayRadiance& radiance,
                  const std::atomic<bool>& stop, const PassProgress& progress = {});

}  // namespace vpm
