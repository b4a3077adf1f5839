// Warnings, and the estimated error.
#include "vpm/job/messages.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "vpm/integrators/photon_map/plan.h"
#include "vpm/integrators/render_scene.h"
#include "vpm/job/lost_light.h"

namespace vpm {
namespace {

/// `shown`: what of the scene's scattering the picture shows.
std::vector<std::string> warnings_about(const SceneFacts& shown, const RenderSettings& settings,
                                        const RenderStatistics& s) {
  std::vector<std::string> warnings = integrator_warnings(shown, settings, s);
  const auto warn = [&](uint64_t count, const char* what) {
    if (count > 0) warnings.push_back(fmt::format("{} {}", count, what));
  };
  for (std::string& warning : warnings_of(s.ledger)) warnings.push_back(std::move(warning));
  warn(s.eye.non_finite, "samples were dropped because they were not finite");
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

/// "0.0048 +- 0.0004", the standard error to one digit and the value to the same place.
std::string measured_text(const Estimated& estimated) {
  const double error = estimated.standard_error;
  if (!(error > 0.0) || std::isinf(error)) return fmt::format("{:.2g} +- {:.1g}", estimated.value, error);
  const int place = std::max(0, -static_cast<int>(std::floor(std::log10(error))));
  if (place > 6) return fmt::format("{:.2g} +- {:.1g}", estimated.value, error);
  return fmt::format("{:.{}f} +- {:.{}f}", estimated.value, place, error, place);
}

/// The least number of two digits that is no less.
double two_digits_up(double number) {
  if (!(number > 0.0) || std::isinf(number)) return number;
  const double unit = std::pow(10.0, std::floor(std::log10(number)) - 1.0);
  return unit * std::ceil(number / unit * (1.0 - 1e-12));
}

std::string bias_text(const StatedError& stated, bool gathers, bool loses_light) {
  if (loses_light) return "no bias but by light that paths do not find";
  if (!gathers) return "no bias";
  if (!stated.bias_seen) return fmt::format("bias: none seen, below {:.1g}", stated.highest_squared_bias);
  return fmt::format("of which bias {}, below {:.2g}", measured_text(stated.squared_bias), stated.highest_squared_bias);
}

/// How many pixels are negative in a channel.
size_t negative_pixels(const Film& film) {
  const Image mean = film.mean();
  return static_cast<size_t>(std::count_if(mean.pixels.begin(), mean.pixels.end(),
                                           [](const Rgb& p) { return p.r < 0.0f || p.g < 0.0f || p.b < 0.0f; }));
}

/// Is the picture black, though there are lights?
bool finds_no_light(const Scene& scene, const Film& film) {
  const Image mean = film.mean();
  return !scene.lights.empty() && film.passes() > 0 &&
         std::all_of(mean.pixels.begin(), mean.pixels.end(), [](const Rgb& p) { return is_black(p); });
}

std::string lost_light_of(const RenderJob& job) { return text_of_lost_light(job.scene, job.settings, job.light_names); }

/// The warnings about what is rendered, and about the picture of it.
std::vector<std::string> all_warnings(const SceneFacts& shown, const RenderJob& job, const RenderResult& result) {
  std::vector<std::string> warnings = warnings_about(shown, job.settings, result.statistics);
  if (const size_t negative = negative_pixels(result.film); negative > 0)
    warnings.push_back(
        fmt::format("{} pixels are negative in a channel, as weights of changing sign make them where photons are few; "
                    "the preview shows them as 0",
                    negative));
  if (std::string lost = lost_light_of(job); !lost.empty()) warnings.push_back(std::move(lost));
  if (finds_no_light(job.scene, result.film))
    warnings.emplace_back(
        "the picture is black: no light was found, and no error shows what is missing; another integrator, or "
        "more passes, may find some");
  if (const double error = job.settings.until.error; error > 0.0 && highest_error(result) > error)
    warnings.push_back(
        fmt::format("a relative MSE below {:g} is not reached after {}", error, passes_text(result.film.passes())));
  return warnings;
}

}  // namespace

std::vector<std::string> warnings_of(const Ledger& ledger) {
  std::vector<std::string> warnings;
  if (ledger.non_finite > 0)
    warnings.push_back(fmt::format("{} photons were dropped because their power was not finite", ledger.non_finite));
  if (ledger.cut_count > 0)
    warnings.push_back(fmt::format("{} photons were cut at render.max_events", ledger.cut_count));
  return warnings;
}

std::vector<std::string> warnings_of(const RenderJob& job, const RenderResult& result) {
  return all_warnings(facts_of(job.scene), job, result);
}

std::vector<std::string> warnings_of_light_map(const RenderJob& job, const RenderResult& result) {
  return all_warnings({.rough_surfaces = true}, job, result);
}

std::string error_text(const RenderJob& job, const RenderResult& result) {
  const std::optional<StatedError> stated = stated_error_of(result);
  if (!stated) return "";
  const std::vector<std::string> unseen = maps_of_unseen_bias(job.scene, job.settings);
  return fmt::format(
      "relative MSE at most {:.2g} (expected about {}; {}{})", two_digits_up(stated->highest),
      measured_text(stated->total), bias_text(*stated, gathers(job.scene, job.settings), !lost_light_of(job).empty()),
      unseen.empty() ? ""
                     : fmt::format("; that of [integrator.{}] cannot be seen", fmt::join(unseen, "], [integrator.")));
}

}  // namespace vpm
