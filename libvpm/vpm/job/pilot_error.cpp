// Differences between passes and between rays of a pass tell the noise of photons and that of rays; products of
// corrections of different passes tell bias. Ways to render tell of each other what they have not seen.
#include "vpm/job/pilot_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "vpm/base/parallel.h"
#include "vpm/base/progress.h"
#include "vpm/estimate/radius_schedule.h"
#include "vpm/image/metrics.h"
#include "vpm/job/eye_blocks.h"
#include "vpm/job/pilot.h"
#include "vpm/job/rays_of_pass.h"

namespace vpm {
namespace {

constexpr int kSmallPasses = 4;

/// What two rays through the same place find in a pass.
using Twins = std::array<KernelEstimate, 2>;
using FoundByPass = std::vector<std::vector<Twins>>;  // block by block

struct SmallPasses {
  RenderSettings settings;
  double share = 1.0;          // of the photons of a whole pass
  size_t rays = kRaysOfBlock;  // of each block, and as many twins
};

/// Half of the time is for photons, half for rays.
SmallPasses plan_small(const Scene& scene, const RenderSettings& settings, const PassCost& cost, double seconds) {
  constexpr double kFewest = 1000.0;  // photons
  const double half = 0.5 * seconds / kSmallPasses, photons = photons_of_pass(settings, cost.stored_per_photon);
  const double all_rays = double(scene.camera.width) * scene.camera.height * settings.samples_per_pixel;
  const double affordable = half / (cost.eye / all_rays * double{2 * kEyeBlocks});
  SmallPasses small{settings};
  const double all_photons = cost.photon * photons + cost.caustics;  // s
  if (all_photons > 0.0) small.share = std::clamp(half / all_photons, std::min(1.0, kFewest / photons), 1.0);
  small.rays = static_cast<size_t>(std::clamp(affordable, 1.0, double{kRaysOfBlock}));
  small.settings.seed = ~settings.seed;
  small.settings.radii = RadiusSchedule::constant;
  const auto part = [&](double count) { return static_cast<uint64_t>(std::ceil(small.share * count)); };
  small.settings.photons_emitted = part(photons);
  small.settings.photons_stored = 0;
  small.settings.caustics_emitted = part(static_cast<double>(settings.caustics_emitted));
  small.settings.guide.importons = part(static_cast<double>(settings.guide.importons));
  small.settings.flights = part(static_cast<double>(settings.flights));
  small.settings.planes = part(static_cast<double>(settings.planes));
  return small;
}

/// What a ray finds, with the light that is traced to its pixel; black where that is no number.
KernelEstimate found_by(const EyeRay& ray, const Image& light_tracing) {
  EyeCounters counters;
  KernelEstimate found = mean_of_samples(1, counters, [&](int) { return ray.radiance; });
  if (!light_tracing.pixels.empty()) found.value += light_tracing.pixels[ray.work.pixel];
  return found;
}

std::vector<Twins> render_small(const Scene& scene, const SmallPasses& small, int pass) {
  const RaysOfPass ready = rays_of_pass(scene, small.settings, pass);
  std::vector<Twins> found(kEyeBlocks * small.rays);
  parallel_for_chunks(kEyeBlocks, 1, [&](size_t block, size_t, size_t) {
    EyeCounters counters;
    EyeScratch scratch;
    RaysOfBlock rays(scene.camera, block, counters, scratch);
    for (size_t i = 0; i < small.rays; ++i)
      rays.add(
          i * kRaysOfBlock / small.rays,
          Rng(small.settings.seed, rng_stream(RngUse::pilot, 2 + static_cast<uint64_t>(pass)), block * small.rays + i));
    for (size_t twin = 0; twin < 2; ++twin) {
      ready.radiance(rays.all());
      for (size_t i = 0; i < small.rays; ++i)
        found[block * small.rays + i][twin] = found_by(rays.all()[i], ready.light_tracing);
    }
  });
  return found;
}

/// The mean of a channel over the places from `begin` to `end`.
double mean_among(const FoundByPass& found, size_t begin, size_t end, int channel) {
  double sum = 0.0;
  for (const std::vector<Twins>& pass : found)
    for (size_t i = begin; i < end; ++i) sum += double{pass[i][0].value[channel]} + double{pass[i][1].value[channel]};
  return sum / static_cast<double>(2 * found.size() * (end - begin));
}

/// Adds unbiased estimates of one place. Rays differ between twins, photons between passes: what twins have in common
/// is due to photons.
void add_place(const FoundByPass& found, size_t place, int channel, double scale, PassError& sum) {
  const auto n = static_cast<double>(found.size());
  double a = 0.0, b = 0.0, products = 0.0, differences2 = 0.0, corrections = 0.0, corrections2 = 0.0;
  for (const std::vector<Twins>& pass : found) {
    const auto& [first, second] = pass[place];
    const double x = double{first.value[channel]}, y = double{second.value[channel]};
    const double correction = 0.5 * (double{first.correction[channel]} + double{second.correction[channel]});
    a += x;
    b += y;
    products += x * y;
    differences2 += (x - y) * (x - y);
    corrections += correction;
    corrections2 += correction * correction;
  }
  sum.rays += 0.5 * differences2 / n / scale;
  sum.photons += (products - a * b / n) / (n - 1.0) / scale;
  sum.bias2 += (corrections * corrections - corrections2) / (n * (n - 1.0)) / scale;
}

/// What passes show in a channel of the places from `begin` to `end`. The standard error is no less than that of rays
/// alone: a few passes are spread by chance.
SeenInBlock seen_in_block(const FoundByPass& found, size_t begin, size_t end, int channel) {
  const auto passes = static_cast<double>(found.size()), places = static_cast<double>(end - begin);
  SeenInBlock seen;
  seen.mean = mean_among(found, begin, end, channel);
  double between = 0.0, within = 0.0;
  for (const std::vector<Twins>& pass : found) {
    double mean = 0.0;
    for (size_t i = begin; i < end; ++i) {
      const auto& [first, second] = pass[i];
      const double difference = double{first.value[channel]} - double{second.value[channel]};
      mean += 0.5 * (double{first.value[channel]} + double{second.value[channel]}) / places;
      within += 0.25 * difference * difference;
      seen.correction += 0.5 * (double{first.correction[channel]} + double{second.correction[channel]});
    }
    between += (mean - seen.mean) * (mean - seen.mean);
  }
  seen.correction /= passes * places;
  const double of_rays = within / (passes * passes * places * places);
  seen.standard_error = std::sqrt(std::max(between / (passes * (passes - 1.0)), of_rays));
  return seen;
}

/// Relative to the means of blocks, as single values are noisy.
PilotError relative_errors(const FoundByPass& found, size_t rays) {
  PilotError error{.seen = std::vector<SeenInBlock>(3 * kEyeBlocks),
                   .rays = static_cast<double>(2 * found.size() * rays)};
  PassError sum;
  for (int channel = 0; channel < 3; ++channel) {
    const double mean = mean_among(found, 0, kEyeBlocks * rays, channel);
    if (mean == 0.0) continue;
    for (size_t block = 0; block < kEyeBlocks; ++block) {
      const size_t begin = block * rays, end = begin + rays;
      SeenInBlock& seen = error.seen[static_cast<size_t>(channel) * kEyeBlocks + block];
      seen = seen_in_block(found, begin, end, channel);
      const double scale = relative_scale(seen.mean, mean);
      for (size_t i = begin; i < end; ++i) add_place(found, i, channel, scale, sum);
    }
  }
  const double each = 1.0 / static_cast<double>(3 * kEyeBlocks * rays);
  error.pass = {each * sum.rays, each * std::max(0.0, sum.photons), each * std::max(0.0, sum.bias2)};
  return error;
}

}  // namespace

PilotError error_of_pass(const Scene& scene, const RenderSettings& settings, const PassCost& cost, double seconds) {
  const SmallPasses small = plan_small(scene, settings, cost, seconds);
  FoundByPass found;
  for (int pass = 0; pass < kSmallPasses; ++pass) found.push_back(render_small(scene, small, pass));
  PilotError error = relative_errors(found, small.rays);
  error.pass.rays /= settings.samples_per_pixel;
  error.pass.photons *= small.share;
  return error;
}

double unseen_light(const PilotError& error, const PilotError& other) {
  constexpr double kSure = 4.0;  // standard errors
  double sum = 0.0;
  for (size_t channel = 0; channel < 3; ++channel) {
    const auto begin = other.seen.begin() + static_cast<std::ptrdiff_t>(channel * kEyeBlocks);
    double mean = 0.0;
    for (auto of = begin; of != begin + kEyeBlocks; ++of) mean += of->mean / double{kEyeBlocks};
    if (mean <= 0.0) continue;
    for (size_t i = channel * kEyeBlocks; i < (channel + 1) * kEyeBlocks; ++i) {
      const SeenInBlock &own = error.seen[i], &there = other.seen[i];
      const double least = there.mean - kSure * there.standard_error - 2.0 * std::abs(there.correction);
      const double missing = std::max(0.0, least - own.mean - kSure * own.standard_error);
      sum += error.rays * missing * missing / relative_scale(there.mean, mean);
    }
  }
  return sum / double{3 * kEyeBlocks};
}

double error_after(const PassError& error, const RenderSettings& settings, int passes) {
  constexpr int kDimension = 2;
  const int order = kernel_order(settings.volume.kernel);
  double noise = 0.0, bias = 0.0;  // summed over passes, relative to those of the first
  for (int pass = 0; pass < passes; ++pass) {
    const bool shrinks = settings.radii != RadiusSchedule::constant;
    const double measure = shrinks ? measure_of_pass(best_a(kDimension, order), pass) : 1.0;
    noise += 1.0 / measure;
    bias += std::pow(measure, double(order) / kDimension);
  }
  const double n = passes;
  return error.rays / n + error.photons * noise / (n * n) + error.bias2 * (bias / n) * (bias / n);
}

}  // namespace vpm
