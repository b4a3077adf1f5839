// Differences between passes and between rays of a pass measure the noise of photons and that of rays; products of
// corrections of different passes measure bias. What one way to render has not seen, others may show.
#include "vpm/tune/pilot_error.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "vpm/base/parallel.h"
#include "vpm/base/progress.h"
#include "vpm/base/statistics/moments.h"
#include "vpm/estimate/radius_schedule.h"
#include "vpm/image/metrics.h"
#include "vpm/integrators/integrator.h"
#include "vpm/tune/eye_blocks.h"
#include "vpm/tune/pilot.h"

namespace vpm {
namespace {

constexpr int kSmallPasses = 8;

/// What three rays through a pixel find in a pass: two through one place, which is the same in all passes, and one
/// through another such place.
using FoundInPixel = std::array<KernelEstimate, 3>;
using FoundByPass = std::vector<std::vector<FoundInPixel>>;  // block by block

struct SmallPasses {
  RenderSettings settings;
  double share = 1.0;            // of the photons of a whole pass
  uint64_t paths_of_shares = 0;  // as many as the whole pass has: else rays would find more, and photons less
  size_t rays = kRaysOfBlock;    // through each block, thrice; a power of two
};

/// Half of the time is for photons, half for rays.
SmallPasses plan_small(const Scene& scene, const RenderSettings& settings, const PassCost& cost, double seconds) {
  constexpr double kFewest = 1000.0;  // photons
  const double half = 0.5 * seconds / kSmallPasses, photons = photons_of_pass(settings, cost.stored_per_photon);
  const double all_rays = double(scene.camera.width) * scene.camera.height * settings.samples_per_pixel;
  const double affordable = half / (cost.eye / all_rays * double{3 * kEyeBlocks});
  SmallPasses small{settings};
  const double all_photons = cost.photon * photons + cost.caustics;  // s
  if (all_photons > 0.0) small.share = std::clamp(half / all_photons, std::min(1.0, kFewest / photons), 1.0);
  small.rays = std::bit_floor(static_cast<size_t>(std::clamp(affordable, 1.0, double{kRaysOfBlock})));
  small.settings.seed = ~settings.seed;
  small.settings.radii = RadiusSchedule::constant;
  const auto part = [&](double count) { return static_cast<uint64_t>(std::ceil(small.share * count)); };
  small.settings.photons.emitted = part(photons);
  small.paths_of_shares = settings.photons.emitted;
  small.settings.photons.stored = 0;
  small.settings.caustics.emitted = part(static_cast<double>(settings.caustics.emitted));
  small.settings.importance.importons = part(static_cast<double>(settings.importance.importons));
  small.settings.volume.flights = part(static_cast<double>(settings.volume.flights));
  small.settings.volume.planes = part(static_cast<double>(settings.volume.planes));
  return small;
}

/// What a ray finds, with the light that is traced to its pixel; black where that is no number.
KernelEstimate found_by(const EyeRay& ray, const Image& light_tracing) {
  EyeCounters counters;
  KernelEstimate found = mean_of_samples(1, counters, [&](int) { return ray.radiance; });
  if (!light_tracing.pixels.empty()) found.value += light_tracing.pixels[ray.work.pixel];
  return found;
}

std::vector<FoundInPixel> render_small(const Scene& scene, const SmallPasses& small, int pass) {
  const RaysOfPass ready = rays_of_pass(scene, small.settings, pass, small.paths_of_shares);
  const uint64_t of_rays = rng_stream(RngUse::pilot, 2 + static_cast<uint64_t>(pass));
  const uint64_t of_places = rng_stream(RngUse::pilot, 2 + kSmallPasses);
  std::vector<FoundInPixel> found(kEyeBlocks * small.rays);
  parallel_for_chunks(kEyeBlocks, 1, [&](size_t block, size_t, size_t) {
    EyeCounters counters;
    EyeScratch scratch;
    const size_t begin = block * small.rays;
    std::array<RaysOfBlock, 2> rays{{{scene.camera, block, BlockPixels::spread, counters, scratch},
                                     {scene.camera, block, BlockPixels::spread, counters, scratch}}};
    for (size_t i = 0; i < small.rays; ++i) {
      const size_t pixel = i * kRaysOfBlock / small.rays;  // of the block
      for (size_t which = 0; which < 2; ++which) {
        const size_t number = 2 * (block * kRaysOfBlock + pixel) + which;
        const Vec2 place = Rng(small.settings.seed, of_places, number).uniform2();
        rays[which].add(pixel, place, Rng(small.settings.seed, of_rays, number));
      }
    }
    for (const size_t which : {0, 1, 2}) {
      const std::span<EyeRay> all = rays[which / 2].all();
      ready.radiance(all);
      for (size_t i = 0; i < small.rays; ++i) found[begin + i][which] = found_by(all[i], ready.light_tracing);
    }
  });
  return found;
}

/// Both places count alike.
double mean_of(const FoundInPixel& found, int channel) {
  return 0.25 * (double{found[0].value[channel]} + double{found[1].value[channel]}) +
         0.5 * double{found[2].value[channel]};
}

/// The mean of a channel over the pixels from `begin` to `end`.
double mean_among(const FoundByPass& found, size_t begin, size_t end, int channel) {
  double sum = 0.0;
  for (const std::vector<FoundInPixel>& pass : found)
    for (size_t i = begin; i < end; ++i) sum += mean_of(pass[i], channel);
  return sum / static_cast<double>(found.size() * (end - begin));
}

/// Sums over pixels.
struct ErrorSums {
  double rays = 0.0, photons = 0.0, bias2 = 0.0;
};

/// Adds unbiased estimates of one pixel. Rays through one place have their photons in common, and all passes the
/// places.
void add_pixel(const FoundByPass& found, size_t pixel, int channel, double scale, ErrorSums& sum) {
  constexpr double n = kSmallPasses;
  double x = 0.0, y = 0.0, products = 0.0, along = 0.0, apart = 0.0, apart2 = 0.0, corrected = 0.0, corrected2 = 0.0;
  for (size_t pass = 0; pass < kSmallPasses; ++pass) {
    const auto& [first, second, elsewhere] = found[pass][pixel];
    const double one = double{first.value[channel]}, again = double{second.value[channel]};
    const double difference = 0.5 * (one + again) - double{elsewhere.value[channel]};
    x += one;
    y += again;
    products += one * again;
    along += 0.5 * (one - again) * (one - again) / n;
    apart += difference / n;
    apart2 += difference * difference / n;
    const double correction = 0.5 * (double{first.correction[channel]} + double{second.correction[channel]});
    corrected += correction;
    corrected2 += correction * correction;
  }
  const double of_places = 0.5 * (apart * apart - (apart2 - apart * apart) / (n - 1.0));
  sum.rays += (along + of_places) / scale;
  sum.photons += (products - x * y / n) / (n - 1.0) / scale;
  sum.bias2 += (corrected * corrected - corrected2) / (n * (n - 1.0)) / scale;
}

/// What squares of a pixel are divided by: its own mean, but no more than what is surely there of it or `near`, the
/// mean of pixels near it, as a rare bright sample hides its error else. So are those of a film (FilmErrors), which
/// also knows the darkest side of a pixel.
double scale_at(const FoundByPass& found, size_t pixel, int channel, double near, double mean) {
  const double own = std::abs(mean_among(found, pixel, pixel + 1, channel));
  const double n = 3.0 * static_cast<double>(found.size());
  double squares = 0.0;
  for (const std::vector<FoundInPixel>& pass : found)
    for (const KernelEstimate& ray : pass[pixel]) squares += std::pow(std::abs(double{ray.value[channel]}) - own, 2.0);
  const double surely = own - std::sqrt(squares / (n * (n - 1.0)));
  return relative_scale(std::max(surely, std::min(own, std::abs(near))), mean);
}

/// Adds the pixels from `begin` to `end`, up to kBlock of which lie near each other.
void add_pixels(const FoundByPass& found, size_t begin, size_t end, int channel, double mean, ErrorSums& sum) {
  for (size_t first = begin; first < end; first += kBlock) {
    const size_t last = std::min(end, first + kBlock);
    const double near = mean_among(found, first, last, channel);
    for (size_t i = first; i < last; ++i) add_pixel(found, i, channel, scale_at(found, i, channel, near, mean), sum);
  }
}

PassError relative_errors(const FoundByPass& found, size_t rays) {
  ErrorSums sum;
  for (int channel = 0; channel < 3; ++channel) {
    const double mean = mean_among(found, 0, kEyeBlocks * rays, channel);
    if (mean == 0.0) continue;
    for (size_t block = 0; block < kEyeBlocks; ++block)
      add_pixels(found, block * rays, (block + 1) * rays, channel, mean, sum);
  }
  const double each = 1.0 / static_cast<double>(3 * kEyeBlocks * rays);
  return {each * std::max(0.0, sum.rays), each * std::max(0.0, sum.photons), each * std::max(0.0, sum.bias2)};
}

/// What it is that pixels show, for unseen_light().
void keep_what_is_shown(const FoundByPass& found, PilotError& error) {
  error.corrections.assign(found.front().size(), Rgb(0.0f));
  for (const std::vector<FoundInPixel>& pass : found) {
    std::vector<Rgb>& light = error.shown.emplace_back();
    for (size_t i = 0; i < pass.size(); ++i) {
      const auto& [first, second, elsewhere] = pass[i];
      light.push_back(0.25f * (first.value + second.value) + 0.5f * elsewhere.value);
      error.corrections[i] += 0.5f / float(kSmallPasses) * (first.correction + elsewhere.correction);
    }
  }
}

/// What a channel shows in blocks, each of the same pixels.
struct SeenMean {
  double mean = 0.0, standard_error = 0.0, correction = 0.0;
};
SeenMean seen_in(const PilotError& error, size_t first_block, size_t last_block, size_t pixels, int channel) {
  const size_t step = error.pixels / pixels;
  const double each = 1.0 / static_cast<double>((last_block - first_block) * pixels);
  const auto mean_of_light = [&](const std::vector<Rgb>& light) {
    double sum = 0.0;
    for (size_t i = first_block * error.pixels; i < last_block * error.pixels; i += step)
      sum += double{light[i][channel]};
    return each * sum;
  };
  Moments moments;
  for (const std::vector<Rgb>& pass : error.shown) moments.add(mean_of_light(pass));
  return {moments.mean(), std::sqrt(moments.variance_of_mean()), mean_of_light(error.corrections)};
}

/// The relative square of the light that `other` surely shows and `own` does not; `mean` of the picture.
double unseen_square(const SeenMean& own, const SeenMean& other, double mean) {
  constexpr double kSure = 4.0;  // standard errors
  const double least = other.mean - kSure * other.standard_error - 2.0 * std::abs(other.correction);
  const double missing = std::max(0.0, least - own.mean - kSure * own.standard_error);
  return missing * missing / relative_scale(other.mean, mean);
}

}  // namespace

PilotError error_of_pass(const Scene& scene, const RenderSettings& settings, const PassCost& cost, double seconds) {
  const SmallPasses small = plan_small(scene, settings, cost, seconds);
  FoundByPass found;
  for (int pass = 0; pass < kSmallPasses; ++pass) found.push_back(render_small(scene, small, pass));
  PilotError error{.pass = relative_errors(found, small.rays), .pixels = small.rays};
  error.pass.rays /= settings.samples_per_pixel;
  error.pass.photons *= small.share;
  keep_what_is_shown(found, error);
  return error;
}

double unseen_light(const PilotError& error, const PilotError& other) {
  const size_t pixels = std::min(error.pixels, other.pixels);  // of a block, that both have
  const auto rays = static_cast<double>(3 * error.shown.size() * error.pixels);
  double sum = 0.0;
  for (int channel = 0; channel < 3; ++channel) {
    const SeenMean all = seen_in(other, 0, kEyeBlocks, pixels, channel);
    if (all.mean <= 0.0) continue;
    double in_blocks = 0.0;
    for (size_t block = 0; block < kEyeBlocks; ++block)
      in_blocks += unseen_square(seen_in(error, block, block + 1, pixels, channel),
                                 seen_in(other, block, block + 1, pixels, channel), all.mean);
    const double in_all = unseen_square(seen_in(error, 0, kEyeBlocks, pixels, channel), all, all.mean);
    sum += rays * std::max(in_blocks / double{kEyeBlocks}, in_all * double{kEyeBlocks});
  }
  return sum / 3.0;
}

double error_after(const PassError& error, const RenderSettings& settings, int passes) {
  constexpr int kDimension = 2;
  const int order = kernel_order(settings.volume.kernel);
  double noise = 0.0, bias = 0.0;  // summed over passes, relative to those of the first
  for (int pass = 0; pass < passes; ++pass) {
    const bool shrinks = settings.radii != RadiusSchedule::constant;
    const double measure = shrinks ? measure_of_pass(best_a(kDimension, order), pass) : 1.0;
    noise += 1.0 / measure;
    bias += std::pow(measure, 0.5 * kPowerOfBias / kDimension);
  }
  const double n = passes;
  return error.rays / n + error.photons * noise / (n * n) + error.bias2 * (bias / n) * (bias / n);
}

}  // namespace vpm
