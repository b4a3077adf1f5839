// Warnings, and the estimated error.
#include "vpm/job/messages.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "vpm/render/plan.h"

namespace vpm {
namespace {

/// `shown`: what of the scene's scattering the picture shows.
std::vector<std::string> warnings_about(const Scattering& shown, const RenderSettings& settings,
                                        const RenderStatistics& s) {
  std::vector<std::string> warnings;
  const auto warn = [&](uint64_t count, const char* what) {
    if (count > 0) warnings.push_back(fmt::format("{} {}", count, what));
  };
  const bool photons = settings.integrator == Integrator::photon;
  if (photons && shown.media && s.volume_photons == 0)
    warnings.emplace_back("the volume photon map is empty: no photon scattered in a medium");
  if (photons && shown.surfaces && s.surface_photons == 0)
    warnings.emplace_back("the surface photon map is empty: no photon to store met a diffuse or rough surface");
  warn(s.ledger.non_finite, "photons were dropped because their power was not finite");
  warn(s.eye.non_finite, "samples were dropped because they were not finite");
  warn(s.ledger.cut_count, "photons were cut at render.max_events");
  warn(s.eye.gather.least_shares, "estimates at borders had less than a 64th of their kernel left, and are too dark");
  warn(s.eye.cut_paths, "eye paths were cut at render.max_events");
  // Rays through the very edges of boundaries need a correction now and then: some in 1e7. More means media that
  // overlap.
  WalkCounters walk = s.ledger.walk;
  walk.merge(s.eye.walk);
  warn(walk.majorant_violations,
       strategy_info(settings.distance.strategy).positive
           ? "densities were larger than the majorant and were cut to it: early passes are too thin, until majorants "
             "have grown"
           : "densities were larger than the majorant: weights grow there and change their signs");
  if (walk.medium_mismatches > 100 + walk.crossings / 1'000'000)
    warn(walk.medium_mismatches,
         "rays met a boundary from another medium than the one that the boundary has on that side: check that media do "
         "not overlap");
  return warnings;
}

/// How many pixels are negative in a channel.
size_t negative_pixels(const Film& film) {
  const Image mean = film.mean();
  return static_cast<size_t>(std::count_if(mean.pixels.begin(), mean.pixels.end(),
                                           [](const Rgb& p) { return p.r < 0.0f || p.g < 0.0f || p.b < 0.0f; }));
}

/// The warnings about what is rendered, and about the picture of it.
std::vector<std::string> all_warnings(const Scattering& shown, const RenderJob& job, const RenderResult& result) {
  std::vector<std::string> warnings = warnings_about(shown, job.settings, result.statistics);
  if (const size_t negative = negative_pixels(result.film); negative > 0)
    warnings.push_back(
        fmt::format("{} pixels are negative in a channel, as weights of changing sign make them where photons are few; "
                    "the preview shows them as 0",
                    negative));
  return warnings;
}

}  // namespace

std::vector<std::string> warnings_of(const RenderJob& job, const RenderResult& result) {
  return all_warnings(scattering_of(job.scene), job, result);
}

std::vector<std::string> warnings_of_light_map(const RenderJob& job, const RenderResult& result) {
  return all_warnings({.surfaces = true}, job, result);
}

std::string error_text(const RenderJob& job, const RenderResult& result) {
  if (result.film.passes() < kLeastPasses) return "";
  const FilmErrors errors = errors_of(result).value();
  const std::vector<std::string> unseen = maps_of_unseen_bias(job.scene, job.settings);
  return fmt::format(
      "estimated relative MSE {:.2g} (variance {:.2g}, {}{})", estimated_error(result), errors.variance_part,
      result.film.shows_bias() ? fmt::format("squared bias {:.2g}", errors.bias_part) : "no bias to be seen",
      unseen.empty()
          ? ""
          : fmt::format("; not seen: that of [{}], whose radii are not those of passes", fmt::join(unseen, "], [")));
}

}  // namespace vpm
