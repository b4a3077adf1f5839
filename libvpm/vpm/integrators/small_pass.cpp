// Blocks are chunks of parallel work, each with random numbers of its own.
#include "vpm/integrators/small_pass.h"

#include <algorithm>
#include <array>

#include "vpm/base/parallel.h"
#include "vpm/integrators/integrator.h"

namespace vpm {
namespace {

constexpr int kEdge = 8;  // pixels, of a block
constexpr int kAlong = static_cast<int>(kBlocksOfEdge);
static_assert(kEdge * kEdge == kBlockRays && kBlockRays == kEyeRays);

/// Where block number `part` along an edge begins that has so many pixels from `first` on: in the middle of its part.
int begin_of(int part, int first, int pixels) {
  return first + std::clamp((2 * part + 1) * pixels / (2 * kAlong) - kEdge / 2, 0, std::max(0, pixels - kEdge));
}

/// The pixel of the picture at a place in a block.
glm::ivec2 pixel_at(size_t block, const glm::ivec2& place, const PixelRect& rendered) {
  const glm::ivec2 begin{begin_of(static_cast<int>(block) % kAlong, rendered.x0, rendered.width()),
                         begin_of(static_cast<int>(block) / kAlong, rendered.y0, rendered.height())};
  return glm::min(begin + place, glm::ivec2(rendered.x1, rendered.y1) - 1);
}

/// What the rays of a block find, sample by sample of its pixels.
void follow_block(const Scene& scene, const RenderSettings& settings, const RaysOfPass& ready, uint64_t stream,
                  size_t block, std::span<KernelEstimate> found, EyeCounters& counters) {
  PixelSquares squares = PixelSquares::draw(ready.square, Rng(settings.seed, stream, ~static_cast<uint64_t>(block)));
  squares.first = {0, 0};
  const PixelOrder order({0, 0}, {kEdge, kEdge}, squares);
  OrderedRays rays(scene.camera, order, squares.edge, counters);
  const auto place_of = [](const PixelOrder::Item& item) {
    return static_cast<size_t>(item.pixel.y * kEdge + item.pixel.x);
  };
  std::array<SampleMean, kBlockRays> means;
  std::array<size_t, kBlockRays> pixels{};
  for (int sample = 0; sample < settings.samples_per_pixel; ++sample) {
    const auto pixel_of = [&](const PixelOrder::Item& item) {
      return pixel_at(block, item.pixel, scene.camera.rendered());
    };
    const auto rng_of = [&](const PixelOrder::Item& item, size_t) {
      const uint64_t number = (block * kBlockRays + place_of(item)) * settings.samples_per_pixel + sample;
      return Rng(settings.seed, stream, number);
    };
    rays.follow(ready.radiance, pixel_of, rng_of, [&](size_t i, const EyeRay& ray) {
      means[place_of(order.items()[i])].add(ray.radiance, counters);
      pixels[place_of(order.items()[i])] = ray.work.pixel;
    });
  }
  for (size_t i = 0; i < kBlockRays; ++i) {
    found[i] = means[i].mean();
    if (!ready.light_tracing.pixels.empty()) found[i].value += ready.light_tracing.pixels[pixels[i]];
  }
}

}  // namespace

double SmallPass::most_photons() const {
  constexpr double kMostBytes = 1.3e9;
  return kMostBytes / std::max(1.0, bytes / std::max(1.0, photons));
}

SmallPass render_small(const Scene& scene, const RenderSettings& settings, int pass, const Clock& clock) {
  SmallPass small;
  const double begin = clock.seconds();
  const RaysOfPass ready = rays_of_pass(scene, settings, pass);
  const RenderStatistics& s = ready.statistics;
  const double made = clock.seconds();
  if (settings.aimed_photons() > 0) small.aiming = s.caustic_seconds / static_cast<double>(settings.aimed_photons());
  small.making = std::max(0.0, made - begin - s.caustic_seconds);
  small.photons = static_cast<double>(s.ledger.emitted_count);
  small.photon_steps = s.ledger.walk.rays + s.ledger.walk.lookups;
  small.bytes = static_cast<double>(s.photon_map_bytes);
  small.found.resize(kSmallRays);
  std::vector<EyeCounters> counters(kBlocks);
  parallel_for_chunks(kBlocks, 1, [&](size_t block, size_t, size_t) {
    follow_block(scene, settings, ready, rng_stream(RngUse::pilot, 2 + static_cast<uint64_t>(pass)), block,
                 std::span(small.found).subspan(block * kBlockRays, kBlockRays), counters[block]);
  });
  const double end = clock.seconds();
  const PixelRect rendered = scene.camera.rendered();
  small.followed = double{kSmallRays} / (double{1} * rendered.width() * rendered.height());
  small.seeing = (end - made) / small.followed;
  small.taken = end - begin;
  EyeCounters all;
  for (const EyeCounters& each : counters) all.merge(each);
  small.eye_steps = static_cast<double>(all.walk.rays + all.walk.lookups) / small.followed;
  small.gathered_by_ray = static_cast<double>(all.gather.used) / static_cast<double>(all.rays);
  return small;
}

}  // namespace vpm
