// Tiles of pixels, each pixel sample with random numbers of its own.
#include "vpm/film/image_pass.h"

#include <array>
#include <vector>

#include "vpm/base/clock.h"
#include "vpm/base/parallel.h"
#include "vpm/film/view_layers.h"

namespace vpm {
namespace {

constexpr int kTile = 16;      // pixels along an edge; a tile is a chunk of parallel work
constexpr int kBlockEdge = 8;  // of pixels whose rays are followed together
static_assert(kBlockEdge * kBlockEdge == kEyeRays && kTile % kBlockEdge == 0);

/// A rectangle of pixels, without `end`, in an order in which kBlock after kBlock lie side by side.
class PixelBlock {
 public:
  PixelBlock(const glm::ivec2& begin, const glm::ivec2& end) {
    constexpr int kSquare = 4;  // pixels along an edge
    static_assert(kSquare * kSquare == kBlock);
    for (int y = begin.y; y < end.y; y += kSquare)
      for (int x = begin.x; x < end.x; x += kSquare) add({x, y}, glm::min(glm::ivec2(x, y) + kSquare, end));
  }
  std::span<const glm::ivec2> pixels() const { return {pixels_.data(), size_}; }

 private:
  void add(const glm::ivec2& begin, const glm::ivec2& end) {
    for (int y = begin.y; y < end.y; ++y)
      for (int x = begin.x; x < end.x; ++x) pixels_[size_++] = {x, y};
  }

  std::array<glm::ivec2, kEyeRays> pixels_;
  size_t size_ = 0;
};

/// The tiles that meet the pixels which are rendered, counted as pixels are.
PixelRect tiles_of(const Camera& camera) {
  const PixelRect pixels = camera.rendered();
  const auto end = [](int pixel) { return (pixel + kTile - 1) / kTile; };
  return {pixels.x0 / kTile, pixels.y0 / kTile, end(pixels.x1), end(pixels.y1)};
}

/// What the rays of a tile share.
struct TileWork {
  EyeCounters& counters;
  EyeScratch scratch;
  std::vector<Rng> rngs{};  // of the rays of a block
  std::vector<EyeRay> rays{};
};

/// One sample of each pixel of a block.
void sample_block(const Scene& scene, const PassSettings& settings, int pass, const RadianceOfRays& radiance,
                  const PixelBlock& block, int sample, TileWork& tile) {
  const Camera& camera = scene.camera;
  const int samples = settings.samples_per_pixel;
  tile.rays.clear();
  tile.rngs.clear();
  tile.rngs.reserve(kEyeRays);
  for (const glm::ivec2& pixel : block.pixels()) {
    const size_t number = static_cast<size_t>(pixel.y) * camera.width + pixel.x;
    Rng& rng = tile.rngs.emplace_back(settings.seed, rng_stream(RngUse::pixel, static_cast<uint64_t>(pass)),
                                      number * samples + sample);
    const Vec2 film = Vec2(pixel) + 0.5f + sample_filter(camera.filter, rng.uniform2());
    tile.rays.push_back({camera.ray(film), {rng, tile.counters, tile.scratch, number}});
  }
  radiance(tile.rays);
}

void render_block(const Scene& scene, const PassSettings& settings, const RadianceOfRays& radiance,
                  const PixelBlock& block, TileWork& tile, int number, Pass& pass) {
  std::array<SampleMean, kEyeRays> means;
  for (int sample = 0; sample < settings.samples_per_pixel; ++sample) {
    sample_block(scene, settings, number, radiance, block, sample, tile);
    for (size_t i = 0; i < tile.rays.size(); ++i) means[i].add(tile.rays[i].radiance, tile.counters);
  }
  for (size_t i = 0; i < block.pixels().size(); ++i)
    pass.set(block.pixels()[i].x, block.pixels()[i].y, means[i].mean());
}

}  // namespace

uint64_t tile_count(const Camera& camera) {
  const PixelRect tiles = tiles_of(camera);
  return static_cast<uint64_t>(tiles.width()) * static_cast<uint64_t>(tiles.height());
}

Pass render_image(const Scene& scene, const PassSettings& settings, int pass, const RadianceOfRays& radiance,
                  const PassProgress& progress) {
  const Stopwatch rendering;
  const Camera& camera = scene.camera;
  Pass result(camera.width, camera.height);
  result.statistics.passes = 1;
  ViewSums views(settings.layers, camera.width, camera.height);
  const RadianceOfRays estimated = settings.layers.empty() ? radiance : [&](std::span<EyeRay> rays) {
    for (const EyeRay& each : rays) views.add(each.work.pixel, view_along(scene, each.ray));
    radiance(rays);
  };
  const PixelRect tiled = tiles_of(camera);
  const uint64_t tiles = tile_count(camera);
  std::vector<EyeCounters> counters(tiles);
  Progress bar("image", tiles, progress.stages);
  parallel_for_chunks(tiles, 1, [&](size_t tile, size_t, size_t) {
    const auto across = static_cast<size_t>(tiled.width());
    const int x0 = (tiled.x0 + static_cast<int>(tile % across)) * kTile;
    const int y0 = (tiled.y0 + static_cast<int>(tile / across)) * kTile;
    TileWork work{counters[tile], {}};
    const glm::ivec2 end = glm::min(glm::ivec2(x0, y0) + kTile, glm::ivec2(camera.width, camera.height));
    for (int y = y0; y < end.y; y += kBlockEdge)
      for (int x = x0; x < end.x; x += kBlockEdge) {
        const PixelBlock block({x, y}, glm::min(glm::ivec2(x, y) + kBlockEdge, end));
        render_block(scene, settings, estimated, block, work, pass, result);
      }
    bar.advance();
    if (progress.tiles) progress.tiles->advance();
  });
  for (const EyeCounters& c : counters) result.statistics.eye.merge(c);
  result.layers = views.means(settings.samples_per_pixel);
  result.statistics.eye_seconds = rendering.seconds();
  return result;
}

}  // namespace vpm
