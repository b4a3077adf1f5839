// Tiles of pixels, each pixel sample with random numbers of its own.
#include "vpm/render/image_pass.h"

#include "vpm/base/parallel.h"
#include "vpm/base/stopwatch.h"

namespace vpm {
namespace {

constexpr int kTile = 16;  // pixels along an edge; a tile is a chunk of parallel work

/// What the rays of a tile share.
struct TileWork {
  EyeCounters& counters;
  EyeScratch scratch;
};

KernelEstimate render_pixel(const Scene& scene, const RenderSettings& settings, int pass, const RayRadiance& radiance,
                            const glm::ivec2& pixel, TileWork& tile) {
  const Camera& camera = scene.camera;
  const int samples = settings.samples_per_pixel;
  const size_t number = static_cast<size_t>(pixel.y) * camera.width + pixel.x;
  return mean_of_samples(samples, tile.counters, [&](int s) {
    Rng rng(settings.seed, rng_stream(RngUse::pixel, static_cast<uint64_t>(pass)), number * samples + s);
    const Vec2 film = Vec2(pixel) + 0.5f + sample_filter(camera.filter, rng.uniform2());
    EyeWork work{rng, tile.counters, tile.scratch, number};
    return radiance(camera.ray(film), work);
  });
}

}  // namespace

uint64_t tile_count(const Camera& camera) {
  return chunk_count(static_cast<size_t>(camera.width), kTile) * chunk_count(static_cast<size_t>(camera.height), kTile);
}

Pass render_image(const Scene& scene, const RenderSettings& settings, int pass, const RayRadiance& radiance,
                  const std::atomic<bool>& stop, const PassProgress& progress) {
  const Stopwatch rendering;
  const Camera& camera = scene.camera;
  Pass result(camera.width, camera.height);
  result.statistics.passes = 1;
  const int tiles_x = static_cast<int>(chunk_count(static_cast<size_t>(camera.width), kTile));
  const uint64_t tiles = tile_count(camera);
  std::vector<EyeCounters> counters(tiles);
  Progress bar("image", tiles, progress.stages);
  parallel_for_chunks(tiles, 1, [&](size_t tile, size_t, size_t) {
    if (stop) return;
    const int x0 = static_cast<int>(tile % tiles_x) * kTile, y0 = static_cast<int>(tile / tiles_x) * kTile;
    TileWork work{counters[tile], {}};
    for (int y = y0; y < std::min(y0 + kTile, camera.height); ++y)
      for (int x = x0; x < std::min(x0 + kTile, camera.width); ++x)
        result.set(x, y, render_pixel(scene, settings, pass, radiance, {x, y}, work));
    bar.advance();
    if (progress.tiles) progress.tiles->advance();
  });
  for (const EyeCounters& c : counters) result.statistics.eye.merge(c);
  result.statistics.eye_seconds = rendering.seconds();
  return result;
}

}  // namespace vpm
