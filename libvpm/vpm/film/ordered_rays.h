// The rays of pixels in their order, bundle by bundle.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "vpm/estimate/eye_work.h"
#include "vpm/estimate/shared_gather.h"
#include "vpm/film/pixel_squares.h"
#include "vpm/scene/camera.h"

namespace vpm {

/// Estimates the radiance along each of up to kEyeRays camera rays that lie side by side. Called from many threads, for
/// each pixel from one.
using RadianceOfRays = std::function<void(std::span<EyeRay> rays)>;

class OrderedRays {
 public:
  OrderedRays(const Camera& camera, const PixelOrder& order, int edge, EyeCounters& counters)
      : camera_(camera), order_(order), edge_(edge), counters_(counters) {}

  /// Follows a ray of each item: through `pixel_of(item)`, with the random numbers `rng_of(item, number of the pixel)`.
  /// Calls use(number of the item, ray) once it has its radiance.
  template <class PixelOf, class RngOf, class Use>
  void follow(const RadianceOfRays& radiance, PixelOf&& pixel_of, RngOf&& rng_of, Use&& use) {
    shared_.assign(static_cast<size_t>(edge_ > 1 ? order_.squares() : 0), {});
    size_t begin = 0;
    for (const size_t end : order_.ends()) {
      rays_.clear();
      rngs_.clear();
      rngs_.reserve(kEyeRays);
      for (size_t i = begin; i < end; ++i) {
        const PixelOrder::Item& item = order_.items()[i];
        const glm::ivec2 pixel = pixel_of(item);
        const size_t number = static_cast<size_t>(pixel.y) * camera_.width + pixel.x;
        add(item, pixel, number, rngs_.emplace_back(rng_of(item, number)));
      }
      radiance(rays_);
      for (size_t i = begin; i < end; ++i) use(i, std::as_const(rays_[i - begin]));
      begin = end;
    }
  }

 private:
  void add(const PixelOrder::Item& item, const glm::ivec2& pixel, size_t number, Rng& rng) {
    const Vec2 film = Vec2(pixel) + 0.5f + sample_filter(camera_.filter, rng.uniform2());
    EyeRay& ray = rays_.emplace_back(EyeRay{camera_.ray(film), {rng, counters_, scratch_, number}});
    if (shared_.empty() || item.square < 0) return;
    ray.shared = &shared_[static_cast<size_t>(item.square)];
    ray.leads = item.leads;
    if (item.leads)
      *ray.shared =
          SharedGather(variance_in_square(edge_) / static_cast<float>(camera_.film_per_angle(ray.ray.direction)));
  }

  const Camera& camera_;
  const PixelOrder& order_;
  int edge_;
  EyeCounters& counters_;
  std::vector<SharedGather> shared_;  // by square
  EyeScratch scratch_;
  std::vector<Rng> rngs_;  // of the rays of a bundle
  std::vector<EyeRay> rays_;
};

}  // namespace vpm
