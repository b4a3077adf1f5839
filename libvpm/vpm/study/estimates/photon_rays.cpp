// Passes of photons, and rays that look at them.
#include "vpm/study/estimates/photon_rays.h"

#include "vpm/base/parallel.h"
#include "vpm/integrators/photon_map/eye_path.h"
#include "vpm/integrators/photon_map/photon_pass.h"

namespace vpm {
namespace {

/// What the rays of one pass find through kernels of that radius, m.
std::vector<double> look_at_pass(const Scene& scene, const PhotonRays& by, int pass, double radius,
                                 const LookAlongRays& look) {
  RenderSettings settings;
  settings.seed = by.seed;
  settings.photons.emitted = by.photons;
  settings.max_events = by.max_events;
  settings.radii = RadiusSchedule::constant;
  settings.volume.choose(by.type);
  settings.volume.radius = static_cast<float>(radius);
  const Estimators estimators = plan_estimators(scene, settings, pass);
  RenderStatistics statistics;
  prepare_pass(scene, settings, estimators, {pass}, statistics);
  const EyeContext context{scene, estimators};
  EyeCounters counters;
  EyeScratch scratch;
  Rng rng(by.seed, rng_stream(RngUse::probe, 0), static_cast<uint64_t>(pass)),
      for_rays(by.seed, rng_stream(RngUse::probe, 1), static_cast<uint64_t>(pass));
  EyeWork work{rng, counters, scratch};
  return look([&](const Ray& ray) { return double{eye_radiance(context, ray, work).value.g}; }, for_rays);
}

}  // namespace

std::vector<RadianceByPhotons> estimate_along_rays(const Scene& scene, const PhotonRays& by,
                                                   const LookAlongRays& look) {
  std::vector<std::vector<double>> wide(static_cast<size_t>(by.passes)), narrow(wide.size());
  parallel_for_chunks(wide.size(), 1, [&](size_t i, size_t, size_t) {
    // Both radii have the same photons and rays: their noise is not added up.
    wide[i] = look_at_pass(scene, by, static_cast<int>(i), by.radius, look);
    narrow[i] = look_at_pass(scene, by, static_cast<int>(i), 0.5 * by.radius, look);
  });
  std::vector<RadianceByPhotons> result(wide.front().size());
  for (size_t i = 0; i < wide.size(); ++i)
    for (size_t k = 0; k < result.size(); ++k) {
      result[k].wide.add(wide[i][k]);
      result[k].narrow.add(narrow[i][k]);
      result[k].unbiased.add((4.0 * narrow[i][k] - wide[i][k]) / 3.0);
    }
  return result;
}

}  // namespace vpm
