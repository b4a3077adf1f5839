// Warnings about what photon maps counted.
#include <fmt/format.h>

#include <algorithm>

#include "vpm/integrators/photon_map/integrator.h"
#include "vpm/integrators/photon_map/volume/estimator_info.h"

namespace vpm {
namespace {

bool planes_alone(const RenderSettings& settings) {
  return settings.volume.info().planes && settings.volume.share == PlaneUse::alone;
}

/// Of maps without photons that the picture is made of. Where rays find the light that comes straight from lights,
/// there may be no other.
void warn_of_empty_maps(const SceneFacts& shown, const RenderSettings& settings, const RenderStatistics& s,
                        std::vector<std::string>& warnings) {
  const bool gathers = settings.indirect.type == IndirectLight::final_gather;
  const bool flights = settings.volume.info().flights && !planes_alone(settings);
  if (shown.scattering_media && settings.single_scattering.type == DirectLight::photons &&
      (flights ? s.flights : s.volume_photons) == 0)
    warnings.emplace_back(flights ? "there are no photon beams: no photon flew through a medium"
                                  : "the volume photon map is empty: no photon scattered in a medium");
  if (shown.rough_surfaces && s.surface_photons == 0 && s.eye.surface_queries > 0 &&
      (gathers || settings.direct.type == DirectLight::photons))
    warnings.emplace_back("the surface photon map is empty: no photon to store met a diffuse or rough surface");
}

/// Of maps whose photons no gather has found.
void warn_of_unfound_photons(const RenderStatistics& s, std::vector<std::string>& warnings) {
  const auto warn = [&](uint64_t stored, uint64_t queries, uint64_t used, const char* what, float radius,
                        const char* section) {
    if (stored > 0 && queries > 0 && used == 0)
      warnings.push_back(
          fmt::format("no gather found any of the {} {}: a larger integrator.{}.radius ({:.2g} m in the last pass) or "
                      "more photons may help",
                      stored, what, section, radius));
  };
  warn(s.beams > 0 ? s.beams : s.volume_photons, s.eye.volume_queries, s.eye.used_in_media,
       s.beams > 0 ? "photon beams" : "photons in media", s.last_volume_radius, "volume");
  warn(s.surface_photons, s.eye.surface_queries, s.eye.gather.used - s.eye.used_in_media, "photons on surfaces",
       s.last_surface_radius, "surface");
}

/// Of gathers by count that the largest radius decides, so that another count makes the same picture.
void warn_of_short_counts(const EyeCounters& eye, std::vector<std::string>& warnings) {
  const auto warn = [&](uint64_t all, uint64_t of_fewer, const char* section) {
    constexpr double kMost = 0.01;
    const double share = static_cast<double>(of_fewer) / static_cast<double>(std::max<uint64_t>(1, all));
    if (share > kMost)
      warnings.push_back(fmt::format(
          "{:.1f} % of the gathers by count met fewer photons than the count of [integrator.{}] within the largest "
          "radius, and took that: a larger radius or more photons give the count its meaning",
          100.0 * share, section));
  };
  warn(eye.by_count_in_media, eye.short_in_media, "volume");
  warn(eye.gather.by_count - eye.by_count_in_media, eye.gather.short_of - eye.short_in_media, "surface");
}

}  // namespace

std::vector<std::string> warnings_of_photon_maps(const SceneFacts& shown, const RenderSettings& settings,
                                                 const RenderStatistics& s) {
  std::vector<std::string> warnings;
  warn_of_empty_maps(shown, settings, s, warnings);
  warn_of_unfound_photons(s, warnings);
  warn_of_short_counts(s.eye, warnings);
  if (shown.scattering_media && planes_alone(settings))
    warnings.emplace_back("photon planes alone have infinite variance: the error may be larger than is stated");
  return warnings;
}

}  // namespace vpm
