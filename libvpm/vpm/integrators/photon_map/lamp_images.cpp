// Rays through all pixels, in rows of them.
#include "vpm/integrators/photon_map/lamp_images.h"

#include <algorithm>
#include <variant>

#include "vpm/base/parallel.h"
#include "vpm/integrators/photon_map/eye_path.h"

namespace vpm {
namespace {

bool has_images(const Scene& scene) {
  const bool lamps = std::any_of(scene.shapes.begin(), scene.shapes.end(), [](const Shape& s) { return s.light >= 0; });
  return lamps && std::any_of(scene.materials.begin(), scene.materials.end(), [](const Material& material) {
           return !is_rough(material) && !is_boundary(material) && !is_diffuse(material);
         });
}

}  // namespace

LampImages::LampImages(const Scene& scene, uint64_t seed, int max_events) {
  if (!has_images(scene)) return;
  const Camera& camera = scene.camera;
  const auto width = static_cast<size_t>(camera.width), height = static_cast<size_t>(camera.height);
  const PixelRect rendered = camera.rendered();
  std::vector<uint8_t> seen(width * height);
  const Estimators none;
  const EyeContext context{scene, none, max_events};
  parallel_for_chunks(static_cast<size_t>(rendered.height()), 1, [&](size_t row, size_t, size_t) {
    EyeCounters counters;
    EyeScratch scratch;
    for (int x = rendered.x0; x < rendered.x1; ++x) {
      const size_t pixel = (static_cast<size_t>(rendered.y0) + row) * width + static_cast<size_t>(x);
      Rng rng(seed, rng_stream(RngUse::lamp, 0), pixel);
      EyeWork work{rng, counters, scratch, pixel};
      seen[pixel] = is_black(lamps_by_images(context, work)) ? 0 : 1;
    }
  });
  marked_ = seen;
  for (size_t y = 0; y < height; ++y)
    for (size_t x = 0; x < width; ++x)
      if (seen[y * width + x])
        for (size_t v = std::max<size_t>(y, 1) - 1; v < std::min(y + 2, height); ++v)
          for (size_t u = std::max<size_t>(x, 1) - 1; u < std::min(x + 2, width); ++u) marked_[v * width + u] = 1;
}

}  // namespace vpm
