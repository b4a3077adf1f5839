// A few small passes that look for that light alone, beside one that looks for all.
#include "vpm/tune/kernel_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "vpm/base/parallel.h"
#include "vpm/base/statistics/moments.h"
#include "vpm/integrators/combined/combined_pass.h"
#include "vpm/integrators/integrator.h"
#include "vpm/tune/eye_blocks.h"
#include "vpm/tune/lost_light.h"
#include "vpm/tune/pilot.h"

namespace vpm {
namespace {

constexpr int kPasses = 4;
constexpr uint64_t kLightPaths = 20'000;  // light sub-paths of a pass, at the most

/// The sum over rays all over the picture of what they find, a mean over channels, W/(m^2 sr), with the light that is
/// traced to their pixels, if any is.
double found_by_rays(const Scene& scene, const RenderSettings& settings, int pass, const RadianceOfRays& radiance,
                     const Image& light_tracing) {
  std::array<double, kEyeBlocks> sums{};
  parallel_for_chunks(kEyeBlocks, 1, [&](size_t block, size_t, size_t) {
    EyeCounters counters;
    EyeScratch scratch;
    RaysOfBlock rays(scene.camera, block, BlockPixels::spread, counters, scratch);
    for (size_t i = 0; i < kRaysOfBlock; ++i)
      rays.add(
          i, Rng(settings.seed, rng_stream(RngUse::pilot, 6 + static_cast<uint64_t>(pass)), block * kRaysOfBlock + i));
    radiance(rays.all());
    for (const EyeRay& ray : rays.all()) {
      Rgb found = ray.radiance.value;
      if (!light_tracing.pixels.empty()) found += light_tracing.pixels[ray.work.pixel];
      if (is_finite(found)) sums[block] += double{mean_channel(found)};
    }
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

}  // namespace

std::optional<KernelLight> kernel_light_of(const Scene& scene, const RenderSettings& settings) {
  const TechniqueSet& techniques = settings.combined.techniques;
  KernelLight found{{}, unhittable_lights(scene), techniques.has(Technique::light_tracing)};
  if (settings.integrator != Integrator::combined || !techniques.has(Technique::connections) || !merges(techniques) ||
      found.lights.empty() || !has_specular_surfaces(scene))
    return std::nullopt;
  const RenderSettings few =
      with_light_paths(pilot_settings(settings, settings.photons_emitted), in_a_hurry(kLightPaths, settings));
  Moments by_kernels, whole;
  for (int pass = 0; pass < kPasses; ++pass) {
    const RaysOfPass all = rays_of_pass(scene, few, pass);
    whole.add(found_by_rays(scene, few, pass, all.radiance, all.light_tracing));
    const CombinedPass alone(scene, few, pass, SoughtLight::by_kernels_alone);
    by_kernels.add(found_by_rays(scene, few, pass, [&](std::span<EyeRay> rays) { alone.radiance(rays); }, {}));
  }
  if (by_kernels.mean() == 0.0 || whole.mean() == 0.0) return std::nullopt;
  const double share = by_kernels.mean() / whole.mean();
  found.share = {share, std::sqrt(by_kernels.variance_of_mean() + share * share * whole.variance_of_mean()) /
                            whole.mean()};  // rather too large: the two have rays in common
  return found;
}

std::string text_of(const KernelLight& found, const std::vector<std::string>& names) {
  return fmt::format(
      "{:.2g} +- {:.1g} of the light is found by kernels alone, and has their bias with nothing to check it by: no ray "
      "hits the {}, and mirrors or glass stand wherever {}",
      found.share.value, found.share.standard_error, text_of_lights(found.lights, names),
      found.traced
          ? "the rest of the path could be connected"
          : "the techniques in use could connect the rest of the path: \"light-tracing\" among them would also "
            "connect what the eye sees straight to the camera");
}

}  // namespace vpm
