// One pass over the pixels, in tiles, whatever estimates a ray's radiance.
#pragma once

#include <algorithm>
#include <span>

#include "vpm/base/counters.h"
#include "vpm/estimate/eye_work.h"
#include "vpm/film/ordered_rays.h"
#include "vpm/film/pass.h"
#include "vpm/film/pass_settings.h"
#include "vpm/scene/scene.h"

namespace vpm {

/// The pixels that are rendered: those of tiles, from the corner of the picture, that meet what the camera asks for.
PixelRect rendered_in_tiles(const Camera& camera);

/// The units of work of a pass's image.
uint64_t tile_count(const Camera& camera);

/// Makes one of a function of one ray: of(const Ray&, EyeWork&) returns a KernelEstimate.
template <class OfRay>
RadianceOfRays ray_by_ray(OfRay&& of) {
  return [of](std::span<EyeRay> rays) {
    for (EyeRay& each : rays) each.radiance = of(each.ray, each.work);
  };
}

/// The mean of samples. Those that are not finite are counted and left out as black.
class SampleMean {
 public:
  void add(const KernelEstimate& sample, EyeCounters& counters) {
    count(counters.rays);
    ++samples_;
    if (is_finite(sample.value) && is_finite(sample.correction))
      sum_ += {Rgbd(sample.value), Rgbd(sample.correction)};
    else
      ++counters.non_finite;
  }
  KernelEstimate mean() const {
    const double n = std::max(1, samples_);
    return {Rgb(sum_.value / n), Rgb(sum_.correction / n)};
  }

 private:
  KernelPair<Rgbd> sum_;
  int samples_ = 0;
};

/// The SampleMean of sample(0), sample(1), ... sample(samples - 1).
template <class Sample>
KernelEstimate mean_of_samples(int samples, EyeCounters& counters, Sample&& sample) {
  SampleMean mean;
  for (int s = 0; s < samples; ++s) mean.add(sample(s), counters);
  return mean.mean();
}

/// Renders the pixels of pass number `pass`: the mean of the settings' samples per pixel, a SampleMean, and where the
/// settings ask for layers, the means of what these samples' rays see. Where the camera has a crop, the pixels are
/// those of all tiles that it meets: it has the same bits as that part of the whole. One pixel of each square of
/// `square` x `square` may gather for all, see SharedGather; 1: none does.
Pass render_image(const Scene& scene, const PassSettings& settings, int pass, const RadianceOfRays& radiance,
                  const PassProgress& progress = {}, int square = 1);

}  // namespace vpm
