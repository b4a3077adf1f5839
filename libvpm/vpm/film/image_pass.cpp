// Tiles of pixels, each pixel sample with random numbers of its own.
#include "vpm/film/image_pass.h"

#include <algorithm>
#include <vector>

#include "vpm/base/clock.h"
#include "vpm/base/parallel.h"
#include "vpm/film/pixel_squares.h"
#include "vpm/film/view_layers.h"

namespace vpm {
namespace {

constexpr int kTile = PixelSquares::kTile;

/// What all tiles of a pass have.
struct ImagePass {
  const Scene& scene;
  const PassSettings& settings;
  int number;
  const RadianceOfRays& radiance;
  PixelSquares squares;
  PixelRect shown;
  ViewSums& views;
  Pass& result;
};

/// The tile of squares at a corner. What of it is not shown is followed, too: bundles are those of the whole picture.
void render_tile(const ImagePass& pass, const glm::ivec2& corner, EyeCounters& counters) {
  const Camera& camera = pass.scene.camera;
  const PassSettings& settings = pass.settings;
  const PixelOrder order(corner, {camera.width, camera.height}, pass.squares);
  const auto is_shown = [&](const glm::ivec2& p) {
    return p.x >= pass.shown.x0 && p.x < pass.shown.x1 && p.y >= pass.shown.y0 && p.y < pass.shown.y1;
  };
  OrderedRays rays(camera, order, pass.squares.edge, counters);
  std::vector<SampleMean> means(order.items().size());
  for (int sample = 0; sample < settings.samples_per_pixel; ++sample) {
    const auto pixel_of = [](const PixelOrder::Item& item) { return item.pixel; };
    const auto rng_of = [&](const PixelOrder::Item&, size_t pixel) {
      return Rng(settings.seed, rng_stream(RngUse::pixel, static_cast<uint64_t>(pass.number)),
                 pixel * settings.samples_per_pixel + sample);
    };
    rays.follow(pass.radiance, pixel_of, rng_of, [&](size_t i, const EyeRay& ray) {
      if (!is_shown(order.items()[i].pixel)) return;
      means[i].add(ray.radiance, counters);
      if (!settings.layers.empty()) pass.views.add(ray.work.pixel, view_along(pass.scene, ray.ray));
    });
  }
  for (size_t i = 0; i < means.size(); ++i) {
    const glm::ivec2 pixel = order.items()[i].pixel;
    if (is_shown(pixel)) pass.result.set(pixel.x, pixel.y, means[i].mean());
  }
}

}  // namespace

PixelRect rendered_in_tiles(const Camera& camera) {
  const PixelRect asked = camera.rendered();
  const auto end = [](int pixel, int most) { return std::min((pixel + kTile - 1) / kTile * kTile, most); };
  return {asked.x0 / kTile * kTile, asked.y0 / kTile * kTile, end(asked.x1, camera.width),
          end(asked.y1, camera.height)};
}

uint64_t tile_count(const Camera& camera) {
  const PixelRect pixels = rendered_in_tiles(camera);
  const auto tiles = [](int length) { return static_cast<uint64_t>((length + kTile - 1) / kTile); };
  return tiles(pixels.width()) * tiles(pixels.height());
}

Pass render_image(const Scene& scene, const PassSettings& settings, int pass, const RadianceOfRays& radiance,
                  const PassProgress& progress, int square) {
  const Stopwatch rendering;
  const Camera& camera = scene.camera;
  Pass result(camera.width, camera.height);
  result.statistics.passes = 1;
  ViewSums views(settings.layers, camera.width, camera.height);
  const Rng of_squares(settings.seed, rng_stream(RngUse::square, static_cast<uint64_t>(pass)), 0);
  const ImagePass image{
      scene, settings, pass, radiance, PixelSquares::draw(square, of_squares), rendered_in_tiles(camera),
      views, result};
  const std::vector<glm::ivec2> tiles = image.squares.tiles_in(image.shown);
  const uint64_t foreseen = tile_count(camera);  // squares that begin before the picture may make more
  std::vector<EyeCounters> counters(tiles.size());
  Progress bar("image", foreseen, progress.stages);
  parallel_for_chunks(tiles.size(), 1, [&](size_t tile, size_t, size_t) {
    render_tile(image, tiles[tile], counters[tile]);
    if (tile >= foreseen) return;
    bar.advance();
    if (progress.tiles) progress.tiles->advance();
  });
  for (const EyeCounters& c : counters) result.statistics.eye.merge(c);
  result.layers = views.means(settings.samples_per_pixel);
  result.statistics.eye_seconds = rendering.seconds();
  return result;
}

}  // namespace vpm
