// What runs, how, and what does not and why.
#include "vpm/job/stage_lines.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "vpm/integrators/photon_map/photon_blocks.h"
#include "vpm/integrators/photon_map/volume/estimators.h"

namespace vpm {
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

std::vector<std::string> stages_of_combined(const RenderSettings& settings, const std::string& distances,
                                            const std::string& channels) {
  std::vector<std::string> lines{"runs sub-paths from the lights and from the eye" + distances};
  for (const TechniqueInfo& info : kTechniques)
    lines.push_back(fmt::format("{} {}: {}", settings.combined.techniques.has(info.technique) ? "runs" : "skips",
                                info.name, info.summary));
  lines.push_back(channels);
  return lines;
}

}  // namespace

std::vector<std::string> stage_lines(const Scene& scene, const RenderSettings& settings, const Scattering& shown) {
  const auto [media, surfaces] = shown;
  const std::string no_medium = scene.media.empty()          ? "no medium"
                                : scattering_of(scene).media ? "a light map shows no medium"
                                                             : "no medium scatters";
  const auto line = [](bool runs, const std::string& what, const std::string& how, const std::string& why_not) {
    return runs ? "runs " + what + how : "skips " + what + ": " + why_not;
  };
  const std::string distances = ", distances by " + described(settings.distance.strategy, distance_strategies());
  const std::string transmittance =
      ", transmittance by " + described(settings.transmittance.estimator, transmittance_estimators());
  bool grids = false;
  for (const Medium& medium : scene.media) grids |= !medium.homogeneous();
  const std::string no_gathering = surfaces ? "indirect light comes from the photon map" : "no rough surface";
  const std::string channels = scene.grey ? "all coefficients are grey" : "coefficients differ between channels";
  if (settings.integrator == Integrator::path)
    return {line(true, "path tracing", distances + transmittance, ""),
            line(false, "photon tracing and maps", "", "the integrator is the path tracer"), channels};
  if (settings.integrator == Integrator::combined) return stages_of_combined(settings, distances, channels);
  const VolumeEstimatorInfo& volume = settings.volume.info();
  const bool beams = volume.flights;
  const bool photons = media || surfaces,
             gathers = surfaces && settings.surface_indirect == IndirectLight::final_gather;
  const auto corrected = [](const AskedGather& gather) { return gather.boundary == BoundaryRule::corrected; };
  const uint64_t blocks = block_count(settings);
  const std::string by_blocks = blocks > 1 ? fmt::format(", in {} blocks, each gathered by itself", blocks) : "";
  return {line(photons, "photon tracing", distances + by_blocks, "nothing stores photons"),
          line(photons && settings.guide.importons > 0, "importons", ": photons are " + guided(settings.guide),
               photons ? "photons go where power does" : "nothing stores photons"),
          line(media && volume.collisions, "volume photon map",
               beams               ? ", gathered beside rays that flights run along"
               : volume.along_rays ? ", gathered all along rays"
                                   : "",
               media ? "flights are gathered, not collisions" : no_medium),
          line(media && beams, "photon beams",
               std::string(volume.along_rays ? "" : ", around points of rays") +
                   (settings.volume.length == BeamLength::long_beams ? ", to where media end" : "") +
                   (settings.volume.flights > 0 ? fmt::format(", at most {} in a pass", settings.volume.flights) : ""),
               media ? "collisions are gathered, not flights" : no_medium),
          line(media && volume.planes, "photon planes", fmt::format(", at most {} in a pass", settings.volume.planes),
               media ? "light comes from collisions or beams" : no_medium),
          line(surfaces, "surface photon map", "", "no rough surface"),
          line(surfaces && settings.radii == RadiusSchedule::per_pixel, "radii of pixels' own", ", on surfaces",
               surfaces ? "radii do not depend on what pixels find" : "no rough surface"),
          line(media && settings.volume.boundary != BoundaryRule::none, "corrections at borders of media",
               !volume.along_rays && !beams && settings.volume.corrects_each_ball() ? ", ball by ball"
                                                                                    : ", along segments of eye rays",
               media ? "what lies outside of media is summed over, too" : no_medium),
          line(surfaces && corrected(settings.surface), "corrections at edges of surfaces", "",
               surfaces ? "whole discs are summed over" : "no rough surface"),
          line(media && settings.volume_direct != DirectLight::photons, "shadow rays in media",
               transmittance +
                   (settings.volume_direct == DirectLight::equiangular ? ", from distances drawn equiangularly" : ""),
               media ? "single scattering comes from the photon map" : no_medium),
          line(surfaces && settings.surface_direct == DirectLight::shadow_rays, "shadow rays at surfaces",
               transmittance, surfaces ? "direct light comes from the photon map" : "no rough surface"),
          line(gathers, "final gathering and a caustic map", fmt::format(", {} rays at a point", settings.gather_rays),
               no_gathering),
          line(gathers && settings.gather_by == GatherBy::photons, "a photon map to guide its rays", "",
               gathers ? "materials draw them" : no_gathering),
          line(gathers && settings.end_irradiance == EndIrradiance::precomputed,
               "irradiance computed beforehand for their ends", "", gathers ? "they ask the photon map" : no_gathering),
          line(grids, "grid look-ups", "", "all media are homogeneous"),
          channels};
}

}  // namespace vpm
