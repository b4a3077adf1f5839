// Rays through all pixels, in rows of them.
#include "vpm/integrators/photon_map/lamp_images.h"

#include <algorithm>
#include <variant>

#include "vpm/base/parallel.h"
#include "vpm/film/image_pass.h"
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
  constexpr uint32_t kLooks = 4;   // rays; a pixel goes by those of its neighbours, too
  constexpr float kUneven = 1.5f;  // times the least light, from where on one ray is too few
  const Camera& camera = scene.camera;
  const int width = camera.width, height = camera.height;
  const PixelRect tiles = rendered_in_tiles(camera);
  const PixelRect looked{std::max(tiles.x0 - 1, 0), std::max(tiles.y0 - 1, 0), std::min(tiles.x1 + 1, width),
                         std::min(tiles.y1 + 1, height)};
  const auto number = [&](int x, int y) { return static_cast<size_t>(y) * static_cast<size_t>(width) + x; };
  std::vector<float> seen(number(0, height));  // W/(m^2 sr)
  const Estimators none;
  const EyeContext context{scene, none, max_events};
  parallel_for_chunks(static_cast<size_t>(looked.height()), 1, [&](size_t row, size_t, size_t) {
    EyeCounters counters;
    EyeScratch scratch;
    for (int x = looked.x0; x < looked.x1; ++x) {
      const size_t pixel = number(x, looked.y0 + static_cast<int>(row));
      Rng rng(seed, rng_stream(RngUse::lamp, 0), pixel);
      EyeWork work{rng, counters, scratch, pixel};
      seen[pixel] = mean_channel(lamps_by_images(context, work, kLooks));
    }
  });
  marked_.resize(seen.size());
  for (int y = looked.y0; y < looked.y1; ++y)
    for (int x = looked.x0; x < looked.x1; ++x) {
      float least = kInfinity, most = 0.0f;
      for (int v = std::max(y - 1, looked.y0); v < std::min(y + 2, looked.y1); ++v)
        for (int u = std::max(x - 1, looked.x0); u < std::min(x + 2, looked.x1); ++u) {
          least = std::min(least, seen[number(u, v)]);
          most = std::max(most, seen[number(u, v)]);
        }
      marked_[number(x, y)] = most > kUneven * least ? 1 : 0;
    }
}

}  // namespace vpm
