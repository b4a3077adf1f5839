// Pictures of blocks, summed in double precision.
#include "vpm/integrators/photon_map/photon_blocks.h"

#include <algorithm>
#include <vector>

namespace vpm {
namespace {

/// A sum of pictures of one size.
class WeightedSum {
 public:
  WeightedSum(const Image& first, double weight)
      : width_(first.width), height_(first.height), pixels_(first.pixels.size()) {
    add(first, weight);
  }
  void add(const Image& image, double weight) {
    for (size_t i = 0; i < pixels_.size(); ++i) pixels_[i] += weight * Rgbd(image.pixels[i]);
  }
  Image sum() const {
    Image image(width_, height_);
    std::transform(pixels_.begin(), pixels_.end(), image.pixels.begin(), [](const Rgbd& pixel) { return Rgb(pixel); });
    return image;
  }

 private:
  int width_, height_;
  std::vector<Rgbd> pixels_;
};

}  // namespace

uint64_t block_count(const RenderSettings& settings) {
  const uint64_t photons = settings.photons.emitted, most = settings.photons.block;
  if (most == 0 || settings.integrator != Integrator::photon) return 1;
  return std::max<uint64_t>(1, photons / most + (photons % most > 0));
}

PhotonBlock photon_block(const RenderSettings& settings, uint64_t number) {
  const uint64_t blocks = block_count(settings), each = settings.photons.emitted / blocks,
                 larger = settings.photons.emitted % blocks;  // the first ones
  return {number * each + std::min(number, larger), each + (number < larger)};
}

Pass mean_of_blocks(const RenderSettings& settings, const std::function<Pass(const PhotonBlock&)>& render) {
  Pass mean = render(photon_block(settings, 0));
  const uint64_t blocks = block_count(settings);
  if (blocks == 1) return mean;
  const auto share = [&](uint64_t number) {
    return static_cast<double>(photon_block(settings, number).count) / static_cast<double>(settings.photons.emitted);
  };
  WeightedSum image(mean.image, share(0)), correction(mean.correction, share(0));
  for (uint64_t number = 1; number < blocks; ++number) {
    const Pass next = render(photon_block(settings, number));
    image.add(next.image, share(number));
    correction.add(next.correction, share(number));
    for (size_t i = 0; i < mean.found.size(); ++i) mean.found[i] += next.found[i];
    mean.statistics.merge(next.statistics);
  }
  mean.image = image.sum();
  mean.correction = correction.sum();
  mean.statistics.passes = 1;
  return mean;
}

}  // namespace vpm
