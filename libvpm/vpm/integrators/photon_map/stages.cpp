// Which stages of photon maps run, how, and which do not and why.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "vpm/integrators/photon_map/integrator.h"
#include "vpm/integrators/photon_map/photon_blocks.h"
#include "vpm/integrators/photon_map/volume/estimator_info.h"
#include "vpm/integrators/stages.h"

namespace vpm {
namespace {

/// What importance is for.
std::string guided(const GuideSettings& guide) {
  std::vector<std::string> ways;
  if (guide.aim) ways.push_back("aimed");
  if (guide.split) ways.push_back("split");
  if (guide.scatter) ways.push_back("scattered");
  return ways.empty() ? "left as they are" : fmt::format("{} by importance", fmt::join(ways, ", "));
}

}  // namespace

std::vector<std::string> stages_of_photon_maps(const Scene& scene, const RenderSettings& settings,
                                               const SceneFacts& shown) {
  const bool media = shown.scattering_media, surfaces = shown.rough_surfaces;
  const SceneFacts facts = facts_of(scene);
  const std::string no_medium = scene.media.empty()      ? "no medium"
                                : facts.scattering_media ? "a light map shows no medium"
                                                         : "no medium scatters";
  const auto line = [](bool runs, const std::string& what, const std::string& how, const std::string& why_not) {
    return runs ? "runs " + what + how : "skips " + what + ": " + why_not;
  };
  const std::string transmittance = transmittance_text(settings);
  const std::string no_gathering = surfaces ? "indirect light comes from the photon map" : "no rough surface";
  const VolumeEstimatorInfo& volume = settings.volume.info();
  const bool beams = volume.flights;
  const bool photons = media || surfaces, gathers = surfaces && settings.indirect.type == IndirectLight::final_gather;
  const auto corrected = [](const AskedGather& gather) { return gather.boundary == BoundaryRule::corrected; };
  const uint64_t blocks = block_count(settings);
  const std::string by_blocks = blocks > 1 ? fmt::format(", in {} blocks, each gathered by itself", blocks) : "";
  return {
      line(photons, "photon tracing", distances_text(settings) + by_blocks, "nothing stores photons"),
      line(photons && settings.importance.importons > 0, "importons", ": photons are " + guided(settings.importance),
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
      line(media && settings.single_scattering.type != DirectLight::photons, "shadow rays in media",
           transmittance + (settings.single_scattering.type == DirectLight::equiangular
                                ? ", from distances drawn equiangularly"
                                : ""),
           media ? "single scattering comes from the photon map" : no_medium),
      line(surfaces && settings.direct.type == DirectLight::shadow_rays, "shadow rays at surfaces", transmittance,
           surfaces ? "direct light comes from the photon map" : "no rough surface"),
      line(gathers, "final gathering and a caustic map", fmt::format(", {} rays at a point", settings.indirect.rays),
           no_gathering),
      line(gathers && settings.indirect.rays_by == GatherBy::photons, "a photon map to guide its rays", "",
           gathers ? "materials draw them" : no_gathering),
      line(gathers && settings.indirect.irradiance == EndIrradiance::precomputed,
           "irradiance computed beforehand for their ends", "", gathers ? "they ask the photon map" : no_gathering),
      line(facts.grids, "grid look-ups", "", "all media are homogeneous"),
      channels_text(scene)};
}

}  // namespace vpm
