// What runs, how, and what does not and why.
#include "stage_lines.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vpm::tools {
namespace {

/// A strategy or an estimator with what its list says of it: "regular (exact in any medium: ...)", "ray-march (biased;
/// ...)".
template <class Info>
std::string described(const std::string& name, std::span<const Info> infos) {
  for (const Info& info : infos)
    if (info.name == name) return fmt::format("{} ({}{})", name, info.unbiased ? "" : "biased; ", info.summary);
  return name;
}

/// What importance is for.
std::string guided(const GuideSettings& guide) {
  std::vector<std::string> ways;
  if (guide.aim) ways.push_back("aimed");
  if (guide.split) ways.push_back("split");
  if (guide.scatter) ways.push_back("scattered");
  return ways.empty() ? "left as they are" : fmt::format("{} by importance", fmt::join(ways, ", "));
}

}  // namespace

std::vector<std::string> stage_lines(const Scene& scene, const RenderSettings& settings, const Stages& stages) {
  const bool scatters = plan_stages(scene, settings).volume_map;
  const std::string no_medium = scene.media.empty() ? "no medium"
                                : scatters          ? "a light map shows no medium"
                                                    : "no medium scatters";
  const auto line = [](bool runs, const std::string& what, const std::string& how, const std::string& why_not) {
    return runs ? "runs " + what + how : "skips " + what + ": " + why_not;
  };
  const std::string distances = ", distances by " + described(settings.distance.strategy, distance_strategies());
  const std::string transmittance =
      ", transmittance by " + described(settings.transmittance.estimator, transmittance_estimators());
  bool grids = false;
  for (const Medium& medium : scene.media) grids |= !medium.homogeneous();
  const std::string no_gathering = stages.surface_map ? "indirect light comes from the photon map" : "no rough surface";
  const std::string channels = scene.grey ? "all coefficients are grey" : "coefficients differ between channels";
  if (settings.integrator == Integrator::path)
    return {line(true, "path tracing", distances + transmittance, ""),
            line(false, "photon tracing and maps", "", "the integrator is the path tracer"), channels};
  const auto corrected = [](const GatherSettings& gather) { return gather.boundary == BoundaryRule::corrected; };
  return {line(stages.photons(), "photon tracing", distances, "nothing stores photons"),
          line(stages.photons() && settings.guide.importons > 0, "importons", ": photons are " + guided(settings.guide),
               stages.photons() ? "photons go where power does" : "nothing stores photons"),
          line(stages.volume_map, "volume photon map", stages.beams ? ", gathered from along rays" : "", no_medium),
          line(stages.surface_map, "surface photon map", "", "no rough surface"),
          line(stages.pixel_discs, "radii of pixels' own", ", on surfaces",
               stages.surface_map ? "radii do not depend on what pixels find" : "no rough surface"),
          line(stages.volume_map && corrected(settings.volume), "corrections at borders of media", "",
               stages.volume_map ? "whole balls are summed over" : no_medium),
          line(stages.surface_map && corrected(settings.surface), "corrections at edges of surfaces", "",
               stages.surface_map ? "whole discs are summed over" : "no rough surface"),
          line(stages.volume_shadow_rays, "shadow rays in media",
               transmittance + (stages.equiangular ? ", from distances drawn equiangularly" : ""),
               stages.volume_map ? "single scattering comes from the photon map" : no_medium),
          line(stages.surface_shadow_rays, "shadow rays at surfaces", transmittance,
               stages.surface_map ? "direct light comes from the photon map" : "no rough surface"),
          line(stages.final_gather, "final gathering and a caustic map",
               fmt::format(", {} rays at a point", settings.gather_rays), no_gathering),
          line(stages.guided_gather, "a photon map to guide its rays", "",
               stages.final_gather ? "materials draw them" : no_gathering),
          line(stages.irradiance_points, "irradiance computed beforehand for their ends", "",
               stages.final_gather ? "they ask the photon map" : no_gathering),
          line(grids, "grid look-ups", "", "all media are homogeneous"),
          channels};
}

}  // namespace vpm::tools
