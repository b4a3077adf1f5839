// Making jobs, and choosing what is left to choose.
#include "vpm/job/render_job.h"

#include <fmt/format.h>
#include <algorithm>

#include "vpm/base/error.h"
#include "vpm/base/stopwatch.h"
#include "vpm/job/automatic.h"
#include "vpm/job/forecast.h"
#include "vpm/job/validate.h"

namespace vpm {
namespace {

/// The share of the film's pixels that are rendered.
double share_rendered(const Camera& camera) {
  const PixelRect rendered = camera.rendered();
  return double(rendered.width()) * rendered.height() / (double(camera.width) * camera.height);
}

/// What was chosen, and how to have it again.
void note_choices(RenderJob& job) {
  if (job.choices.empty()) return;
  std::string again;
  for (const Choice& choice : job.choices) {
    job.notes.push_back(fmt::format("chosen {} = {}: {}", choice.key, choice.value, choice.reason));
    again += fmt::format(" --set {}={}", choice.key, choice.value);
  }
  job.notes.push_back("the same settings again without choosing:" + again);
}

}  // namespace

RenderJob make_job(AssembledScene assembled, const RenderSettings& settings) {
  return {.scene = std::move(assembled.scene),
          .settings = settings,
          .automatic = {},
          .light_names = std::move(assembled.light_names),
          .notes = std::move(assembled.notes),
          .kernel_light = {}};
}

void choose(RenderJob& job) {
  if (!job.automatic.any()) return;
  validate(job.settings, facts_of(job.scene));
  const Stopwatch choosing;
  job.choices = choose_settings(job.scene, job.automatic, job.settings);
  const double seconds = choosing.seconds();
  job.pilot_seconds += seconds;
  if (!job.choices.empty()) job.notes.push_back(fmt::format("choosing settings took {:.2g} s", seconds));
  note_choices(job);
}

void choose_again(RenderJob& job, std::vector<Choice> choices) {
  job.choices = std::move(choices);
  for (const Choice& choice : job.choices) set_chosen(job.settings, choice.key, choice.value);
  note_choices(job);
}

void check_not_read(const std::filesystem::path& path, const RenderJob& job) {
  std::vector<std::string> read = job.files;
  read.push_back(job.source);
  for (const std::string& file : read)
    if (std::error_code none; std::filesystem::equivalent(path, file, none))
      throw InputError(
          fmt::format("cannot write '{}': the scene is read from '{}'; name another output", path.string(), file));
}

void foresee(RenderJob& job) {
  validate(job.settings, facts_of(job.scene));
  const Stopwatch looking;
  check_memory(job.scene, job.settings, PassOf::picture, physical_memory());
  if (const double seconds = job.settings.until.seconds; seconds > 0.0) {
    PassCost cost = time_pass(job.scene, job.settings, std::min(0.1 * seconds, 1.0));
    cost.eye *= share_rendered(job.scene.camera);
    if (std::string text = too_long_text(cost, job.settings); !text.empty()) job.notes.push_back(std::move(text));
  }
  job.pilot_seconds += looking.seconds();
}

void look_for_kernel_light(RenderJob& job) {
  const Stopwatch looking;
  job.kernel_light = kernel_light_of(job.scene, job.settings);
  if (job.kernel_light) job.notes.push_back(text_of(*job.kernel_light, job.light_names));
  job.pilot_seconds += looking.seconds();
}

void foresee_light_map(const RenderJob& job) {
  validate_light_map(job.settings, facts_of(job.scene));
  check_memory(job.scene, job.settings, PassOf::light_map, physical_memory());
}

}  // namespace vpm
